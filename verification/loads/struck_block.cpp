// A soft block falls on a stiff one, each with a step of its own: what one loses the other has, or those who hold it.
#include "solver/coupled_simulation.hpp"
#include "solver/io/coupled_checkpoint.hpp"
#include "verification/loads/problems.hpp"

namespace furrow::loads_cases {

Problem struck_block(const Parameters& input) {
  const Parameters soft_input = input.table("soft"), stiff_input = input.table("stiff");
  const LinearElastic soft_material = read_elastic(soft_input), stiff_material = read_elastic(stiff_input);
  const int n = static_cast<int>(input.integer("cells", 4, 100));
  const long columns = input.integer("columns", 4, 400), rows = input.integer("rows", 2, 100);
  const double refinement = input.number("refinement", range::positive);
  const double v_0 = input.quantity("velocity", dimension::velocity, range::positive);
  const double off_centre = input.number("off_centre", {-0.5, 0.5, false, false});
  const bool held = input.choice("tool", {"free", "held"}) == "held";
  const Parameters law = input.table("contact");
  const double damping = law.number("damping", {0.0, 1.0}), friction = law.number("friction", range::not_negative);
  const double passes = input.number("passes", range::positive);
  const double courant = input.number("courant", range::positive);
  const Scheme scheme = read_scheme(input);

  return [=](Run& run) {
    const double dx = run.resolution().spacing, d = dx / refinement;
    const double L = static_cast<double>(columns) * d, H = static_cast<double>(rows) * d;
    const double M = soft_material.bulk_modulus + 4.0 / 3.0 * soft_material.shear_modulus;
    const double c = std::sqrt(M / soft_material.reference_density);

    CoupledSimulation coupled;
    coupled.soft.body = elastic_body(run, soft_material, scheme);
    coupled.soft.body.add(block(n, n, dx, {off_centre * L - 0.5 * n * dx, 0.01 * dx}), {0.4 * v_0, -v_0});
    coupled.soft.control.courant = courant;
    Body<2>& tool = coupled.stiff.body;
    tool = elastic_body(run, stiff_material, scheme);
    tool.name = "tool";
    tool.spacing = d;
    tool.add(block(static_cast<int>(columns), static_cast<int>(rows), d, {-0.5 * L, -H}));
    const auto id = [&](long i, long j) { return static_cast<std::int32_t>(i * rows + j); };

    // The outline goes through the corners alone: forces between them are shared by two particles that may be far apart.
    coupled.surface.ids = {id(0, 0), id(columns - 1, 0), id(columns - 1, rows - 1), id(0, rows - 1)};
    for (const std::int32_t corner : coupled.surface.ids)
      coupled.surface.start.push_back(tool.particles.position[static_cast<std::size_t>(corner)]);
    coupled.surface.radius = 0.5 * d;
    if (held)   // both lower corners, each by a hand of its own
      for (const std::int32_t corner : {id(0, 0), id(columns - 1, 0)})
        tool.loads.motions.push_back({"hand", {corner}, [](double) { return Vector<2>(Vector<2>::Zero()); }});
    coupled.contact.name = "tool";
    coupled.contact.law.stiffness = coupled.contact.law.sticking_stiffness = M;
    coupled.contact.law.damping = damping;
    coupled.contact.law.friction = friction;
    coupled.couple();

    DynamicRun<2> dynamic(run, coupled.soft);
    dynamic.carry([&](Checkpoint& checkpoint) { save_stiff(coupled, checkpoint); },
                  [&](const Checkpoint& checkpoint) { load_stiff(checkpoint, coupled); });
    dynamic.probe({"energy_error", "dE", "J", "energy of both bodies less what came from outside"},
                  [&](const Simulation<2>&) { return coupled.energy_error(); });
    // Virtual work: forces are shared among nodes as the velocity of the surface is read from them.
    dynamic.probe({"power_given", "P", "W", "power of contact on the outline, by its surface"},
                  [&](const Simulation<2>&) { return -coupled.contact.last().surface_power; });
    dynamic.probe({"power_taken", "P_n", "W", "power of contact on the outline, by its nodes"}, [&](const Simulation<2>&) {
      double sum = 0.0;
      for (std::size_t k = 0; k < coupled.outline().size(); ++k)
        sum += coupled.node_forces()[k].dot(coupled.outline().velocity[k]);
      return sum;
    });
    const Vector<2> before = static_cast<double>(n * n) * soft_material.reference_density * dx * dx * Vector<2>(0.4 * v_0, -v_0);
    const double energy = 0.5 * before.norm() * v_0 * std::sqrt(1.16);
    dynamic.until(passes * n * dx / c, 200, 2);
    exercise(run, scheme);
    for (const char* module : {"boundaries/contact", "boundaries/held_forces", "coupled_simulation"}) run.exercises(module);
    run.count(static_cast<long>(coupled.stiff.steps()), static_cast<long>(tool.particles.size()));

    // Contact is over: everything has been handed on.
    const Vector<2> P_soft = coupled.soft.momentum(), P_tool = coupled.stiff.momentum();
    const auto& I = coupled.impulses();
    run.measure("momentum", (P_soft + P_tool - before - I.actuator).norm() / before.norm());
    run.measure("exchange", (P_tool - I.contact - I.actuator).norm() / before.norm());
    run.measure("reaction", (I.soil + I.contact + I.pending).norm() / I.soil.norm());
    run.measure("rebound", P_soft[1] / -before[1]);
    run.measure("sub_steps", static_cast<double>(coupled.sub_steps()) / static_cast<double>(coupled.soft.steps()));
    double worst = 0.0, gap = 0.0, largest = 0.0;
    const auto &given = dynamic.column("power_given"), &taken = dynamic.column("power_taken");
    for (const double e : dynamic.column("energy_error")) worst = std::max(worst, std::abs(e));
    for (std::size_t k = 0; k < given.size(); ++k) {
      gap = std::max(gap, std::abs(given[k] - taken[k]));
      largest = std::max(largest, std::abs(given[k]));
    }
    double apart = 0.0;
    for (std::size_t k = 0; k < coupled.surface.ids.size(); ++k)
      apart = std::max(apart, (coupled.outline().velocity[k] - tool.particles.velocity[tool.index_of(coupled.surface.ids[k])]).norm());
    run.measure("outline", apart / v_0);
    run.measure("power", gap / largest);
    run.measure("energy_error", worst / energy);
  };
}

}  // namespace furrow::loads_cases
