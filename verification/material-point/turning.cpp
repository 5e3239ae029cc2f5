// What spin does to stress: simple shear with yield against the closed form of the Jaumann rate (Dienes 1979), for metal and for
// soil under pressure; and a stressed point that only spins, whose stress must turn with it.
#include <limits>
#include <random>

#include "harness/material_file.hpp"
#include "reference/exact/plasticity.hpp"
#include "verification/material-point/drive.hpp"
#include "verification/material-point/problems.hpp"

namespace furrow::material_point_cases {
namespace {

Tensor skew(double xy, double yz, double zx) {
  Tensor W = Tensor::Zero();
  W(0, 1) = xy, W(1, 2) = yz, W(2, 0) = zx;
  return W - Tensor(W.transpose());
}

/// sqrt(J2) at yield under the pressure, Pa, and the shear modulus.
struct Shearing {
  double strength, G;
};
Shearing shearing(const LinearElastic& m, double) { return {std::numeric_limits<double>::infinity(), m.shear_modulus}; }
template <class Eos>
Shearing shearing(const J2Plastic<Eos>& m, double) {
  return {m.yield_stress / std::sqrt(3.0), m.shear_modulus};
}
Shearing shearing(const DruckerPrager& m, double p) { return {m.cone.k + 3.0 * m.cone.alpha * p, m.shear_modulus}; }

AnyMaterial without_yield(const AnyMaterial& material) {
  return std::visit(
      [](const auto& m) -> AnyMaterial {
        if constexpr (requires {
                        m.eos.bulk_modulus;
                        m.yield_stress;
                      })
          return LinearElastic{m.eos.reference_density, m.eos.bulk_modulus, m.shear_modulus};
        else
          throw std::runtime_error("expected a J2 metal with the linear equation of state");
      },
      material);
}

}  // namespace

Problem simple_shear(const Parameters& input) {
  const NamedMaterial named = read_material(input, "material");
  const bool elastic = input.choice_or("yield", "as given", {"as given", "none"}) == "none";
  const double p = input.quantity_or("pressure", dimension::stress, 0.0, range::not_negative);
  const double gamma = input.number("shear", range::positive);
  const AnyMaterial material = elastic ? without_yield(named.law) : named.law;
  return [=](Run& run) {
    const Shearing truth = std::visit(
        [&](const auto& m) -> Shearing {
          if constexpr (requires { shearing(m, p); })
            return shearing(m, p);
          else
            throw std::runtime_error("simple shear has a closed form for perfect plasticity alone");
        },
        material);
    exercise(run, material);
    run.exercises("materials/jaumann_rate");
    const double scale = std::min(truth.strength, truth.G);

    std::vector<double> steps, rms;
    for (const int n : {1000, 2000, 4000, 8000}) {
      MaterialState state = initial_state(material);
      state.stress = -p * Tensor::Identity();
      Largest tau, normal;
      double squares = 0.0;
      Series solver{.label = "solver"}, closed{.label = "closed form", .role = "reference"};
      const double step = gamma / n;
      Tensor strain = Tensor::Zero();
      strain(0, 1) = strain(1, 0) = 0.5 * step;
      const Tensor spin = skew(0.5 * step, 0.0, 0.0);
      for (int k = 1; k <= n; ++k) {
        state = advance(material, state, {strain, spin, 1e-6});
        if (k % (n / 100) != 0) continue;
        const auto [s11, s12] = exact::jaumann_shear(truth.G, truth.strength, gamma * k / n);
        tau.add((state.stress(0, 1) - s12) / scale);
        normal.add((deviator(state.stress)(0, 0) - s11) / scale);   // heat raises the pressure
        squares += std::pow((state.stress(0, 1) - s12) / scale, 2);
        for (Series* s : {&solver, &closed}) s->x.push_back(gamma * k / n);
        solver.y.push_back(state.stress(0, 1));
        closed.y.push_back(s12);
      }
      steps.push_back(step);
      rms.push_back(std::sqrt(squares / 100.0));
      if (n != 1000) continue;
      run.measure("shear_stress_error", tau.magnitude);
      run.measure("normal_stress_error", normal.magnitude);
      if (elastic)
        run.skip("strength_error", "there is no yield");
      else
        run.measure("strength_error", std::sqrt(j2(deviator(state.stress))) / truth.strength - 1.0);
      Figure& figure = run.figure({.name = "shear", .title = "Shear stress", .x = {"gamma"}, .y = {"tau", "Pa"}});
      figure.series = {solver, closed};
    }
    measure_order(run, "observed_order", steps, rms, 1e-11);
  };
}

Problem rotation(const Parameters& input) {
  const AnyMaterial material = read_material(input, "material").law;
  const double size = input.number("strain", range::positive);
  return [=](Run& run) {
    exercise(run, material);
    run.exercises("materials/jaumann_rate");
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    const auto symmetric = [&] { return symmetric_part(Tensor::NullaryExpr([&] { return normal(random); })); };

    // Ten turns about an oblique axis, in steps of 3.6 degrees, of a point inside its yield surface.
    const Tensor load = 0.02 * size * symmetric() - 0.1 * size * Tensor::Identity();
    MaterialState state = advance(material, initial_state(material), {load, Tensor::Zero(), 1.0});
    const Tensor before = state.stress;
    const Tensor spin = skew(0.6, 0.64, -0.48) * (2.0 * 3.14159265358979323846 / 100.0);   // a unit axis
    for (int k = 0; k < 1000; ++k) state = advance(material, state, {Tensor::Zero(), spin, 1.0});
    const double scale = before.norm();
    run.measure("stress_after_ten_turns", (state.stress - before).norm() / scale);
    run.measure("mean_stress", (state.stress.trace() - before.trace()) / scale);
    run.measure("j2", (j2(deviator(state.stress)) - j2(deviator(before))) / (scale * scale));
    run.measure("third_invariant", (state.stress.determinant() - before.determinant()) / std::pow(scale, 3));

    // A plastic path with spin, and the same seen from a turned frame.
    const Tensor R = furrow::rotation(skew(1.0, -2.0, 0.5));
    MaterialState here = initial_state(material), there = here;
    Largest frame, negative_work;
    for (int k = 0; k < 200; ++k) {
      const Tensor strain = 0.1 * size * symmetric(), turn = 0.1 * size * skew(normal(random), normal(random), normal(random));
      const double work = here.plastic_work;
      here = advance(material, here, {strain, turn, 1e-6});
      there = advance(material, there, {rotated(strain, R), rotated(turn, R), 1e-6});
      frame.add((there.stress - rotated(here.stress, R)).norm() / (here.stress.norm() + scale));
      negative_work.add(std::min(0.0, here.plastic_work - work) / (1e-300 + here.plastic_work));
    }
    if (!(here.plastic_strain > 0.0)) throw std::runtime_error("the path was to be plastic");
    run.measure("frame", frame.magnitude);
    run.measure("negative_plastic_work", negative_work.magnitude);
  };
}

}  // namespace furrow::material_point_cases
