// Rankine 1857: a smooth wall that moves away from the soil or into it, on a smooth base, so that all of the soil reaches its limit.
#include <cmath>

#include "reference/exact/earth_pressure.hpp"
#include "reference/exact/plasticity.hpp"
#include "verification/earth-pressure/problems.hpp"

namespace furrow::earth_pressure_cases {

Problem moving_wall(const Parameters& input) {
  const Soil soil = read_soil(input);
  const double H = input.quantity("height", dimension::length, range::positive);
  const double L = input.quantity("length", dimension::length, range::positive);
  const double strain = input.number("strain", {-0.2, 0.2});
  const double end = input.quantity("end_time", dimension::time, range::positive);
  const double g = input.quantity_or("gravity", dimension::acceleration, 9.81, range::positive);
  const double courant = input.number_or("courant", 0.4, range::positive);
  const Scheme scheme = read_scheme(input);
  const RestingRatio resting = read_resting_ratio(input, soil.law, soil.law.reference_density * g * H);
  return [=](Run& run) {
    const double dx = run.resolution().spacing;

    // Geometry: the wall is a layer at x = 0 that is higher than the soil; base and far end are planes of symmetry.
    Simulation<2> simulation;
    simulation.body = soil_body(run, soil.law, scheme, g);
    Body<2>& body = simulation.body;
    body.add(rectangle({0.0, 0.0}, L, H, dx));
    const double speed = strain * L / (0.95 * end), start = 0.1 * end;   // positive: into the soil
    add_flat_layer(body, "wall", {0.0, 1.5 * H}, {0.0, 0.0}, Slip::free,
                   [=](double t) { return Vector<2>(speed * std::min(1.0, t / start), 0.0); });
    check_clear(body);
    body.images = Images<2>({SymmetryPlane<2>{{0.0, 0.0}, {0.0, 1.0}}, SymmetryPlane<2>{{L, 0.0}, {-1.0, 0.0}}});
    set_geostatic(body, soil.law, H, resting);
    simulation.control.courant = courant;
    simulation.watch.low = {-L, -dx};
    simulation.watch.high = {2.0 * L, 3.0 * H};

    // Probes: the wall's force, and where it stands; the soil keeps its area, so that its height follows.
    const double wall_start = -0.5 * dx;
    const std::int32_t wall = body.layers[0].ids.front();
    DynamicRun<2> dynamic(run, simulation);
    dynamic.probe({"wall_force", "F", "N", "force of the soil on the wall, per width"},
                  [](const Simulation<2>& s) { return -s.body.layer_forces()[0][0]; });
    dynamic.probe({"wall_position", "x_w", "m", "way of the wall"}, [=](const Simulation<2>& s) {
      return s.body.particles.position[s.body.index_of(wall)][0] - wall_start;
    });
    dynamic.probe({"centre_height", "y_c", "m", "height of the soil's centre of mass"}, [](const Simulation<2>& s) {
      double sum = 0.0, mass = 0.0;
      for (std::size_t i = 0; i < s.body.particles.size(); ++i)
        if (!s.body.is_in_layer(i)) sum += s.body.particles.mass[i] * s.body.particles.position[i][1], mass += s.body.particles.mass[i];
      return sum / mass;
    });
    dynamic.until(end, 400, 2);
    exercise_soil(run, scheme);
    run.exercises("boundaries/boundary_layer");

    const exact::Cone cone{soil.law.cone.alpha, soil.law.cone.k, soil.law.cone.beta};
    const double phi = exact::plane_strain_friction(cone), c = exact::plane_strain_cohesion(cone);
    const double weight = soil.law.reference_density * g;
    // The soil between walls that are L - way apart, and dilated, stands as high as twice its centre and weighs what it did.
    const auto limit = [=](double way, double centre) {
      const double height = 2.0 * centre, now = weight * H * L / ((L - way) * height);
      return strain < 0.0 ? exact::active_force(phi, c, now, height) : exact::passive_force(phi, c, now, height);
    };
    // The mean over the last fifth, each instant against the force at its height.
    const auto &force = dynamic.column("wall_force"), &way = dynamic.column("wall_position"), &centre = dynamic.column("centre_height");
    double ratio = 0.0, samples = 0.0;
    Series computed{.label = "computed"}, reference{.label = "Rankine", .role = "reference"};
    for (std::size_t k = 0; k < force.size(); ++k) {
      computed.x.push_back(way[k]), computed.y.push_back(force[k]);
      reference.x.push_back(way[k]), reference.y.push_back(limit(way[k], centre[k]));
      if (k + force.size() / 5 >= force.size()) ratio += force[k] / limit(way[k], centre[k]), samples += 1.0;
    }
    run.figure({.name = "force", .title = "Force on the wall", .x = {"way of the wall", "m"}, .y = {"force per width", "N/m"},
                .series = {computed, reference}});
    const double expected = limit(way.back(), centre.back());
    run.measure("wall_force", ratio / samples * expected, "N/m", {expected, 0.0});
    // Along a slip line of soil with friction phi that does not dilate as much acts less: sin(phi) cos(psi)/(1 - sin(phi) sin(psi))
    // is the tangent of its angle (Davis 1968).
    const double psi = std::asin(std::min(1.0, 3.0 * cone.beta / std::sqrt(1.0 - 3.0 * cone.beta * cone.beta)));
    const double slip = std::atan(std::sin(phi) * std::cos(psi) / (1.0 - std::sin(phi) * std::sin(psi)));
    const double on_slip_lines = strain < 0.0 ? exact::active_force(slip, c * std::tan(slip) / std::tan(phi), weight, H)
                                              : exact::passive_force(slip, c * std::tan(slip) / std::tan(phi), weight, H);
    const double uniform = strain < 0.0 ? exact::active_force(phi, c, weight, H) : exact::passive_force(phi, c, weight, H);
    run.measure("between_rankine_and_slip_lines", std::abs(on_slip_lines - uniform) < 1e-9 * uniform ? 0.0 : (ratio / samples - 1.0) / (on_slip_lines / uniform - 1.0));
    run.measure("energy_imbalance", dynamic.energy_imbalance());
  };
}

}  // namespace furrow::earth_pressure_cases
