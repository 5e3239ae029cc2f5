// The Mie-Grueneisen equation of state (paper Eq. 17 in its right form) against what it is made from: shock velocity linear in
// particle velocity and the jump conditions; expansion; sound; and work around a closed cycle.
#include "harness/material_file.hpp"
#include "reference/exact/quadrature.hpp"
#include "verification/material-point/drive.hpp"
#include "verification/material-point/problems.hpp"

namespace furrow::material_point_cases {
namespace {

using Fluid = J2Plastic<MieGrueneisen>;   // without strength to speak of, so that stress is pressure

MieGrueneisen equation_of_state(const NamedMaterial& material, const Parameters& input) {
  return std::visit(
      [&](const auto& law) -> MieGrueneisen {
        if constexpr (requires { MieGrueneisen(law.eos); })
          return law.eos;
        else
          input.fail("material", "found a material without a Mie-Grueneisen equation of state, expected one with it");
      },
      material.law);
}

MaterialState squeezed(const Fluid& fluid, MaterialState state, double logarithmic_strain, int n) {
  Tensor de = Tensor::Zero();
  de(0, 0) = logarithmic_strain / n;
  for (int k = 0; k < n; ++k) state = furrow::advance(fluid, state, {de, Tensor::Zero(), 1e-9});
  return state;
}

double pressure(const MaterialState& state) { return -state.stress.trace() / 3.0; }

/// Each shock is one step from rest: the step's trapezoidal work is then the jump condition itself.
void measure_shocks(Run& run, const Fluid& fluid) {
  const double rho_0 = fluid.eos.reference_density, c_0 = fluid.eos.sound_speed, S = fluid.eos.slope;
  Largest speed, energy;
  Series solver{.label = "solver"}, line{.label = "c_0 + S u_p", .role = "reference"};
  for (double u = 10.0; u <= 4000.0; u *= 1.2) {
    const double U = c_0 + S * u;
    const MaterialState state = squeezed(fluid, fluid.initial_state(), std::log1p(-u / U), 1);
    const double p = pressure(state), volume_change = 1.0 / rho_0 - 1.0 / state.density;
    const double u_p = std::sqrt(p * volume_change), U_s = std::sqrt(p / volume_change) / rho_0;   // mass and momentum
    speed.add(U_s / (c_0 + S * u_p) - 1.0);
    energy.add(state.internal_energy / (0.5 * u_p * u_p) - 1.0);
    for (Series* s : {&solver, &line}) s->x.push_back(u_p);
    solver.y.push_back(U_s);
    line.y.push_back(c_0 + S * u_p);
  }
  run.measure("shock_velocity_error", speed.magnitude);
  run.measure("jump_energy_error", energy.magnitude);
  Figure& figure = run.figure({.name = "hugoniot",
                               .title = "Shock velocity over particle velocity",
                               .x = {"particle velocity", "m/s"},
                               .y = {"shock velocity", "m/s"}});
  figure.series = {solver, line};
}

}  // namespace

Problem hugoniot(const Parameters& input) {
  const NamedMaterial material = read_material(input, "material");
  const MieGrueneisen eos = equation_of_state(material, input);
  return [=](Run& run) {
    run.exercises("materials/mie_grueneisen");
    const Fluid fluid{eos, 1.0, 0.0};
    const exact::PressureLaw truth = pressure_law(eos);
    measure_shocks(run, fluid);

    Largest tension, sound;
    for (double ratio = 0.8; ratio < 1.3; ratio += 0.01)
      for (const double e : {0.0, 5e4, 5e5}) {
        const double rho = ratio * eos.reference_density, p = truth.pressure(rho, e);
        const double stiffness = truth.stiffness(rho) + truth.by_energy() * p / rho;   // at constant entropy
        if (ratio < 1.0) tension.add((eos.cold_pressure(rho) + eos.pressure_per_energy() * e - p) / truth.stiffness(rho));
        sound.add(eos.isentropic_stiffness(rho, p) / stiffness - 1.0);
      }
    run.measure("tension_error", tension.magnitude);
    run.measure("sound_speed_error", sound.magnitude);

    // There and back in many small steps, through compression and expansion.
    MaterialState state = fluid.initial_state();
    double most = 0.0;
    for (const double way : {-0.15, 0.15, 0.05, -0.05}) {
      state = squeezed(fluid, state, way, 150);
      most = std::max(most, state.internal_energy);
    }
    run.measure("cycle_energy", std::abs(state.internal_energy) / most);

    // The isentrope on the way there, against the rate equations.
    exact::Leg leg{.duration = 1.0};
    leg.rate[0] = -0.15;
    const double e_truth =
        exact::follow(exact::von_mises(truth, 1.0, 1e12, 0.0), point(fluid.initial_state()), {leg}).back().energy;
    std::vector<double> steps, off;
    for (const int n : {150, 300, 600, 1200}) {
      steps.push_back(0.15 / n);
      off.push_back(squeezed(fluid, fluid.initial_state(), -0.15, n).internal_energy / e_truth - 1.0);
    }
    run.measure("isentrope_error", std::abs(off.front()));
    measure_order(run, "observed_order", steps, off, 1e-11);
    // With shear the stress does work of its own, per mass of the middle of each step.
    const double G = 0.4 * eos.reference_density * eos.sound_speed * eos.sound_speed;
    const Fluid stiff{eos, G, 1e12, 0.0};
    const double work =
        exact::follow(exact::von_mises(truth, G, 1e12, 0.0), point(stiff.initial_state()), {leg}).back().energy;
    std::vector<double> work_off;
    for (const double step : steps)
      work_off.push_back(squeezed(stiff, stiff.initial_state(), -0.15, static_cast<int>(std::lround(0.15 / step))).internal_energy / work - 1.0);
    run.measure("work_error", std::abs(work_off.front()));
    measure_order(run, "work_order", steps, work_off, 1e-11);
    run.measure("cold_energy_error", eos.cold_energy(eos.reference_density * std::exp(0.15)) / e_truth - 1.0);
  };
}

Problem linear_pressure(const Parameters& input) {
  const NamedMaterial material = read_material(input, "material");
  const LinearEos eos = std::visit(
      [&](const auto& law) -> LinearEos {
        if constexpr (requires { law.eos.bulk_modulus; })
          return law.eos;
        else
          input.fail("material", "found a material without a linear equation of state, expected one with it");
      },
      material.law);
  return [=](Run& run) {
    run.exercises("materials/linear_eos");
    const exact::PressureLaw truth = pressure_law(eos);
    Largest pressure, sound, energy;
    for (double ratio = 0.8; ratio < 1.3; ratio += 0.01) {
      const double rho = ratio * eos.reference_density, p = truth.pressure(rho, 0.0);
      pressure.add((eos.cold_pressure(rho) - p) / eos.bulk_modulus);
      sound.add(eos.isentropic_stiffness(rho, p) / truth.stiffness(rho) - 1.0);
      const double e = exact::integrate([&](double r) { return truth.pressure(r, 0.0) / (r * r); }, eos.reference_density, rho, 1e-12);
      energy.add((eos.cold_energy(rho) - e) * eos.reference_density / eos.bulk_modulus);
    }
    run.measure("pressure_error", pressure.magnitude);
    run.measure("sound_speed_error", sound.magnitude);
    run.measure("cold_energy_error", energy.magnitude);
  };
}

}  // namespace furrow::material_point_cases
