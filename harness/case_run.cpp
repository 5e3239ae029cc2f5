#include "harness/case_run.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <sstream>

#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>

#include "harness/gate.hpp"
#include "harness/result.hpp"
#include "solver/modules.hpp"

namespace furrow {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Writes progress lines, at most five a second; the first of every rung at once.
class Teller {
 public:
  Teller(int descriptor, int rungs) : descriptor_(descriptor), rungs_(rungs) {}

  void begin(int rung) {
    rung_ = rung;
    start_ = Clock::now();
    tell({});
  }
  void step(const Run::Progress& p) {
    if (std::chrono::duration<double>(Clock::now() - last_).count() > 0.2) tell(p);
  }

 private:
  void tell(const Run::Progress& p) {
    last_ = Clock::now();
    if (descriptor_ < 0) return;
    const double elapsed = seconds_since(start_);
    const std::string line =
        to_line({rung_, rungs_, p.simulated_time, p.end_time, elapsed > 0.0 ? static_cast<double>(p.steps) / elapsed : 0.0});
    if (::write(descriptor_, line.data(), line.size()) < 0) descriptor_ = -1;   // nobody listens any more
  }

  int descriptor_, rungs_, rung_ = 0;
  Clock::time_point start_, last_;
};

template <class Named>
void add_new_names(std::deque<Named>& to, const std::deque<Named>& from) {
  for (const Named& item : from)
    if (std::none_of(to.begin(), to.end(), [&](const Named& known) { return known.name == item.name; })) to.push_back(item);
}

std::filesystem::path rung_folder(const CaseSpec& spec, const std::filesystem::path& folder, std::size_t spacing,
                                  std::size_t ratio) {
  if (spec.spacing.size() * spec.smoothing_ratio.size() < 2) return folder;
  return folder / fmt::format("dx-{:g}{}-h-{:g}", spec.spacing[spacing] / unit(spec.spacing_unit).factor, spec.spacing_unit,
                              spec.smoothing_ratio[ratio]);
}

std::string relative_name(const std::filesystem::path& file, const std::filesystem::path& rung,
                          const std::filesystem::path& folder) {
  return (file.is_absolute() ? file : rung / file).lexically_relative(folder).string();
}

// What has run in this process joins what the case declares. A declared module that has not run is an error of the case: it would
// stand for a test that there is not. Kernels and laws are functions that a case may call by itself, and are believed.
void check_modules(std::set<std::string>& modules) {
  for (std::size_t i = 0; i < module_names.size(); ++i) {
    const std::string name(module_names[i]);
    if (modules_run[i]) modules.insert(name);
    else if (modules.contains(name) && !name.starts_with("materials/"))
      throw std::logic_error("the case says that it exercises " + name + ", which has not run");
  }
}

std::chrono::year_month_day today() {
  return std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()));
}

}  // namespace

std::string to_line(const CaseProgress& p) {
  return fmt::format("{} {} {:g} {:g} {:g}\n", p.rung, p.rungs, p.simulated_time, p.end_time, p.steps_per_second);
}

CaseProgress case_progress(const std::string& line) {
  CaseProgress p;
  std::istringstream(line) >> p.rung >> p.rungs >> p.simulated_time >> p.end_time >> p.steps_per_second;
  return p;
}

void run_case(const CaseSpec& spec, const std::filesystem::path& folder, const Json& provenance, int threads, int progress,
              std::uint64_t particle_order) {
  const std::size_t spacings = std::max<std::size_t>(1, spec.spacing.size()),
                    ratios = std::max<std::size_t>(1, spec.smoothing_ratio.size());
  const Clock::time_point start = Clock::now();
  Teller teller(progress, static_cast<int>(spacings * ratios));
  std::vector<Rung> rungs;
  Shown shown, others;
  Cost cost;
  CaseVerdict verdict;
  try {
    for (std::size_t ratio = 0; ratio < ratios; ++ratio)
      for (std::size_t spacing = 0; spacing < spacings; ++spacing) {
        teller.begin(static_cast<int>(rungs.size()));
        Resolution resolution;
        if (!spec.spacing.empty()) resolution = {spec.spacing[spacing], spec.smoothing_ratio[ratio]};
        const std::filesystem::path place = spec.spacing.empty() ? folder : rung_folder(spec, folder, spacing, ratio);
        std::filesystem::create_directories(place);
        Run run(resolution, place, threads, [&](const Run::Progress& p) { teller.step(p); }, particle_order);
        spec.run(run);
        rungs.push_back({spacing, ratio, run.measurements()});

        const bool leads = spacing + 1 == spacings && ratio == 0;   // finest spacing, first h/dx
        Shown& target = leads ? shown : others;
        add_new_names(target.tables, run.tables());
        add_new_names(target.figures, run.figures());
        shown.modules.insert(run.modules().begin(), run.modules().end());
        if (leads) {
          shown.notes = run.notes();
          for (const auto& [kind, file] : run.files()) {
            const std::string name = relative_name(file, place, folder);
            if (kind == "history") shown.history = name;
            else shown.snapshots.push_back(name);
          }
        }
        cost.steps += run.steps();
        cost.particles = std::max(cost.particles, run.particles());
        cost.particle_steps += run.particle_steps();
        if (std::filesystem::is_empty(place)) std::filesystem::remove(place);
      }
    check_modules(shown.modules);
    add_new_names(shown.tables, others.tables);
    add_new_names(shown.figures, others.figures);
    verdict = judge(spec, rungs, today());
  } catch (const std::exception& error) {
    verdict = all_error(spec, error.what());
  }
  cost.wall = seconds_since(start);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  cost.cpu = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
             1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  cost.peak_rss = usage.ru_maxrss * 1024;
  std::filesystem::create_directories(folder);
  write_json(folder / "result.json", result_json(spec, verdict, shown, cost, provenance));
}

}  // namespace furrow
