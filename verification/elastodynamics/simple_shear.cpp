// Simple shear of a block of particles to a large angle: the stress of a hypoelastic law with Jaumann's rate oscillates, and the
// particles must find it through their own velocity gradient, on a lattice that is sheared out of all order.
#include <fmt/format.h>

#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastodynamic_cases {

Problem simple_shear(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const double a = input.quantity("side", dimension::length, range::positive);
  const double rate = input.quantity("shear_rate", dimension::rate, range::positive);
  const double gamma_end = input.number("shear", range::positive);
  const StepControl control = read_control(input);
  Scheme scheme = read_scheme_without_correction(input, "correction");
  scheme.correction = read_correction(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing, G = material.shear_modulus, end = gamma_end / rate;
    const int n = cells(a, dx, "side");

    // A block, periodic along x; every row moves with v_x = rate y. Accelerations play no part: a motion is imposed, the stress
    // is the answer.
    Simulation<2> simulation;
    simulation.body = elastic_body(run, material, scheme);
    simulation.control = control;
    Body<2>& body = simulation.body;
    body.add(block(n, n, dx, {0.0, 0.0}));
    body.box.length = {a, 0.0};
    for (int j = 0; j < n; ++j) {
      const double v = rate * (j + 0.5) * dx;
      PrescribedMotion<2> row{fmt::format("row {}", j), {}, [v](double) { return Vector<2>(v, 0.0); }};
      for (int i = 0; i < n; ++i) row.ids.push_back(i * n + j);
      body.loads.motions.push_back(row);
    }

    // Truth, x' = gamma y with Jaumann's rate (Dienes 1979): s_12 = G sin(gamma), s_11 = -s_22 = G (1 - cos(gamma)).
    const auto exact = [G, rate](double t) {
      const double gamma = rate * t;
      Tensor s = Tensor::Zero();
      s(0, 0) = G * (1.0 - std::cos(gamma));
      s(1, 1) = -s(0, 0);
      s(0, 1) = s(1, 0) = G * std::sin(gamma);
      return s;
    };
    DynamicRun<2> dynamic(run, simulation);
    const auto mean = [](int row, int column) {
      return [row, column](const Simulation<2>& s) {
        double sum = 0.0;
        for (std::size_t i = 0; i < s.body.particles.size(); ++i) sum += s.body.particles.stress[i](row, column);
        return sum / static_cast<double>(s.body.particles.size());
      };
    };
    dynamic.probe({"shear_stress", "sigma_12", "Pa", "mean of all particles"}, mean(0, 1));
    dynamic.probe({"normal_stress", "sigma_11", "Pa", "mean of all particles"}, mean(0, 0));
    dynamic.probe({"stress_error", "d sigma/G", "1", "largest error of a component of any particle's stress"},
                  [exact, G](const Simulation<2>& s) {
                    double largest = 0.0;
                    const Tensor truth = exact(s.time());
                    for (std::size_t i = 0; i < s.body.particles.size(); ++i)
                      largest = std::max(largest, (s.body.particles.stress[i] - truth).cwiseAbs().maxCoeff());
                    return largest / G;
                  });
    dynamic.until(end, 400, 4);
    exercise(run, scheme);
    run.exercises("boundaries/prescribed_motion");
    run.exercises("materials/linear_elastic");

    double stress_error = 0.0, density = 0.0;
    for (const double e : dynamic.column("stress_error")) stress_error = std::max(stress_error, e);
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      density = std::max(density, std::abs(body.particles.density[i] / material.reference_density - 1.0));
    run.measure("stress_error", stress_error);
    run.measure("final_shear_stress", dynamic.column("shear_stress").back() / G, "1", {std::sin(gamma_end), 0.0});
    run.measure("density_error", density);
    measure_energy(run, dynamic);

    Figure figure;
    figure.name = "stress";
    figure.title = "Stress over shear";
    figure.x = {"gamma", "1"};
    figure.y = {"sigma/G", "1"};
    using Component = std::tuple<const char*, const char*, int, int>;
    for (const auto& [column, label, row, of] :
         {Component{"shear_stress", "sigma_12", 0, 1}, Component{"normal_stress", "sigma_11", 0, 0}}) {
      Series computed{.label = label}, reference{.label = fmt::format("{}, exact", label), .role = "reference"};
      for (std::size_t k = 0; k < dynamic.history().rows(); ++k) {
        const double t = dynamic.column("time")[k];
        computed.x.push_back(rate * t);
        computed.y.push_back(dynamic.column(column)[k] / G);
        reference.x.push_back(rate * t);
        reference.y.push_back(exact(t)(row, of) / G);
      }
      figure.add(std::move(computed));
      figure.add(std::move(reference));
    }
    run.figure(std::move(figure));
  };
}

}  // namespace furrow::elastodynamic_cases
