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
    // The ground beyond depth and length is held, and so is the strip by what drives it: particles bonded to the soil, as deep as the
    // kernel reaches. A base on which the layer could slide would carry less than a half-space does (Hill 1950).
    const int rows = static_cast<int>(std::ceil(support(scheme.kernel) * body.scheme.smoothing_ratio - 1e-9));
    const double held = rows * dx, start = 0.1 * end;
    body.add(rectangle({0.0, -D - held}, L + held, D + held, dx));
    const std::size_t ground = body.particles.size();
    body.add(rectangle({0.0, 0.0}, half, held, dx));
    PrescribedMotion<2> rest{"ground", {}, [](double) { return Vector<2>(Vector<2>::Zero()); }};
    PrescribedMotion<2> strip{"strip", {}, [=](double t) { return Vector<2>(0.0, -way / (0.95 * end) * std::min(1.0, t / start)); }};
    for (std::size_t i = 0; i < body.particles.size(); ++i) {
      const Vector<2>& x = body.particles.position[i];
      if (i >= ground) strip.ids.push_back(body.particles.id[i]);
      else if (x[0] > L || x[1] < -D) rest.ids.push_back(body.particles.id[i]);
    }
    body.loads.motions = {strip, rest};
    body.images = Images<2>({SymmetryPlane<2>{{0.0, 0.0}, {1.0, 0.0}}});
    simulation.control.courant = courant;
    simulation.watch.low = {-dx, -D - held - dx};
    simulation.watch.high = {L + held + dx, D};

    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"bearing", "q", "Pa", "force on the strip over its width"},
                  [half](const Simulation<2>& s) { return s.body.reactions()[0][1] / half; });
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
