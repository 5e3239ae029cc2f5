// A block that is pushed as a whole, by a force that does not change or by a hand that moves it as such a force would: momentum is
// force times time, and all work goes into motion.
#include "verification/loads/problems.hpp"

namespace furrow::loads_cases {

Problem pushed_block(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const int n = static_cast<int>(input.integer("cells", 4, 100));
  const double stress = input.quantity("stress", dimension::stress, range::positive);
  const std::string load = input.choice("load", {"applied", "held", "prescribed"});
  const double passes = input.number("passes", range::positive);
  const double damping = input.number_or("damping", 0.0, range::not_negative);   // times the time that it lasts
  const double damped = input.number_or("damped_share", 0.0, {0.0, 1.0});
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing, L = n * dx;
    const double c = std::sqrt((material.bulk_modulus + 4.0 / 3.0 * material.shear_modulus) / material.reference_density);
    Simulation<2> simulation;
    simulation.body = elastic_body(run, material, scheme);
    simulation.body.add(block(n, n, dx, {0.0, 0.0}));

    const Vector<2> F = stress * L * Vector<2>(1.0, 0.5);
    const std::vector<std::int32_t> all = simulation.body.particles.id;
    if (load == "applied") simulation.body.loads.forces.push_back({"pull", all, [F](double) { return F; }});
    if (load == "held") simulation.body.loads.held = {all, std::vector<Vector<2>>(all.size(), F / static_cast<double>(n * n))};

    const Vector<2> a = F / (material.reference_density * L * L);
    if (load == "prescribed")
      simulation.body.loads.motions.push_back({"hand", all, [a](double t) { return Vector<2>(t * a); }});
    const double T_damped = damped * passes * L / c, rate = damped > 0.0 ? damping / T_damped : 0.0;
    simulation.body.loads.damping = rate;
    simulation.body.loads.damping_end = T_damped;
    DynamicRun<2> dynamic(run, simulation);
    dynamic.until(passes * L / c, 200, 2);
    exercise(run, scheme);
    run.exercises(load == "applied" ? "boundaries/applied_force" : load == "held" ? "boundaries/held_forces" : "boundaries/prescribed_motion");

    // P' = F - rate P while damping lasts, P' = F after it.
    const double as_if_free = rate > 0.0 ? (1.0 - std::exp(-damping)) / rate : 0.0;
    const Vector<2> P = simulation.momentum(), given = (as_if_free + simulation.time() - T_damped) * F;
    run.measure("momentum", (P - given).norm() / given.norm());
    if (rate > 0.0) {
      run.exercises("boundaries/damping");
      measure_energy(run, dynamic);
      return;
    }
    const Particles<2>& p = simulation.body.particles;
    const Vector<2> way = 0.5 * simulation.time() * simulation.time() * a;
    double worst = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) worst = std::max(worst, (p.position[i] - p.reference_position[i] - way).norm());
    run.measure("displacement", worst / way.norm());
    measure_energy(run, dynamic);
  };
}

}  // namespace furrow::loads_cases
