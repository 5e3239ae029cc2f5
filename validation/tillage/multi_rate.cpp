// Sub-steps of the tool within the soil's step against one step for both: the same cut, at what cost.
#include <ctime>

#include <algorithm>

#include "validation/tillage/coupled_cut.hpp"
#include "validation/tillage/problems.hpp"

namespace furrow::tillage_cases {

Problem multi_rate(const Parameters& input) {
  const CoupledSetup setup = read_coupled(input);
  const double from = input.quantity("window_start", dimension::time, {0.0, setup.end_time, false, true});
  return [=](Run& run) {
    struct Way {
      CoupledResult result;
      double cpu;   ///< s
    };
    const auto go = [&](bool single_rate) {
      CoupledSetup one = setup;
      one.single_rate = single_rate;
      Run inner(run.resolution(), run.folder() / (single_rate ? "single-rate" : "sub-steps"), run.threads());
      const std::clock_t before = std::clock();
      CoupledResult result = coupled_cut(inner, one);
      const double cpu = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
      run.count(inner.steps(), inner.particles());
      for (const std::string& module : inner.modules()) run.exercises(module);
      run.progress(single_rate ? 2.0 : 1.0, 2.0, inner.steps());
      return Way{std::move(result), cpu};
    };
    const Way many = go(false), single = go(true);
    const CoupledHistory &a = many.result.history, &b = single.result.history;
    const auto mean = [&](const CoupledHistory& h, const std::vector<double>& column) {
      return mean_over(h, column, from, setup.end_time);
    };
    run.measure("draft", mean(a, a.draft), "N/m", {mean(b, b.draft), 0.0});
    run.measure("deflection", mean(a, a.deflection), "m", {mean(b, b.deflection), 0.0});
    run.measure("moment", mean(a, a.moment), "N", {mean(b, b.moment), 0.0});
    run.measure("sub_steps", many.result.sub_steps);
    run.measure("gain", single.cpu / many.cpu);
    run.measure("gain_over_bound", single.cpu / many.cpu / many.result.gain);
    run.measure("exchange_error", std::max(many.result.exchange_error, single.result.exchange_error));
    Figure& figure = run.figure({.name = "force",
                                 .title = "Draft with sub-steps and with one step for both",
                                 .x = {"time", "s"},
                                 .y = {"force per width", "N/m"}});
    figure.add({.label = "sub-steps", .x = a.time, .y = a.draft});
    figure.add({.label = "one step", .role = "reference", .x = b.time, .y = b.draft});
  };
}

}  // namespace furrow::tillage_cases
