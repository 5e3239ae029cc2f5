// Rods that other computations are the reference for: the copper rod on which codes agree, the whole rod behind a quarter, a rod
// without short steps behind one with them, and what each printed equation of the paper does to a rod.
#include <cmath>

#include "harness/printed_forms.hpp"
#include "harness/scheme_input.hpp"
#include "validation/taylor-bar/problems.hpp"
#include "validation/taylor-bar/shot.hpp"

namespace furrow::taylor_bar_cases {
namespace {

Impact read_rod(const Parameters& input) {
  Impact impact = read_impact(input);
  impact.rod = {input.quantity("length", dimension::length, range::positive),
                input.quantity("diameter", dimension::length, range::positive)};
  impact.speed = input.quantity("impact_speed", dimension::velocity, range::positive);
  return impact;
}

/// Value at time t, on straight lines between rows of the history.
double value_at(const std::vector<double>& time, const std::vector<double>& value, double t) {
  for (std::size_t n = 1; n < time.size(); ++n)
    if (time[n - 1] <= t && t < time[n]) {
      const double part = (t - time[n - 1]) / (time[n] - time[n - 1]);
      return (1.0 - part) * value[n - 1] + part * value[n];
    }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Problem benchmark(const Parameters& input) {
  const Impact impact = read_rod(input);
  const double early = input.quantity("early_time", dimension::time, range::positive);
  const double late = input.quantity("reference_time", dimension::time, range::positive);
  return [=](Run& run) {
    const Outcome outcome = collide(run, impact);
    exercise(run, impact.scheme);
    run.exercises("particles/images");
    run.measure("final_length", outcome.length, "m");
    run.measure("foot_radius", outcome.foot_radius, "m");
    run.measure("early_foot_radius", value_at(outcome.time, outcome.foot_radius_at, early), "m");
    run.measure("reference_length", value_at(outcome.time, outcome.length_at, late), "m");
    run.measure("rest_time", outcome.rest_time, "s");
    run.measure("viscous_share", outcome.viscous_share);
    run.measure("greatest_plastic_strain", outcome.greatest_plastic_strain);
    run.measure("energy_imbalance", outcome.energy_imbalance);

    Figure figure;
    figure.name = "foot";
    figure.title = "Foot and length of the rod";
    figure.x = {"t", "us"};
    figure.y = {"length", "mm"};
    Series foot, length;
    foot.label = "foot radius";
    length.label = "length of the rod";
    for (std::size_t n = 0; n < outcome.time.size(); ++n) {
      foot.x.push_back(1e6 * outcome.time[n]);
      foot.y.push_back(1e3 * outcome.foot_radius_at[n]);
      length.x.push_back(1e6 * outcome.time[n]);
      length.y.push_back(1e3 * outcome.length_at[n]);
    }
    figure.add(std::move(foot));
    figure.add(std::move(length));
    run.figure(std::move(figure));
  };
}

Problem whole_rod_too(const Parameters& input) {
  const Impact quarter = read_rod(input);
  return [=](Run& run) {
    Impact whole = quarter;
    whole.whole = true;
    Run other(run.resolution(), run.folder() / "whole", run.threads());
    const Outcome a = collide(run, quarter), b = collide(other, whole);
    run.count(other.steps(), other.particles());
    exercise(run, quarter.scheme);
    run.exercises("particles/images");
    run.measure("length_difference", a.length / b.length - 1.0);
    run.measure("foot_radius_difference", a.foot_radius / b.foot_radius - 1.0);
    run.measure("plastic_strain_difference", a.greatest_plastic_strain / b.greatest_plastic_strain - 1.0);
  };
}

Problem sub_steps(const Parameters& input) {
  const ReferenceData set = read_set(input, input.text("set"));
  Impact apart = read_shot(input, set, input.number("shot", range::positive)).impact, together = apart;
  if (!apart.scheme.sub_cycling) input.fail("scheme.sub_cycling", "found false, expected true: it is compared with a run without");
  together.scheme.sub_cycling = false;
  return [=](Run& run) {
    Run other(run.resolution(), run.folder() / "together", run.threads());
    const Outcome a = collide(run, apart), b = collide(other, together);
    const double particle_steps = static_cast<double>(run.particle_steps()) / static_cast<double>(other.particle_steps());
    run.count(other.steps(), other.particles());
    exercise(run, apart.scheme);
    run.exercises("particles/images");
    run.measure("length_difference", a.length / b.length - 1.0);
    run.measure("foot_difference", a.foot_radius / b.foot_radius - 1.0);
    run.measure("plastic_strain_difference", a.greatest_plastic_strain / b.greatest_plastic_strain - 1.0);
    run.measure("energy_imbalance", a.energy_imbalance);
    run.measure("particle_steps", particle_steps);
  };
}

Problem printed_forms(const Parameters& input) {
  std::vector<Impact> impacts;
  const Impact rod = read_rod(input);
  for (const PrintedForm& v : printed_forms_of_metals) {
    Impact impact = rod;
    impact.material = read_material(input, "material", 0.0, v.changes).law;
    impacts.push_back(impact);
  }
  // Eq. 7 is a density equation of the frame that moves with the particles: beside it the right form in that frame.
  const Parameters moving = input.table("moving");
  Impact current = rod, shepard = rod;
  current.scheme = shepard.scheme = read_scheme(moving);
  shepard.scheme.density = DensityEquation::shepard;
  const double moving_ratio = moving.number("h_over_dx", {0.8, 4.0});

  return [=](Run& run) {
    exercise(run, rod.scheme);
    run.exercises("materials/johnson_cook");
    Table& table = run.table("rods", "One rod, one printed equation at a time",
                             {{"variant"}, {"final length", "mm"}, {"foot diameter", "mm"}, {"greatest plastic strain"},
                              {"highest temperature", "K"}, {"particles that failed", "%"}});
    double right_length = 0.0;
    const auto add = [&](const std::string& name, const std::string& difference, const Impact& impact, double ratio) {
      Run one({run.resolution().spacing, ratio}, run.folder() / name, run.threads());
      Outcome outcome;
      try {
        outcome = collide(one, impact);
      } catch (const std::runtime_error& error) {
        run.note(difference + ": no rod at rest. " + error.what());
        table.row({difference, std::string("none: the run breaks off"), std::string("-"), std::string("-"), std::string("-"),
                   std::string("-")});
        return std::numeric_limits<double>::quiet_NaN();
      }
      run.count(one.steps(), one.particles());
      table.row({difference, 1e3 * outcome.length, 2e3 * outcome.foot_radius, outcome.greatest_plastic_strain,
                 outcome.highest_temperature, 100.0 * outcome.failed_share});
      return outcome.length;
    };
    for (std::size_t i = 0; i < impacts.size(); ++i) {
      const PrintedForm& v = printed_forms_of_metals[i];
      const double length = add(v.name, v.difference, impacts[i], run.resolution().smoothing_ratio);
      if (i == 0) {
        right_length = length;
        run.measure("length_right", length, "m");
      }
    }
    const double moved = add("moving", "all right, in the frame that moves with the particles", current, moving_ratio);
    add("eq_7", "Eq. 7 as the only density equation, in the moving frame", shepard, moving_ratio);
    run.measure("frames_agree", moved / right_length - 1.0);
  };
}

}  // namespace furrow::taylor_bar_cases
