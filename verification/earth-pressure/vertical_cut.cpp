// A vertical cut in cohesive soil: how much cohesion it takes to stand, when its weight comes slowly and when it comes at once.
#include <cmath>

#include "reference/exact/earth_pressure.hpp"
#include "reference/exact/plasticity.hpp"
#include "verification/earth-pressure/problems.hpp"

namespace furrow::earth_pressure_cases {

Problem vertical_cut(const Parameters& input) {
  const double low = input.quantity("lowest_cohesion", dimension::stress, range::positive);
  const double high = input.quantity("highest_cohesion", dimension::stress, range::positive);
  if (!(high > low)) input.fail("highest_cohesion", "found no more than the lowest, expected more");
  const int halvings = static_cast<int>(input.integer("halvings", 1, 10));
  const auto with_cohesion = [&input](double c) {
    const std::string constant = "{ value = " + std::to_string(c) + ", unit = \"Pa\", source = \"furrow-material-choices\" }";
    const NamedMaterial material = read_material(input, "material", 0.0, {{"strength.cohesion", constant}});
    return std::get<DruckerPrager>(material.law);
  };
  read_soil(input);
  // The cone's k is proportional to the cohesion, alpha does not depend on it.
  const DruckerPrager soil = with_cohesion(1e3);
  const double H = input.quantity("height", dimension::length, range::positive);
  const double W = input.quantity("width", dimension::length, range::positive);
  const double floor_length = input.quantity("floor_length", dimension::length, range::positive);
  const double ramp = input.quantity("ramp", dimension::time, range::not_negative);   // 0: gravity acts at once
  const double end = input.quantity("end_time", dimension::time, range::positive);
  const double failed = input.number("failed_settlement", range::positive);           // of the height
  const double g = input.quantity_or("gravity", dimension::acceleration, 9.81, range::positive);
  const double courant = input.number_or("courant", 0.4, range::positive);
  const Scheme scheme = read_scheme(input);
  return [=](Run& run) {
    const double dx = run.resolution().spacing;
    Figure figure{.name = "crest", .title = "Settlement of the crest", .x = {"time", "s"}, .y = {"settlement", "m"}};
    long steps = 0, particles = 0;

    // Whether the crest stays, with this cohesion. At once: from the stress at rest; slowly: from none.
    const auto stands = [&](double c) {
      DruckerPrager law = soil;
      law.cone.k *= c / 1e3;
      Simulation<2> simulation;
      simulation.body = soil_body(run, law, scheme, g);
      Body<2>& body = simulation.body;
      body.add(rectangle({0.0, 0.0}, W, H, dx));
      const auto rows = static_cast<std::size_t>(std::lround(H / dx)), columns = static_cast<std::size_t>(std::lround(W / dx));
      const auto crest = static_cast<std::int32_t>(rows * columns - 1);   // the upper particle at the face
      add_flat_layer(body, "floor", {0.0, 0.0}, {floor_length, 0.0}, Slip::none);
      body.images = Images<2>({SymmetryPlane<2>{{0.0, 0.0}, {1.0, 0.0}}});
      if (ramp > 0.0)
        body.loads.gravity_factor = [=](double t) { return std::min(1.0, t / ramp); };
      else
        set_geostatic(body, law, H, {});
      simulation.control.courant = courant;
      simulation.watch.low = {-dx, -dx};
      simulation.watch.high = {2.0 * floor_length, 2.0 * H};
      simulation.start();
      Series series{.label = "c = " + std::to_string(c / 1e3).substr(0, 5) + " kPa"};
      double settlement = 0.0;
      for (int k = 1; k <= 200 && settlement < failed * H; ++k) {
        simulation.run_until(end * k / 200.0);
        settlement = H - 0.5 * dx - body.particles.position[body.index_of(crest)][1];
        series.x.push_back(simulation.time());
        series.y.push_back(settlement);
      }
      steps += simulation.steps();
      particles = static_cast<long>(body.particles.size());
      run.progress(simulation.time(), end, simulation.steps());
      figure.add(std::move(series));
      return settlement < failed * H;
    };
    // Bisection. That the ends of the range answer differently is part of what is measured.
    double falls = low, holds = high;
    const bool bracketed = !stands(low) && stands(high);
    for (int k = 0; k < halvings && bracketed; ++k) {
      const double middle = 0.5 * (falls + holds);
      (stands(middle) ? holds : falls) = middle;
    }
    const exact::Cone cone{soil.cone.alpha, soil.cone.k, soil.cone.beta};
    const double phi = exact::plane_strain_friction(cone), share = exact::plane_strain_cohesion(cone) / 1e3;
    const double weight = soil.reference_density * g;
    run.measure("cohesion", bracketed ? 0.5 * (falls + holds) : std::nan(""), "Pa");
    run.measure("uncertainty", 0.5 * (holds - falls), "Pa");
    run.note("Slip circles (Taylor 1937) say " + std::to_string(exact::vertical_cut_cohesion(phi, weight, H) / share / 1e3) +
             " kPa, a plane wedge " + std::to_string(exact::vertical_cut_cohesion(phi, weight, H, 4.0) / share / 1e3) +
             " kPa, both with the angle of friction and the cohesion as which the cone acts in plane strain.");
    run.figure(std::move(figure));
    run.count(steps, particles);
    exercise_soil(run, scheme);
    run.exercises("boundaries/boundary_layer");
  };
}

}  // namespace furrow::earth_pressure_cases
