#include "validation/taylor-bar/impact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace furrow::taylor_bar_cases {
namespace {

constexpr double rest_growth = 1e-3;

double mean_since(const std::vector<double>& time, const std::vector<double>& value, double since) {
  double sum = 0.0, count = 0.0;
  for (std::size_t n = 0; n < time.size(); ++n)
    if (time[n] >= since) sum += value[n], count += 1.0;
  return sum / count;
}

}  // namespace

Outcome collide(Run& run, const Impact& impact) {
  const double dx = run.resolution().spacing;
  const Cells quarter = quarter_rod(impact.rod, dx, impact.arrangement);
  const Cells cells = impact.whole ? whole_rod(quarter) : quarter;

  Simulation<3> simulation;
  Body<3>& body = simulation.body;
  body.name = "rod";
  body.material = impact.material;
  body.scheme = impact.scheme;
  body.scheme.smoothing_ratio = run.resolution().smoothing_ratio;
  body.spacing = dx;
  body.add(cells.centre, {-impact.speed, 0.0, 0.0});
  Particles<3>& p = body.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.mass[i] = p.density[i] * cells.volume[i];
    if (impact.temperature) p.temperature[i] = *impact.temperature;
  }
  std::vector<SymmetryPlane<3>> planes{{Vector<3>::Zero(), Vector<3>::UnitX()}};
  if (!impact.whole) {
    planes.push_back({Vector<3>::Zero(), Vector<3>::UnitY()});
    planes.push_back({Vector<3>::Zero(), Vector<3>::UnitZ()});
  }
  body.images = Images<3>(planes);
  if (impact.scheme.frame == Frame::reference) simulation.control.stability = 0.85;
  // The impact is a jump of velocity: with a long first step the energy that it dissipates is off by a percent.
  simulation.control.first = 0.1;
  simulation.control.growth = 1.02;
  const double size = impact.rod.length + impact.rod.diameter;
  simulation.watch.low = Vector<3>::Constant(-3.0 * size);
  simulation.watch.high = Vector<3>::Constant(3.0 * size);

  const double c = p.sound_speed[0], transit = impact.rod.length / c;
  const double latest = 1.5 * impact.rod.length / impact.speed + 20.0 * transit;
  DynamicRun<3> dynamic(run, simulation);
  const double layer = cells.layer;
  dynamic.probe({"length", "L", "m", "length of the rod"},
                [layer](const Simulation<3>& s) { return shape_of(s.body, layer).length; });
  dynamic.probe({"foot_radius", "R_f", "m", "greatest radius"},
                [layer](const Simulation<3>& s) { return shape_of(s.body, layer).foot_radius; });
  const double kinetic = 0.5 * std::visit([](const auto& m) { return m.initial_state().density; }, impact.material) *
                         impact.rod.length * 0.25 * std::numbers::pi * std::pow(impact.rod.diameter * impact.speed, 2) *
                         (impact.whole ? 1.0 : 0.25);
  const auto last_transit = [c](const DynamicRun<3>& d) { return d.column("time").back() - 3.0 * d.column("length").back() / c; };
  dynamic.until(latest, static_cast<int>(std::ceil(8.0 * latest / transit)), 12, [&](const DynamicRun<3>& d) {
    const auto& t = d.column("time");
    const auto& work = d.column("plastic_work");
    const double since = last_transit(d);
    if (since < 3.0 * transit) return false;
    std::size_t n = t.size() - 1;
    while (n > 0 && t[n] > since) --n;
    return work.back() - work[n] < rest_growth * kinetic;
  });
  const auto& time = dynamic.column("time");
  if (time.back() >= latest) throw std::runtime_error(fmt::format("the rod is not at rest after {:.3g} s", latest));

  Outcome outcome;
  outcome.shape = shape_of(body, layer);
  outcome.rest_time = time.back();
  outcome.time = time;
  outcome.foot_radius_at = dynamic.column("foot_radius");
  outcome.length_at = dynamic.column("length");
  outcome.length = mean_since(time, dynamic.column("length"), last_transit(dynamic));
  outcome.foot_radius = mean_since(time, dynamic.column("foot_radius"), last_transit(dynamic));
  outcome.greatest_plastic_strain = *std::max_element(p.plastic_strain.begin(), p.plastic_strain.end());
  outcome.highest_temperature = *std::max_element(p.temperature.begin(), p.temperature.end());
  outcome.energy_imbalance = dynamic.energy_imbalance();
  outcome.viscous_share = dynamic.column("viscous_dissipation").back() / kinetic;
  double volume = 0.0, strained = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    volume += p.volume(i);
    if (p.plastic_strain[i] > 1.0) strained += p.volume(i);
    if (p.damage[i] >= 1.0) outcome.failed_share += 1.0 / static_cast<double>(p.size());
  }
  outcome.strained_share = strained / volume;
  return outcome;
}

}  // namespace furrow::taylor_bar_cases
