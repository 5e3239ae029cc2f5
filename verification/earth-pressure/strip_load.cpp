// Prandtl 1920: a rough rigid strip is pressed into clay without friction and without weight; half of it beside a plane of symmetry.
#include <algorithm>
#include <cmath>

#include "reference/exact/earth_pressure.hpp"
#include "verification/earth-pressure/problems.hpp"

namespace furrow::earth_pressure_cases {

Problem strip_load(const Parameters& input) {
  const Soil soil = read_soil(input);
  if (soil.law.cone.alpha != 0.0) input.fail("material", "found a soil with friction, expected one without: its bearing would need its weight");
  const double half = input.quantity("half_width", dimension::length, range::positive);
  const double L = input.quantity("length", dimension::length, range::positive);
  const double D = input.quantity("depth", dimension::length, range::positive);
  const double way = input.quantity("way", dimension::length, range::positive);
  const double end = input.quantity("end_time", dimension::time, range::positive);
  const double courant = input.number_or("courant", 0.4, range::positive);
  const Scheme scheme = read_scheme(input);
  return [=](Run& run) {
    const double dx = run.resolution().spacing;
    Simulation<2> simulation;
    simulation.body = soil_body(run, soil.law, scheme, 0.0);
    Body<2>& body = simulation.body;
    body.add(rectangle({0.0, -D}, L, D, dx));
    body.images = Images<2>({SymmetryPlane<2>{{0.0, 0.0}, {1.0, 0.0}}, SymmetryPlane<2>{{L, 0.0}, {-1.0, 0.0}},
                             SymmetryPlane<2>{{0.0, -D}, {0.0, 1.0}}});
    // The strip is the upper row of particles under it; the width of its columns is the strip's.
    const double start = 0.1 * end;
    PrescribedMotion<2> strip{"strip", {}, [=](double t) { return Vector<2>(0.0, -way / (0.95 * end) * std::min(1.0, t / start)); }};
    for (std::size_t i = 0; i < body.particles.size(); ++i)
      if (body.particles.position[i][1] > -dx && body.particles.position[i][0] < half) strip.ids.push_back(body.particles.id[i]);
    const double width = dx * static_cast<double>(strip.ids.size());
    body.loads.motions.push_back(strip);
    simulation.control.courant = courant;
    simulation.watch.low = {-dx, -D - dx};
    simulation.watch.high = {L + dx, D};

    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"bearing", "q", "Pa", "force on the strip over its width"},
                  [width](const Simulation<2>& s) { return s.body.reactions()[0][1] / width; });
    dynamic.until(end, 400, 2);
    exercise_soil(run, scheme);
    run.exercises("boundaries/prescribed_motion");

    const std::vector<double>& q = dynamic.column("bearing");
    double plateau = 0.0, samples = 0.0;
    for (std::size_t k = q.size() - q.size() / 5; k < q.size(); ++k) plateau += q[k], samples += 1.0;
    run.measure("bearing_capacity", plateau / samples / soil.law.cone.k, "1", {exact::bearing_cohesion(0.0), 0.0});
    run.measure("energy_imbalance", dynamic.energy_imbalance());
    Figure& figure = run.figure({.name = "bearing", .title = "Load on the strip", .x = {"time", "s"}, .y = {"q/c", "1"}});
    Series computed{.label = "computed", .x = dynamic.column("time")};
    for (const double load : q) computed.y.push_back(load / soil.law.cone.k);
    figure.series = {computed, {.label = "2 + pi", .role = "reference", .x = {0.0, end}, .y = {exact::bearing_cohesion(0.0), exact::bearing_cohesion(0.0)}}};
  };
}

}  // namespace furrow::earth_pressure_cases
