// Rods of the laboratories: one shot with all that was measured on it, and a whole set of shots.
#include <fmt/format.h>

#include <cmath>

#include "harness/scheme_input.hpp"
#include "validation/taylor-bar/problems.hpp"
#include "validation/taylor-bar/shot.hpp"

namespace furrow::taylor_bar_cases {
namespace {

/// Growth of the radius from which on a rear counts as deformed: what a caliper sees on these rods, 0.02 mm in 3.8 mm.
constexpr double visible_growth = 0.005;

struct Predicted {
  double final_length, foot_diameter, undeformed_length, diameter_at_fifth;
};

Predicted predicted(const Impact& impact, const Outcome& outcome) {
  return {outcome.length, 2.0 * outcome.foot_radius, outcome.shape.undeformed_length(0.5 * impact.rod.diameter, visible_growth),
          2.0 * outcome.shape.radius_at(0.2 * impact.rod.length)};
}

/// Mean of the relative errors of length, foot diameter and diameter at 0.2 L0 (Johnson & Holmquist 1988).
double mean_error(const Predicted& p, const Measured& m) {
  return (std::abs(p.final_length / m.final_length - 1.0) + std::abs(p.foot_diameter / m.foot_diameter - 1.0) +
          std::abs(p.diameter_at_fifth / m.diameter_at_fifth - 1.0)) /
         3.0;
}

/// Errors of the radius over the digitised heights that the rod has, relative to the rod's first radius.
struct ProfileError {
  double l2, linf;
};
ProfileError profile_error(const Shot& shot, const RodShape& shape) {
  double sum = 0.0, count = 0.0, largest = 0.0;
  for (std::size_t k = 0; k < shot.height.size(); ++k) {
    if (shot.height[k] > shape.length) continue;
    const double e = (shape.radius_at(shot.height[k]) - shot.radius[k]) / (0.5 * shot.impact.rod.diameter);
    sum += e * e;
    count += 1.0;
    largest = std::max(largest, std::abs(e));
  }
  return {std::sqrt(sum / count), largest};
}

/// Volume that a digitised profile encloses, over that of the rod before impact: 1 for a metal, but for what digitising loses.
double enclosed_volume(const Shot& shot) {
  double sum = 0.0;
  for (std::size_t k = 1; k < shot.height.size(); ++k) {
    const double a = shot.radius[k - 1], b = shot.radius[k];
    sum += (shot.height[k] - shot.height[k - 1]) * (a * a + a * b + b * b) / 3.0;
  }
  const double first = 0.5 * shot.impact.rod.diameter;
  return sum / (first * first * shot.impact.rod.length);
}

void profile_figure(Run& run, const Shot& shot, const RodShape& shape) {
  Figure figure;
  figure.name = "profile";
  figure.title = "Final profile";
  figure.x = {"height above the wall", "mm"};
  figure.y = {"radius", "mm"};
  const auto in_mm = [](std::vector<double> v) {
    for (double& x : v) x *= 1e3;
    return v;
  };
  Series computed;
  computed.label = "computed";
  computed.x = in_mm(shape.height);
  computed.y = in_mm(shape.radius);
  figure.add(std::move(computed));
  if (!shot.height.empty()) {
    Series measured;
    measured.label = "measured, digitised";
    measured.role = "experiment";
    measured.x = in_mm(shot.height);
    measured.y = in_mm(shot.radius);
    measured.uncertainty.assign(shot.height.size(), 0.05);
    figure.add(std::move(measured));
  }
  run.figure(std::move(figure));
}

}  // namespace

Problem shot(const Parameters& input) {
  const ReferenceData set = read_set(input, input.text("set"));
  Shot shot = read_shot(input, set, input.number("shot", range::positive));
  if (input.flag_or("profile", false)) {
    const ReferenceData profile = read_set(input, fmt::format("{}-profile-{:g}", set.set, shot.impact.speed));
    shot.height = profile.column("height");
    shot.radius = profile.column("radius");
  }
  const std::vector<std::string> before = warnings(input, "shot", shot.impact);

  return [=](Run& run) {
    const Outcome outcome = collide(run, shot.impact);
    const Predicted p = predicted(shot.impact, outcome);
    const Measured& m = shot.measured;
    run.exercises("particles/images");
    exercise(run, shot.impact.scheme);
    for (const std::string& sentence : before) run.note(sentence);
    for (const std::string& sentence : warnings_after(shot.impact, outcome)) run.note(sentence);

    run.measure("final_length", p.final_length, "m", {m.final_length, uncertainty::final_length * m.final_length});
    if (std::isfinite(m.foot_diameter))
      run.measure("foot_diameter", p.foot_diameter, "m", {m.foot_diameter, uncertainty::foot_diameter * m.foot_diameter});
    if (std::isfinite(m.diameter_at_fifth))
      run.measure("diameter_at_fifth", p.diameter_at_fifth, "m",
                  {m.diameter_at_fifth, uncertainty::diameter_at_fifth * m.diameter_at_fifth});
    if (std::isfinite(m.undeformed_length))
      run.measure("undeformed_length", p.undeformed_length, "m",
                  {m.undeformed_length, uncertainty::undeformed_length * shot.impact.rod.length});
    if (std::isfinite(m.foot_diameter) && std::isfinite(m.diameter_at_fifth)) run.measure("mean_error", mean_error(p, m));
    if (!shot.height.empty()) {
      const ProfileError e = profile_error(shot, outcome.shape);
      run.measure("profile_l2", e.l2);
      run.measure("profile_linf", e.linf);
      const double enclosed = enclosed_volume(shot);
      if (std::abs(enclosed - 1.0) > 0.05)
        run.note(fmt::format("The digitised profile encloses {:.0f} % of the volume that the rod had: a metal keeps its volume, "
                             "so diameters of this rod are not to be trusted by more than half of what is missing.",
                             100.0 * enclosed));
    }
    run.measure("greatest_plastic_strain", outcome.greatest_plastic_strain);
    run.measure("highest_temperature", outcome.highest_temperature, "K");
    run.measure("energy_imbalance", outcome.energy_imbalance);

    Table& table = run.table("rod", "The rod at rest", {{"quantity"}, {"measured", "mm"}, {"computed", "mm"}});
    table.row({std::string("length"), 1e3 * m.final_length, 1e3 * p.final_length});
    table.row({std::string("foot diameter"), 1e3 * m.foot_diameter, 1e3 * p.foot_diameter});
    table.row({std::string("diameter at 0.2 of the first length"), 1e3 * m.diameter_at_fifth, 1e3 * p.diameter_at_fifth});
    table.row({std::string("undeformed length (radius grown by less than 0.5 %)"), 1e3 * m.undeformed_length,
               1e3 * p.undeformed_length});
    profile_figure(run, shot, outcome.shape);
  };
}

Problem shot_series(const Parameters& input) {
  const std::vector<std::string> names = input.texts("sets");
  const double fastest = input.quantity("fastest", dimension::velocity, range::positive);
  struct Named {
    std::string set;
    Shot shot;
  };
  std::vector<Named> shots;
  for (const std::string& name : names) {
    const ReferenceData set = read_set(input, name);
    for (const double speed : set.column("impact_speed"))
      if (speed < fastest) shots.push_back({name, read_shot(input, set, speed)});
  }
  if (shots.empty()) input.fail("fastest", "leaves no shot");
  const double across = input.number("cells_across", {4.0, 100.0}), smoothing_ratio = input.number("h_over_dx", {0.8, 4.0});
  for (const Named& s : shots) warnings(input, "sets", s.shot.impact);

  return [=](Run& run) {
    Table& table = run.table("shots", "Every shot of the series",
                             {{"set"}, {"impact speed", "m/s"}, {"temperature", "K"}, {"measured length", "mm"},
                              {"computed length", "mm"}, {"relative error", "1"}});
    double sum = 0.0, bias = 0.0, worst = 0.0;
    for (std::size_t k = 0; k < shots.size(); ++k) {
      const Shot& shot = shots[k].shot;
      Run one({shot.impact.rod.diameter / across, smoothing_ratio}, run.folder() / fmt::format("shot-{:02}", k),
              run.threads());
      const Outcome outcome = collide(one, shot.impact);
      run.count(one.steps(), one.particles());
      run.progress(static_cast<double>(k + 1), static_cast<double>(shots.size()), one.steps());
      const double e = outcome.length / shot.measured.final_length - 1.0;
      sum += std::abs(e);
      bias += e;
      worst = std::max(worst, std::abs(e));
      table.row({shots[k].set, shot.impact.speed, *shot.impact.temperature, 1e3 * shot.measured.final_length, 1e3 * outcome.length,
                 e});
    }
    exercise(run, shots.front().shot.impact.scheme);
    const double n = static_cast<double>(shots.size());
    run.measure("mean_absolute_error", sum / n);
    run.measure("bias", bias / n);
    run.measure("largest_error", worst);
  };
}

}  // namespace furrow::taylor_bar_cases
