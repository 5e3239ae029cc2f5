// The length of a step where each of its three conditions is the one that limits.
#include "verification/loads/problems.hpp"

namespace furrow::loads_cases {

Problem step_length(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const int n = static_cast<int>(input.integer("cells", 4, 100));
  const double alpha = input.number("alpha", range::positive);
  const double strain = input.number("strain", {0.0, 0.5, true, true});
  const double share = input.number("share", {0.0, 1.0, true, true});
  Scheme scheme = read_scheme(input);
  scheme.viscosity.reset();

  return [=](Run& run) {
    const double dx = run.resolution().spacing, h = run.resolution().smoothing_length(), rho_0 = material.reference_density;
    const auto speed = [&](double rho) {
      return std::sqrt(material.bulk_modulus / rho_0 + 4.0 / 3.0 * material.shear_modulus / rho);
    };
    const auto set_up = [&](const Scheme& chosen) {
      Simulation<2> simulation;
      simulation.body = elastic_body(run, material, chosen);
      simulation.body.add(block(n, n, dx, {-0.5 * n * dx, 0.0}));
      return simulation;
    };
    const StepControl control;
    const double courant = control.courant * h / speed(rho_0);

    // Courant: the right half expands, so that waves are fastest there; the second step must be that of the fastest.
    Simulation<2> waves = set_up(scheme);
    Particles<2>& p = waves.body.particles;
    for (std::size_t i = 0; i < p.size(); ++i) p.velocity[i] = {std::max(0.0, p.position[i][0]) * strain / courant, 0.0};
    waves.start();
    waves.step(1.0);
    double c = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) c = std::max(c, speed(p.density[i]));
    waves.step(1.0);
    run.measure("courant_step", waves.dt(), "s", {control.courant * h / c, 0.0});

    // Viscosity: at rest, so that its linear term alone limits.
    Scheme viscous = scheme;
    viscous.viscosity = ArtificialViscosity{alpha, 0.0};
    Simulation<2> rest = set_up(viscous);
    rest.start();
    rest.step(1.0);
    run.measure("viscous_step", rest.dt(), "s", {courant / (1.0 + 0.6 * alpha), 0.0});

    // Force: free fall, so strong that its step is `share` of Courant's.
    const double g = h * std::pow(control.force / (share * courant), 2);
    Simulation<2> fall = set_up(scheme);
    fall.body.loads.gravity = {0.0, -g};
    fall.start();
    for (int k = 0; k < 3; ++k) fall.step(1.0);
    run.measure("force_step", fall.dt(), "s", {share * courant, 0.0});
    run.count(6, static_cast<long>(p.size()));
    exercise(run, scheme);
    run.exercises("schemes/viscosity");
    run.exercises("boundaries/gravity");
  };
}

}  // namespace furrow::loads_cases
