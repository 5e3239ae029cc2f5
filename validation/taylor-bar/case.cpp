#include "harness/scheme_input.hpp"
#include "validation/families.hpp"
#include "validation/taylor-bar/impact.hpp"
#include "validation/taylor-bar/problems.hpp"

namespace furrow {

Family taylor_bar_family() {
  Family family("taylor-bar", "validation/taylor-bar",
                "Metal rods that hit a rigid wall: strength, heating and hardening at rates and strains that no testing machine reaches.");
  family.add("benchmark", taylor_bar_cases::benchmark);
  return family;
}

namespace taylor_bar_cases {

Problem benchmark(const Parameters& input) {
  Impact impact;
  impact.rod = {input.quantity("length", dimension::length, range::positive), input.quantity("diameter", dimension::length, range::positive)};
  impact.speed = input.quantity("impact_speed", dimension::velocity, range::positive);
  impact.material = read_material(input, "material").law;
  impact.scheme = read_scheme(input);
  impact.arrangement = arrangement_by_name(input.choice_or("arrangement", "rings", {"rings", "square"}));
  impact.whole = input.flag_or("whole", false);
  const double early = input.quantity("early_time", dimension::time, range::positive);

  return [=](Run& run) {
    const Outcome outcome = collide(run, impact);
    exercise(run, impact.scheme);
    run.measure("final_length", outcome.length, "m");
    run.measure("foot_radius", outcome.foot_radius, "m");
    double early_radius = 0.0;
    for (std::size_t n = 1; n < outcome.time.size(); ++n)
      if (outcome.time[n - 1] <= early && early < outcome.time[n]) {
        const double t = (early - outcome.time[n - 1]) / (outcome.time[n] - outcome.time[n - 1]);
        early_radius = (1.0 - t) * outcome.foot_radius_at[n - 1] + t * outcome.foot_radius_at[n];
      }
    run.measure("early_foot_radius", early_radius, "m");
    run.measure("energy_imbalance", outcome.energy_imbalance);
    run.measure("rest_time", outcome.rest_time, "s");
    run.measure("viscous_share", outcome.viscous_share);
    run.measure("greatest_plastic_strain", outcome.greatest_plastic_strain);
  };
}

}  // namespace taylor_bar_cases
}  // namespace furrow
