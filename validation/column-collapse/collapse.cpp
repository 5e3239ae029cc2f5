// The collapse itself: set-up, run, and what is read from it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "validation/column-collapse/problems.hpp"

namespace furrow::column_collapse_cases {

SoilColumn read_soil_column(const Parameters& input) {
  const Soil soil = read_soil(input);
  SoilColumn c{.soil = soil,
           .resting = {},
           .left = input.quantity_or("left", dimension::length, 0.0),
           .bottom = input.quantity_or("bottom", dimension::length, 0.0),
           .width = input.quantity("width", dimension::length, range::positive),
           .height = input.quantity("height", dimension::length, range::positive),
           .floor_length = input.quantity("floor_length", dimension::length, range::positive),
           .floor = input.choice_or("floor", "rough", {"rough", "smooth"}) == "rough" ? Slip::none : Slip::free,
           .gate_speed = input.quantity_or("gate_speed", dimension::velocity, 0.0, range::not_negative),
           .gravity = input.quantity_or("gravity", dimension::acceleration, 9.81, range::positive),
           .end_time = input.quantity("end_time", dimension::time, range::positive),
           .courant = input.number_or("courant", 0.4, range::positive),
           .rest_speed = input.quantity_or("rest_speed", dimension::velocity, 0.05, range::positive),
           .rest_held = 0.0,
           .scheme = read_scheme(input)};
  c.rest_held = input.quantity_or("rest_held", dimension::time, 3.0 * std::sqrt(c.height / c.gravity), range::positive);
  c.resting = read_resting_ratio(input, soil.law, soil.law.reference_density * c.gravity * c.height);
  if (c.left < 0.0) input.fail("left", fmt::format("found {:g} m, expected 0 or more: the soil would overlap the wall at x = 0", c.left));
  if (c.bottom < 0.0) input.fail("bottom", fmt::format("found {:g} m, expected 0 or more: the soil would overlap the floor at y = 0", c.bottom));
  if (c.floor_length < c.left + c.width)
    input.fail("floor_length", "found a floor that ends under the column, expected one that it can run out on");
  return c;
}

namespace {

/// Particles of soil, by index.
std::vector<std::size_t> soil_of(const Body<2>& body) {
  std::vector<std::size_t> soil;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    if (!body.is_in_layer(i)) soil.push_back(i);
  return soil;
}

Surface surface_now(const Body<2>& body, double window) {
  std::vector<double> centres;
  for (const std::size_t i : soil_of(body)) centres.push_back(body.particles.position[i][0]);
  return surface_of(centres, body.spacing * body.spacing, body.spacing, window);
}

/// The front as a reader of a picture finds it: single particles that have jumped ahead do not count.
double front_of(const Body<2>& body) {
  const Particles<2>& p = body.particles;
  double front = 0.0;
  for (const std::size_t i : soil_of(body)) {
    if (p.position[i][0] <= front) continue;
    int near = 0;
    for (const std::int32_t at : body.neighbours().row(i)) {
      const auto j = static_cast<std::size_t>(at);
      if (j < p.size() && !body.is_in_layer(j) && (p.position[i] - p.position[j]).norm() < 2.0 * body.spacing) ++near;
    }
    if (near >= 4) front = p.position[i][0];
  }
  return front;
}

constexpr double still_moving = 0.01;   ///< share of the mass that may be faster than the speed of rest in a heap at rest

/// Time from which on a heap is at rest to the end of its history.
double rest_time_of(const std::vector<double>& time, const std::vector<double>& moving) {
  double rest = time.back();
  for (std::size_t k = time.size(); k-- > 0 && moving[k] < still_moving;) rest = time[k];
  return rest;
}

double volume_of(const Body<2>& body) {
  double volume = 0.0;
  for (const std::size_t i : soil_of(body)) volume += body.particles.volume(i);
  return volume;
}

}  // namespace

Collapsed collapse(Run& run, const SoilColumn& c, double window) {
  const double dx = run.resolution().spacing;

  // Geometry: the column at the smooth wall, which is a plane of symmetry, on the floor.
  Simulation<2> simulation;
  Body<2>& body = simulation.body;
  body.name = "soil";
  body.material = c.soil.law;
  body.scheme = c.scheme;
  body.scheme.smoothing_ratio = run.resolution().smoothing_ratio;
  body.spacing = dx;
  body.loads.gravity = {0.0, -c.gravity};
  body.add(rectangle({c.left, c.bottom}, c.width, c.height, dx));
  body.images = Images<2>({SymmetryPlane<2>{{0.0, 0.0}, {1.0, 0.0}}});
  add_flat_layer(body, "floor", {0.0, 0.0}, {c.floor_length, 0.0}, c.floor);
  if (c.gate_speed > 0.0)
    add_flat_layer(body, "gate", {c.left + c.width, 0.0}, {c.left + c.width, c.bottom + c.height}, Slip::free,
                   [v = c.gate_speed](double) { return Vector<2>(0.0, v); });
  check_clear(body);
  // A sheet of single particles that stretches has no pressure, and would sink into the floor: its particles find a hold where
  // they are closer to it than any particle of a heap.
  const double stiffness = c.soil.law.bulk_modulus + 4.0 / 3.0 * c.soil.law.shear_modulus, sine = 3.0 * c.soil.law.cone.alpha;
  const double grip = c.floor == Slip::none ? sine / std::sqrt(1.0 - sine * sine) : 0.0;
  body.walls.push_back({.point = {0.0, 0.0}, .normal = {0.0, 1.0}, .stiffness = stiffness, .reach = 0.3, .friction = grip});

  // Start: at rest, stress geostatic.
  set_geostatic(body, c.soil.law, c.bottom + c.height, c.resting);
  simulation.control.courant = c.courant;
  simulation.watch.low = {-0.5 * dx, -0.5 * dx};
  simulation.watch.high = {2.0 * c.floor_length, 10.0 * c.height + c.gate_speed * c.end_time};

  // Probes: what moves, how fast, how far. The crest is the upper particle at the face.
  std::int32_t crest = 0;
  for (std::size_t i = 0; i < body.particles.size(); ++i) {
    const Vector<2>&x = body.particles.position[i], &best = body.particles.position[static_cast<std::size_t>(crest)];
    if (x[1] > best[1] || (x[1] == best[1] && x[0] > best[0])) crest = static_cast<std::int32_t>(i);
  }
  const double crest_start = body.particles.position[static_cast<std::size_t>(crest)][1];
  DynamicRun<2> dynamic(run, simulation);
  dynamic.probe({"moving_fraction", "m_v/m", "1", "share of the mass that is faster than the speed of rest"},
                [v = c.rest_speed](const Simulation<2>& s) {
                  const std::vector<std::size_t> soil = soil_of(s.body);
                  double moving = 0.0;
                  for (const std::size_t i : soil) moving += s.body.particles.velocity[i].norm() > v ? 1.0 : 0.0;
                  return moving / static_cast<double>(soil.size());
                });
  // A rag of a single particle is not what a reader calls the speed of a slide.
  dynamic.probe({"greatest_speed", "v_max", "m/s", "speed that all but a thousandth of the mass stay below"}, [](const Simulation<2>& s) {
    std::vector<double> speeds;
    for (const std::size_t i : soil_of(s.body)) speeds.push_back(s.body.particles.velocity[i].norm());
    const auto at = speeds.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(speeds.size() - 1));
    std::nth_element(speeds.begin(), at, speeds.end());
    return *at;
  });
  dynamic.probe({"front", "x_f", "m", "farthest particle that is no single one"},
                [](const Simulation<2>& s) { return front_of(s.body); });
  dynamic.probe({"crest_settlement", "u_c", "m", "settlement of the upper particle at the face"},
                [crest, crest_start](const Simulation<2>& s) { return crest_start - s.body.particles.position[s.body.index_of(crest)][1]; });
  dynamic.probe({"surface_at_30", "x_30", "m", "where the surface falls through 0.3 of the initial height"},
                [&c, window](const Simulation<2>& s) { return position_at(surface_now(s.body, window), 0.3 * c.height); });
  for (const int axis : {0, 1})
    dynamic.probe({axis == 0 ? "centre_x" : "centre_y", axis == 0 ? "x_c" : "y_c", "m", "centre of mass of the soil"},
                  [axis](const Simulation<2>& s) {
                    const std::vector<std::size_t> soil = soil_of(s.body);
                    double sum = 0.0;
                    for (const std::size_t i : soil) sum += s.body.particles.position[i][axis];
                    return sum / static_cast<double>(soil.size());
                  });
  const double volume = c.width * c.height;
  dynamic.until(c.end_time, 300, 8, [&c](const DynamicRun<2>& so_far) {
    const std::vector<double>&t = so_far.column("time"), &moving = so_far.column("moving_fraction");
    // Before it is released a heap is at rest as well.
    const bool has_moved = std::any_of(moving.begin(), moving.end(), [](double m) { return m >= still_moving; });
    return has_moved && t.back() - rest_time_of(t, moving) >= c.rest_held;
  });
  exercise(run, c.scheme);
  run.exercises("materials/drucker_prager");
  run.exercises("boundaries/boundary_layer");
  run.exercises("particles/images");

  const std::vector<double>&t = dynamic.column("time"), &moving = dynamic.column("moving_fraction"), &speed = dynamic.column("greatest_speed");
  Collapsed end{.surface = surface_now(body, window),
                .rest_time = rest_time_of(t, moving),
                .greatest_speed = 0.0,
                .time_of_greatest_speed = 0.0,
                .crest_settlement = dynamic.column("crest_settlement").back(),
                .front = dynamic.column("front").back(),
                .late_motion = 0.0,
                .volume_change = volume_of(body) / volume - 1.0,
                .energy_imbalance = dynamic.energy_imbalance()};
  const auto fastest = static_cast<std::size_t>(std::max_element(speed.begin(), speed.end()) - speed.begin());
  end.greatest_speed = speed[fastest];
  end.time_of_greatest_speed = t[fastest];

  const std::vector<double>&x_c = dynamic.column("centre_x"), &y_c = dynamic.column("centre_y");
  const double watched = 2.0 / 3.0 * c.rest_held;   // before that the last hundredth of the mass comes to rest
  const auto late = static_cast<std::size_t>(std::lower_bound(t.begin(), t.end() - 1, t.back() - watched) - t.begin());
  end.late_motion = std::hypot(x_c.back() - x_c[late], y_c.back() - y_c[late]) / c.height;

  soil_figure(run, body, "displacement", "Displacement", {"|u|", "m"}, [&body](std::size_t i) {
    return (body.particles.position[i] - body.particles.reference_position[i]).norm();
  });
  soil_figure(run, body, "plastic-strain", "Equivalent plastic strain", {"eps_p", "1"},
              [&body](std::size_t i) { return body.particles.plastic_strain[i]; });
  return end;
}

void surface_figure(Run& run, const Surface& computed, const std::vector<std::pair<std::string, Surface>>& references) {
  Figure& figure = run.figure({.name = "surface", .title = "Surface at rest", .x = {"x", "m"}, .y = {"height as volume per width", "m"}});
  figure.add({.label = "computed", .x = computed.x, .y = computed.h});
  for (const auto& [label, surface] : references)
    figure.add({.label = label, .role = "reference", .x = surface.x, .y = surface.h});
}

}  // namespace furrow::column_collapse_cases
