// Cuts in which a tool yields and breaks for a reason: dry hard clay, and a stone in the way. Demonstrations of a mechanism in
// soil that is not the paper's.
#include <fmt/format.h>

#include <cmath>

#include "validation/tillage/coupled_cut.hpp"
#include "validation/tillage/problems.hpp"

namespace furrow::tillage_cases {

Problem breaking_tool(const Parameters& input) {
  const CoupledSetup setup = read_coupled(input);
  const double filter = input.quantity("filter", dimension::length, range::positive) / setup.blade.speed;
  return [=](Run& run) {
    const CoupledResult result = coupled_cut(run, setup);
    const CoupledHistory& h = result.history;
    const std::vector<double> F = smoothed(h.time, h.whole, filter);
    const auto stages = stages_of(h, filter);
    const double v = setup.blade.speed;

    // Each stage as a number: 1 where it is there.
    for (const Stage& stage : stages) run.measure("stage_" + std::string(stage.name), stage.present ? 1.0 : 0.0);
    const auto first = [&](const std::vector<double>& column, double above) {
      for (std::size_t k = 0; k < column.size(); ++k)
        if (column[k] > above) return k;
      return column.size();
    };
    const std::size_t yields = first(h.plastic_strain, StageDefinition{}.plastic_onset), begins = first(h.softened, 0.0),
                      breaks = first(h.failed, 0.0);
    const auto event = [&](const std::string& name, std::size_t k, const std::string& why) {
      if (k < h.time.size()) {
        run.measure(name + "_time", h.time[k], "s");
        run.measure(name + "_travel", h.time[k] * v, "m");
        run.measure(name + "_force", F[k], "N/m");
        run.measure(name + "_deflection", h.deflection[k], "m");
      } else {
        for (const char* what : {"_time", "_travel", "_force", "_deflection"}) run.skip(name + what, why);
      }
    };
    event("yield", yields, "the tool stays elastic");
    event("fracture", breaks, "no particle of the tool fails");
    const auto top = static_cast<std::size_t>(std::max_element(F.begin(), F.end()) - F.begin());
    event("peak", top, "");
    run.measure("last_over_peak", F.back() / F[top]);
    run.measure("greatest_deflection", *std::max_element(h.deflection.begin(), h.deflection.end()), "m");
    run.measure("plastic_strain", *std::max_element(h.plastic_strain.begin(), h.plastic_strain.end()));
    run.measure("failed_particles", h.failed.back());
    if (h.failed.back() > 0.0 && setup.tool.scheme.cracks) run.exercises("schemes/cracks");
    run.measure("greatest_moment", *std::max_element(h.moment.begin(), h.moment.end()), "N");

    // The plateau: from where the section flows until fracture begins.
    double moment = 0.0, limit = 0.0, n = 0.0;
    const std::size_t end = std::min(begins, h.time.size());
    for (std::size_t k = 0; k < end; ++k)
      if (h.plastic_moment[k] > 0.0) moment += h.moment[k], limit += h.plastic_moment[k], n += 1.0;
    if (n > 0.0) run.measure("plateau_moment", moment / n, "N", {limit / n, 0.0});
    else run.skip("plateau_moment", "no section of the tool flows");

    run.note("Stages of the force: " + in_words(stages) + ".");
    run.note("A demonstration of the mechanism in soil that is not the paper's: no claim of the paper is reproduced by it.");
    measure_coupling(run, result);
    run.measure("stone_penetration", result.stone_penetration);
    stage_figure(run, h, stages, filter);
    Figure& figure =
        run.figure({.name = "moment", .title = "Moment at the clamp", .x = {"time", "s"}, .y = {"moment per width", "N"}});
    figure.add({.label = "computed", .x = h.time, .y = h.moment});
    figure.add({.label = "section that flows", .role = "reference", .x = h.time, .y = h.plastic_moment});
  };
}

}  // namespace furrow::tillage_cases
