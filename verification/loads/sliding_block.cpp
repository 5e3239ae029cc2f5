// A block slides over a rigid floor that it does not stick to: Coulomb's law for the impulses, and equal and opposite forces.
#include "verification/loads/problems.hpp"

namespace furrow::loads_cases {

Problem sliding_block(const Parameters& input) {
  const LinearElastic material = read_elastic(input);
  const int columns = static_cast<int>(input.integer("columns", 4, 200)), rows = static_cast<int>(input.integer("rows", 4, 200));
  const double g = input.quantity("gravity", dimension::acceleration, range::positive);
  const double v_0 = input.quantity("velocity", dimension::velocity, range::positive);
  const double mu = input.number("friction", range::positive);
  const double slowing = input.number("slowing", {0.0, 1.0, true, true});
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing, h = run.resolution().smoothing_length(), L = columns * dx;
    const double M = material.bulk_modulus + 4.0 / 3.0 * material.shear_modulus, c = std::sqrt(M / material.reference_density);
    const double end = slowing * v_0 / (mu * g), travel = v_0 * end;

    Simulation<2> simulation;
    Body<2>& body = simulation.body;
    body = elastic_body(run, material, scheme);
    body.add(block(columns, rows, dx, {0.0, 0.0}), {v_0, 0.0});
    body.loads.gravity = {0.0, -g};
    // Equal steps, a whole number of them in a row of the history: kicks and the contact's own sum then weigh forces alike.
    constexpr int history_rows = 200;
    simulation.control.largest = end / (history_rows * std::ceil(end / history_rows / (0.2 * h / c))) * (1.0 + 1e-12);
    simulation.control.fixed = true;
    RigidBody<2> floor;
    floor.contact.name = "floor";
    floor.contact.law.stiffness = floor.contact.law.sticking_stiffness = M;
    floor.contact.law.friction = mu;
    floor.start = {{-L, -L}, {2.0 * L + travel, -L}, {2.0 * L + travel, 0.0}, {-L, 0.0}};
    floor.outline = Outline<2>::through(floor.start, 0.0);
    body.rigid_bodies.push_back(floor);

    DynamicRun<2> dynamic(run, simulation);
    dynamic.until(end, history_rows, 1);
    exercise(run, scheme);
    run.exercises("boundaries/contact");
    run.exercises("boundaries/gravity");

    const Contact<2>& contact = body.rigid_bodies[0].contact;
    double mass = 0.0;
    for (const double m : body.particles.mass) mass += m;
    // The last look counts whole in the contact's sum and half in the motion so far.
    const Vector<2> impulse = contact.impulse() - 0.5 * simulation.dt() * contact.last().force;
    const Vector<2> given = mass * Vector<2>(v_0, -g * simulation.time()) - impulse;
    run.measure("friction", impulse[0] / -impulse[1], "1", {mu, 0.0});
    run.measure("momentum", (simulation.momentum() - given).norm() / (mass * v_0));
    measure_energy(run, dynamic);
    elastodynamic_cases::history_figure(run, dynamic, "momentum", "Momentum of the block", {"momentum_x", "momentum_y"},
                                        {"P", "N s"});
  };
}

}  // namespace furrow::loads_cases
