#include "validation/tillage/coupled_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/io/coupled_checkpoint.hpp"
#include "solver/io/particle_snapshot.hpp"

namespace furrow::tillage_cases {

CoupledSetup read_coupled(const Parameters& input) {
  const Bed bed = read_bed(input);
  const Blade blade = read_blade(input, bed);
  CoupledSetup setup{.bed = bed,
                     .blade = blade,
                     .tool = read_tool(input, blade),
                     .interface = read_interface(input, bed, blade),
                     .stone = read_stone(input, bed, blade),
                     .stone_contact = {},
                     .end_time = blade.travel / blade.speed,
                     .single_rate = input.flag_or("single_rate", false),
                     .snapshots = static_cast<int>(input.integer_or("snapshots", 14, 1, 1000)),
                     .rows = static_cast<int>(input.integer_or("rows", 700, 10, 100'000))};
  // Metal on stone: the stone is as stiff as a layer of the tool's particles.
  setup.stone_contact.stiffness = setup.tool.bulk_modulus + 4.0 / 3.0 * setup.tool.shear_modulus;
  setup.stone_contact.damping = 0.1;
  return setup;
}

namespace {

/// Soil under and in front of the tool, without what a stone fills; tool and contact beside it.
void set_up(CoupledSimulation& coupled, const CoupledSetup& s, const Resolution& resolution) {
  Simulation<2>& soft = coupled.soft;
  soft.body =
      soil_body(s.bed, s.blade, resolution, s.stone ? std::optional(std::pair(s.stone->centre, s.stone->radius)) : std::nullopt);
  soft.control.courant = s.bed.courant;
  soft.watch.low = {-0.5 * s.bed.length, -soft.body.spacing};
  soft.watch.high = {2.0 * s.bed.length, 6.0 * s.bed.height};
  add_tool(coupled, s.tool, s.bed, s.blade);
  coupled.contact.name = "tool";
  coupled.contact.law = s.interface.contact;
  coupled.single_rate = s.single_rate;
  if (s.stone) {
    RigidBody<2> stone;
    stone.contact.name = "stone";
    stone.contact.law = s.interface.contact;
    stone.start = {s.stone->centre};
    stone.outline = Outline<2>::through(stone.start, s.stone->radius);
    soft.body.rigid_bodies.push_back(stone);
    stone.contact.law = s.stone_contact;
    coupled.stiff.body.rigid_bodies.push_back(std::move(stone));
  }
  couple(coupled, s.interface);
  check_start(soft.body, coupled.outline(), s.blade, coupled.contact.range(soft.body.spacing));
}

}  // namespace

CoupledResult coupled_cut(Run& run, const CoupledSetup& s) {
  CoupledSimulation coupled;
  set_up(coupled, s, run.resolution());
  Simulation<2>& soft = coupled.soft;
  const Vector<2> n = s.blade.normal(), u = s.blade.along();

  // Probes. What soil and stone have given so far; forces are differences from row to row.
  DynamicRun<2> dynamic(run, soft);
  dynamic.carry([&](Checkpoint& checkpoint) { save_stiff(coupled, checkpoint); },
                [&](const Checkpoint& checkpoint) { load_stiff(checkpoint, coupled); });
  const auto add = [&](const char* name, const char* symbol, const char* unit, const char* meaning,
                       std::function<double()> value) {
    dynamic.probe({name, symbol, unit, meaning}, [value = std::move(value)](const Simulation<2>&) { return value(); });
  };
  const auto given = [&]() -> Vector<2> { return coupled.impulses().stones - coupled.impulses().soil; };
  const Vector<2> momentum_start = [&] {
    Vector<2> sum = Vector<2>::Zero();
    const Particles<2>& p = coupled.stiff.body.particles;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.velocity[i];
    return sum;
  }();
  for (const int axis : {0, 1}) {
    add(axis ? "impulse_y" : "impulse_x", axis ? "I_y" : "I_x", "N s", "impulse of soil and stone on the tool so far",
        [=] { return given()[axis]; });
    add(axis ? "actuator_impulse_y" : "actuator_impulse_x", axis ? "I_ay" : "I_ax", "N s",
        "impulse of the actuator on the tool so far",
        [&coupled, axis] { return coupled.impulses().actuator[axis] - coupled.impulses().rigid[axis]; });
  }
  add("tip_deflection", "w", "m", "deflection of the tool's end against its motion, along the face's normal",
      [&] { return tip_deflection(coupled, s.tool, s.blade); });
  add("beam_deflection", "w_b", "m", "deflection of a cantilever under the soil's forces of this moment",
      [&] { return beam_deflection(coupled, s.tool, s.blade); });
  add("clamp_moment", "M", "N", "moment at the clamp per width", [&] { return clamp_moment(coupled, s.tool, s.bed, s.blade); });
  add("plastic_moment", "M_p", "N", "moment per width of the section that has flowed most, at its current flow stress",
      [&] { return plastic_moment(coupled, s.tool, s.blade); });
  add("tool_plastic_strain", "eps_p", "1", "greatest equivalent plastic strain in the tool",
      [&] { return greatest(coupled.stiff.body.particles.plastic_strain); });
  add("tool_damage", "D", "1", "greatest damage in the tool", [&] { return greatest(coupled.stiff.body.particles.damage); });
  add("tool_softened", "n_s", "1", "particles of the tool whose fracture has begun",
      [&] { return softened_particles(coupled); });
  add("tool_failed", "n_f", "1", "failed particles of the tool", [&] { return failed_particles(coupled); });
  add("penetration", "delta/dx", "1", "largest overlap of soil and tool so far, in spacings of the soil",
      [&] { return coupled.contact.largest_penetration(); });
  add("stone_penetration", "delta_s/dx_t", "1", "largest overlap of tool and stone so far, in spacings of the tool", [&] {
    const auto& stones = coupled.stiff.body.rigid_bodies;
    return stones.empty() ? 0.0 : stones[0].contact.largest_penetration();
  });
  add("actuator_work", "W_a", "J", "work of the actuator on the tool", [&] { return coupled.actuator_work(); });
  add("tool_kinetic", "E_kt", "J", "kinetic energy of the tool", [&] { return coupled.stiff.energy().kinetic; });
  add("tool_elastic", "E_et", "J", "elastic energy of the tool", [&] { return coupled.stiff.energy().elastic; });
  add("tool_plastic", "E_pt", "J", "plastic work in the tool", [&] { return coupled.stiff.energy().plastic; });
  add("tool_viscous", "E_vt", "J", "viscous dissipation in the tool",
      [&] { return coupled.stiff.energy().viscous + coupled.stiff.energy().artificial; });
  add("energy_error", "dE", "J", "energy of soil and tool less what came from outside", [&] { return coupled.energy_error(); });
  // The tool's particles beside each snapshot of the soil.
  dynamic.with_snapshots([&](int number) {
    const auto file = run.folder() / fmt::format("tool-{:04d}.vtkhdf", number);
    furrow::write_snapshot(file, particle_snapshot(coupled.stiff.body.particles, coupled.stiff.time()));
    run.file("snapshots", file);
  });
  dynamic.until(s.end_time, s.rows, s.snapshots);
  exercise(run, s.bed.scheme);
  exercise(run, s.tool.scheme);
  for (const char* module : {"materials/drucker_prager", "boundaries/boundary_layer", "boundaries/contact",
                             "boundaries/prescribed_motion", "coupled_simulation"})
    run.exercises(module);
  run.exercises("materials/" +
                std::string(std::visit([](const auto& law) { return std::string(law.name); }, s.tool.material.law)));
  run.count(static_cast<long>(coupled.stiff.steps()), static_cast<long>(coupled.stiff.body.particles.size()));

  // Results.
  CoupledResult result{};
  CoupledHistory& h = result.history;
  const std::vector<double>&t = dynamic.column("time"), &I_x = dynamic.column("impulse_x"), &I_y = dynamic.column("impulse_y"),
        &A_x = dynamic.column("actuator_impulse_x");
  const double sign = -1.0;   // the blade moves to the left
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double dt = t[k] - t[k - 1];
    const Vector<2> F((I_x[k] - I_x[k - 1]) / dt, (I_y[k] - I_y[k - 1]) / dt);
    h.time.push_back(0.5 * (t[k] + t[k - 1]));
    h.step.push_back(dt);
    h.travel.push_back(h.time.back() * s.blade.speed);
    h.normal.push_back(-F.dot(n));
    h.tangential.push_back(F.dot(u));
    h.draft.push_back(F[0]);
    h.vertical.push_back(F[1]);
    h.whole.push_back(F.norm());
    h.actuator.push_back(sign * (A_x[k] - A_x[k - 1]) / dt);
    for (const auto& [column, name] : {std::pair{&h.deflection, "tip_deflection"}, std::pair{&h.beam, "beam_deflection"},
                                       std::pair{&h.moment, "clamp_moment"}, std::pair{&h.plastic_moment, "plastic_moment"},
                                       std::pair{&h.plastic_strain, "tool_plastic_strain"}, std::pair{&h.softened, "tool_softened"},
                                       std::pair{&h.failed, "tool_failed"}})
      column->push_back(dynamic.column(name)[k]);
  }
  result.penetration = dynamic.column("penetration").back();
  result.stone_penetration = dynamic.column("stone_penetration").back();
  double error = 0.0;
  for (const double e : dynamic.column("energy_error")) error = std::max(error, std::abs(e));
  result.energy_error = error / dynamic.column("actuator_work").back();
  const auto& I = coupled.impulses();
  result.momentum_error =
      (coupled.stiff.momentum() - momentum_start - I.contact - I.stones - I.actuator).norm() / I.actuator.norm();
  result.exchange_error = (I.soil + I.contact + I.rigid + I.pending).norm() / (I.contact + I.rigid).norm();
  result.sub_steps = static_cast<double>(coupled.stiff.steps()) / static_cast<double>(soft.steps());
  result.soil_particles = static_cast<long>(soft.body.particles.size());
  result.tool_particles = static_cast<long>(coupled.stiff.body.particles.size());

  // Pictures at the end.
  const Body<2>& soil = soft.body;
  const std::vector<std::pair<std::string, std::vector<Vector<2>>>> outlines{{"tool", coupled.outline().position}};
  picture(run, soil, outlines, "plastic-strain", "Equivalent plastic strain of the soil", {"eps_p", "1"},
          [&](std::size_t i) { return soil.particles.plastic_strain[i]; });
  picture(run, soil, outlines, "displacement", "Displacement of the soil", {"|u|", "m"},
          [&](std::size_t i) { return (soil.particles.position[i] - soil.particles.reference_position[i]).norm(); });
  Figure& force =
      run.figure({.name = "force", .title = "Force on the tool", .x = {"time", "s"}, .y = {"force per width", "N/m"}});
  force.add({.label = "normal to the face", .x = h.time, .y = h.normal});
  force.add({.label = "up the face", .x = h.time, .y = h.tangential});
  Figure& tip =
      run.figure({.name = "deflection", .title = "Deflection of the tool's end", .x = {"time", "s"}, .y = {"deflection", "m"}});
  tip.add({.label = "computed", .x = h.time, .y = h.deflection});
  tip.add({.label = "cantilever under the same forces", .role = "reference", .x = h.time, .y = h.beam});
  result.gain = static_cast<double>(result.soil_particles + result.tool_particles) /
                (static_cast<double>(result.tool_particles) + static_cast<double>(result.soil_particles) / result.sub_steps);
  return result;
}

void measure_coupling(Run& run, const CoupledResult& result) {
  run.measure("penetration", result.penetration);
  run.measure("energy_error", result.energy_error);
  run.measure("momentum_error", result.momentum_error);
  run.measure("exchange_error", result.exchange_error);
  run.measure("sub_steps", result.sub_steps);
  run.measure("gain", result.gain);
}

double mean_over(const CoupledHistory& h, const std::vector<double>& column, double from, double to) {
  double sum = 0.0, time = 0.0;
  for (std::size_t k = 0; k < h.time.size(); ++k)
    if (h.time[k] >= from && h.time[k] <= to) sum += h.step[k] * column[k], time += h.step[k];
  return time > 0.0 ? sum / time : std::numeric_limits<double>::quiet_NaN();
}

std::array<Stage, 5> stages_of(const CoupledHistory& h, double filter_time) {
  StageDefinition definition;
  definition.filter = filter_time;
  return force_stages({h.time, h.whole, h.deflection, h.plastic_strain, h.softened, h.failed}, definition);
}

void stage_figure(Run& run, const CoupledHistory& h, const std::array<Stage, 5>& stages, double filter_time) {
  Figure& figure = run.figure({.name = "stages",
                               .title = "Stages of the force on the tool",
                               .caption = in_words(stages),
                               .x = {"time", "s"},
                               .y = {"force per width", "N/m"}});
  figure.add({.label = "mean", .x = h.time, .y = smoothed(h.time, h.whole, filter_time)});
  for (const Stage& stage : stages)
    if (stage.present)
      figure.add({.label = std::string(stage.name),
                  .role = "bound",
                  .x = {stage.begin, stage.end},
                  .y = {stage.force_begin, stage.force_end}});
}

}  // namespace furrow::tillage_cases
