#include "validation/tillage/rigid_cut.hpp"

#include <algorithm>
#include <cmath>

#include "harness/reference_data.hpp"

namespace furrow::tillage_cases {
namespace {

constexpr double bin = 1e-4;   ///< m of travel: that of the independent forces

/// Direction of the mean velocity of all soil that moves at half the speed of the face along its normal or faster.
double chip_direction(const Particles<2>& soil, const Blade& blade) {
  Vector<2> sum = Vector<2>::Zero();
  for (std::size_t i = 0; i < soil.size(); ++i)   // images behind them have mirrored velocities
    if (const Vector<2>& v = soil.velocity[i]; v.norm() > 0.5 * blade.speed * std::sin(blade.rake)) sum += v;
  return std::atan2(sum.y(), -sum.x());
}

}  // namespace

CutResult cut(Run& run, const Bed& bed, const Blade& blade, const ContactLaw& law, double window_start, bool pictures) {
  // Geometry, material, boundaries.
  Simulation<2> simulation;
  simulation.body = soil_body(bed, blade, run.resolution());
  Body<2>& body = simulation.body;
  simulation.control.courant = bed.courant;
  simulation.watch.low = {-0.5 * bed.length, -body.spacing};
  simulation.watch.high = {2.0 * bed.length, 4.0 * bed.height};
  RigidBody<2> rigid;
  rigid.contact.name = "blade";
  rigid.contact.law = law;
  rigid.start = outline_of(bed, blade);
  rigid.outline = Outline<2>::through(rigid.start, 0.0);
  rigid.displacement = [v = blade.speed](double t) { return Vector<2>(-v * t, 0.0); };
  rigid.velocity = [v = blade.speed](double) { return Vector<2>(-v, 0.0); };
  check_start(body, rigid.outline, blade, rigid.contact.range(body.spacing));
  body.rigid_bodies.push_back(std::move(rigid));

  // Probes: what has been given to the blade and to the floor so far, so that no peak falls between two rows.
  const double end = blade.travel / blade.speed;
  DynamicRun<2> dynamic(run, simulation);
  for (const int axis : {0, 1})
    dynamic.probe(
        {axis == 0 ? "impulse_x" : "impulse_y", axis == 0 ? "I_x" : "I_y", "N s", "impulse of the soil on the blade so far"},
        [axis](const Simulation<2>& s) { return s.body.rigid_bodies[0].contact.impulse()[axis]; });
  dynamic.probe({"penetration", "delta/dx", "1", "largest overlap of a particle with the blade so far, in spacings"},
                [](const Simulation<2>& s) { return s.body.rigid_bodies[0].contact.largest_penetration(); });
  dynamic.probe({"spring_energy", "E_s", "J", "energy in the springs of the contact"},
                [](const Simulation<2>& s) { return s.body.rigid_bodies[0].contact.last().stored; });
  dynamic.probe({"slip_dissipation", "E_c", "J", "energy lost to sliding along the blade"},
                [](const Simulation<2>& s) { return s.body.rigid_bodies[0].contact.slipped(); });
  const int bins = static_cast<int>(std::lround(blade.travel / bin));
  dynamic.until(end, bins, 8);
  exercise(run, bed.scheme);
  run.exercises("materials/drucker_prager");
  run.exercises("boundaries/boundary_layer");
  run.exercises("boundaries/contact");

  CutResult result{.history = {},
                   .draft = 0.0,
                   .vertical = 0.0,
                   .scatter = 0.0,
                   .peak = 0.0,
                   .peak_travel = 0.0,
                   .chip_direction = chip_direction(body.particles, blade),
                   .penetration = dynamic.column("penetration").back(),
                   .energy_imbalance = dynamic.energy_imbalance()};
  const std::vector<double>&t = dynamic.column("time"), &I_x = dynamic.column("impulse_x"), &I_y = dynamic.column("impulse_y");
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double dt = t[k] - t[k - 1];
    result.history.travel.push_back(0.5 * (t[k] + t[k - 1]) * blade.speed);
    result.history.draft.push_back((I_x[k] - I_x[k - 1]) / dt);
    result.history.vertical.push_back((I_y[k] - I_y[k - 1]) / dt);
    if (result.history.draft.back() > result.peak)
      result.peak = result.history.draft.back(), result.peak_travel = result.history.travel.back();
  }
  std::size_t first = 0;
  while (first + 1 < t.size() && t[first] * blade.speed < window_start - 1e-9) ++first;
  const double window = t.back() - t[first];
  result.draft = (I_x.back() - I_x[first]) / window;
  result.vertical = (I_y.back() - I_y[first]) / window;
  double square = 0.0;
  for (std::size_t k = first; k < result.history.draft.size(); ++k)
    square += std::pow(result.history.draft[k] - result.draft, 2) / static_cast<double>(result.history.draft.size() - first);
  result.scatter = std::sqrt(square) / result.draft;
  if (pictures) {
    const std::vector<std::pair<std::string, std::vector<Vector<2>>>> outlines{{"blade", body.rigid_bodies[0].outline.position}};
    picture(run, body, outlines, "plastic-strain", "Equivalent plastic strain", {"eps_p", "1"},
            [&body](std::size_t i) { return body.particles.plastic_strain[i]; });
    picture(run, body, outlines, "displacement", "Displacement", {"|u|", "m"},
            [&body](std::size_t i) { return (body.particles.position[i] - body.particles.reference_position[i]).norm(); });
  }
  return result;
}

std::optional<IndependentCut> independent_cut(double speed, bool friction, double from, double to) {
  const ReferenceData data = read_reference_data("blade-mpm");
  const auto &speeds = data.column("speed"), &frictions = data.column("friction"), &cells = data.column("cell"),
             &travel = data.column("travel");
  const auto is_it = [&](std::size_t k) { return std::abs(speeds[k] - speed) < 1e-9 && (frictions[k] > 0.5) == friction; };
  IndependentCut cut{.history = {}, .draft = 0.0, .vertical = 0.0, .cell = HUGE_VAL};
  for (std::size_t k = 0; k < data.rows(); ++k)
    if (is_it(k)) cut.cell = std::min(cut.cell, cells[k]);
  if (!std::isfinite(cut.cell)) return std::nullopt;
  double n = 0.0;
  for (std::size_t k = 0; k < data.rows(); ++k) {
    if (!is_it(k) || cells[k] > 1.001 * cut.cell) continue;
    cut.history.travel.push_back(travel[k]);
    cut.history.draft.push_back(data.column("draft")[k]);
    cut.history.vertical.push_back(data.column("vertical")[k]);
    if (travel[k] < from || travel[k] > to) continue;
    cut.draft += data.column("draft")[k], cut.vertical += data.column("vertical")[k], n += 1.0;
  }
  cut.draft /= n;
  cut.vertical /= n;
  return cut;
}

}  // namespace furrow::tillage_cases
