// Cantilever under a small load at its tip, brought to rest by damping: how soft is a strip of few particles?
#include "verification/elastodynamics/problems.hpp"

namespace furrow::elastodynamic_cases {

Problem cantilever(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const double L = input.quantity("length", dimension::length, range::positive);
  const double t = input.quantity("thickness", dimension::length, range::positive);
  const double P = input.quantity("tip_load", dimension::force_per_width, range::positive);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing;
    const int across = cells(t, dx, "thickness"), along = cells(L, dx, "length");

    // Geometry and clamp: columns that fill a support behind x = 0 are held.
    Simulation<2> simulation;
    simulation.body = elastic_body(run, material, scheme);
    Body<2>& body = simulation.body;
    const int held = static_cast<int>(std::ceil(support(scheme.kernel) * body.scheme.smoothing_ratio));
    body.add(block(held + along, across, dx, {-held * dx, -0.5 * t}));
    PrescribedMotion<2> rest{"clamp", {}, [](double) { return Vector<2>(Vector<2>::Zero()); }};
    for (int i = 0; i < held * across; ++i) rest.ids.push_back(i);
    body.loads.motions.push_back(rest);

    // Load: shared by the last column, whose centre lies half a spacing before the end.
    AppliedForce<2> load{"tip load", {}, [P](double) { return Vector<2>(0.0, -P); }};
    for (int j = 0; j < across; ++j) load.ids.push_back((held + along - 1) * across + j);
    body.loads.forces.push_back(load);

    // Damping: critical for the first bending mode, so that rest is reached within a few periods.
    const double E = 9.0 * material.bulk_modulus * material.shear_modulus / (3.0 * material.bulk_modulus + material.shear_modulus);
    const double nu = E / (2.0 * material.shear_modulus) - 1.0, E_plane = E / (1.0 - nu * nu), I = t * t * t / 12.0;
    const double omega = std::pow(1.875104068711961 / L, 2) * std::sqrt(E_plane * I / (material.reference_density * t));
    body.loads.damping = 2.0 * omega;
    simulation.control.courant = 0.4;
    simulation.watch.low = {-L, -L};
    simulation.watch.high = {2.0 * L, L};

    const std::int32_t tip = (held + along - 1) * across + across / 2;
    const double y_0 = body.particles.position[static_cast<std::size_t>(tip)][1];
    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"tip_deflection", "u_y", "m", "deflection of the last column"},
                  [tip, y_0](const Simulation<2>& s) { return s.body.particles.position[s.body.index_of(tip)][1] - y_0; });
    dynamic.until(10.0 / omega, 200, 2);
    exercise(run, scheme);
    run.exercises("boundaries/prescribed_motion");
    run.exercises("boundaries/applied_force");

    // Beam theory with shear at the last column: the load acts at its centre, x = L - dx/2.
    const double x = L - 0.5 * dx;
    const double exact = P * x * x * x / (3.0 * E_plane * I) + 1.2 * P * x / (material.shear_modulus * t);
    const std::vector<double>& u = dynamic.column("tip_deflection");
    run.measure("tip_deflection", -u.back(), "m", {exact, 0.0});
    run.measure("residual_motion", std::abs(u.back() - u[u.size() - 11]) / std::abs(u.back()));
    measure_energy(run, dynamic);
    history_figure(run, dynamic, "deflection", "Deflection of the last column", {"tip_deflection"}, {"u_y", "m"});
  };
}

}  // namespace furrow::elastodynamic_cases
