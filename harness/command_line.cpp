#include "harness/command_line.hpp"

#include <algorithm>
#include <cstdio>
#include <thread>

#include <fnmatch.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/bench.hpp"
#include "harness/python_command.hpp"
#include "harness/runner.hpp"
#include "harness/result.hpp"

namespace furrow {
namespace {

struct Selection {
  std::string family, tier;
  std::vector<std::string> only, ids;
  std::vector<std::filesystem::path> case_files;
};

bool any_matches(const std::vector<std::string>& globs, const std::string& id) {
  return std::any_of(globs.begin(), globs.end(),
                     [&](const std::string& glob) { return fnmatch(glob.c_str(), id.c_str(), 0) == 0; });
}

// A tier contains the ones before it.
bool in_tier(const CaseSpec& spec, const std::string& tier) { return tier.empty() || spec.tier <= tier_by_name(tier); }

std::vector<std::string> ids_of(const std::vector<CaseSpec>& cases) {
  std::vector<std::string> ids;
  for (const CaseSpec& spec : cases) ids.push_back(spec.id);
  return ids;
}

[[noreturn]] void unknown(const std::string& what, const std::string& word, const std::vector<std::string>& known) {
  const std::string nearest = nearest_word(word, known);
  throw InputError(word, 0, "", fmt::format("found no {} of this name{}; './furrow list' names them all", what,
                                            nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest)));
}

// The cases that `./furrow run` names (ids or globs), or, when it names case files only, those of the files.
std::vector<CaseSpec> named(std::vector<CaseSpec> all, const Selection& selection) {
  const std::vector<std::string> ids = ids_of(all);
  for (const std::string& wanted : selection.ids)
    if (std::none_of(ids.begin(), ids.end(), [&](const std::string& id) { return fnmatch(wanted.c_str(), id.c_str(), 0) == 0; }))
      unknown("case", wanted, ids);
  std::erase_if(all, [&](const CaseSpec& spec) {
    if (!selection.ids.empty()) return !any_matches(selection.ids, spec.id);
    return std::find(selection.case_files.begin(), selection.case_files.end(), spec.file) == selection.case_files.end();
  });
  return all;
}

std::vector<CaseSpec> of_tier(std::vector<CaseSpec> all, const Selection& selection) {
  std::vector<CaseSpec> chosen;
  for (CaseSpec& spec : all)
    if (in_tier(spec, selection.tier) && (selection.family.empty() || spec.family == selection.family) &&
        (selection.only.empty() || any_matches(selection.only, spec.id)))
      chosen.push_back(std::move(spec));
  return chosen;
}

void check_family(const std::vector<Family>& families, const std::string& name) {
  std::vector<std::string> names;
  for (const Family& family : families) names.push_back(family.name());
  if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) unknown("family", name, names);
}

void list_json(const std::vector<CaseSpec>& cases) {
  Json list = Json::array();
  for (const CaseSpec& spec : cases) {
    Json metrics = Json::array();
    for (const MetricSpec& metric : spec.metrics)
      metrics.push_back({{"name", metric.name},
                         {"class", metric.reference_class},
                         {"unit", metric.unit.symbol},
                         {"gated", metric.band.has_value()}});
    list.push_back({{"case", spec.id},
                    {"family", spec.family},
                    {"problem", spec.problem},
                    {"title", spec.title},
                    {"why", spec.why},
                    {"tier", name(spec.tier)},
                    {"time_limit_s", spec.time_limit},
                    {"metrics", metrics}});
  }
  fmt::print("{}\n", list.dump(1));
}

// CTest's own language: one test a case, labelled with its tier and its family.
void list_ctest(const std::vector<CaseSpec>& cases) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string folder = (std::filesystem::path(program).parent_path() / "cases").string();
  for (const CaseSpec& spec : cases)
    fmt::print("add_test([==[{0}]==] [==[{1}]==] run [==[{0}]==] --quiet --no-report --replace --out [==[{2}/{0}]==])\n"
               "set_tests_properties([==[{0}]==] PROPERTIES LABELS \"{3};{4}\")\n",
               spec.id, program, folder, name(spec.tier), spec.family);
}

void list_plain(const std::vector<CaseSpec>& cases) {
  std::size_t width = 0;
  for (const CaseSpec& spec : cases) width = std::max(width, spec.id.size());
  for (const CaseSpec& spec : cases) fmt::print("{:<{}}  {:<8}  {}\n", spec.id, width, name(spec.tier), spec.title);
  fmt::print("{} cases\n", cases.size());
}

int default_jobs(int threads) {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / std::max(1, threads));
}

class CommandLine {
 public:
  explicit CommandLine(const std::vector<Family>& families) : families_(families) {
    app_.require_subcommand(1);
    app_.set_help_all_flag("--help-all", "Print the help of every command");
    app_.footer("Exit codes: 0 nothing red, 1 a metric is red, 2 wrong usage or input, 3 a case ended as error.\n"
                "Example: ./furrow matrix --tier quick");
    add_list();
    add_run();
    add_matrix();
    add_report();
    add_bench();
    add_python_commands();
    add_run_case();
  }

  int run(int argc, char** argv) {
    options_.command.assign(argv + 1, argv + argc);
    try {
      app_.parse(argc, argv);
    } catch (const CLI::Success& asked_for_help) {
      return app_.exit(asked_for_help);
    } catch (const CLI::ParseError& error) {
      fmt::print(stderr, "furrow: {}\nRun with --help for more information.\n", error.what());
      return 2;
    }
    return action_();
  }

 private:
  CLI::App* command(const std::string& name, const std::string& description, const std::string& example) {
    CLI::App* sub = app_.add_subcommand(name, description);
    sub->footer("Example: " + example);
    return sub;
  }

  void add_run_options(CLI::App* sub) {
    sub->add_option("--out", options_.folder, "Folder of the run (default: runs/<date>-<time>-<commit>)")->type_name("DIR");
    sub->add_option("--threads", options_.threads, "Threads of each case (default: 1)")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    sub->add_option("--jobs", jobs_, "Cases side by side (default: as many as cores)")
        ->check(CLI::Range(1, 1024))
        ->type_name("N");
    sub->add_option("--particle-order", options_.particle_order,
                    "Seed of another order of particles, which is as right and rounds differently (default: 0, as made)")
        ->type_name("SEED");
    sub->add_flag("--resume", options_.resume, "Keep results of the same commit and inputs, and go on from checkpoints");
    sub->add_flag("--replace", options_.replace, "Replace an earlier run in the folder");
    sub->add_flag("--quiet", options_.quiet, "Print nothing but errors");
    sub->add_flag("--no-report", [this](std::int64_t) { options_.report = false; }, "Leave the report out");
  }

  void add_list() {
    CLI::App* sub = command("list", "List the cases", "./furrow list --family kernel --tier quick");
    sub->add_option("--family", selection_.family, "Only this family")->type_name("F");
    sub->add_option("--tier", selection_.tier, "Only cases of this tier and the ones it contains")
        ->check(CLI::IsMember(tier_names))
        ->type_name("T");
    sub->add_flag("--json", json_, "As JSON");
    sub->add_flag("--ctest", ctest_, "As CTest commands")->group("");
    sub->callback([this] { action_ = [this] { return list(); }; });
  }

  void add_run() {
    CLI::App* sub = command("run", "Run the named cases and report",
                            "./furrow run kernel/continuous-cubic-spline-2d --set parameters.smoothing_length.value=2");
    sub->add_option("case", selection_.ids, "Ids of cases, or patterns")->type_name("CASE");
    sub->add_option("--case-file", selection_.case_files, "Cases from outside the repository")
        ->type_name("FILE")
        ->allow_extra_args(false);
    sub->add_option("--set", options_.overrides, "Change a key of the cases: parameters.X, resolution.X or time_limit")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    add_run_options(sub);
    sub->callback([this] { action_ = [this] { return run_named(); }; });
  }

  void add_matrix() {
    CLI::App* sub =
        command("matrix", "Run every case of a tier and report", "./furrow matrix --tier smoke --only 'kernel/*' --jobs 2");
    sub->add_option("--tier", selection_.tier,
                    "smoke, quick, nightly or full; a tier contains the ones before it (default: quick)")
        ->check(CLI::IsMember(tier_names))
        ->type_name("T");
    sub->add_option("--only", selection_.only, "Only cases whose id matches; may be given several times")
        ->type_name("GLOB")
        ->allow_extra_args(false);
    add_run_options(sub);
    sub->callback([this] { action_ = [this] { return run_matrix(); }; });
  }

  void add_report() {
    CLI::App* sub = command("report", "Build the report of a run folder again", "./furrow report runs/latest");
    sub->add_option("folder", report_folder_, "Folder of a run")->required()->type_name("DIR");
    sub->add_flag("--quiet", options_.quiet, "Print nothing but errors");
    sub->callback([this] { action_ = [this] { return report(); }; });
  }

  void add_bench() {
    CLI::App* sub = command("bench", "Measure the speed of the solver", "./furrow bench --filter whole_step/3d --most 100000");
    sub->add_flag("--json", bench_.json, "JSON on standard output instead of a table");
    sub->add_option("--out", bench_.file, "JSON into this file as well")->type_name("FILE");
    sub->add_option("--filter", bench_.filter, "Only benchmarks whose name matches this regular expression")->type_name("REGEX");
    sub->add_option("--most", bench_.most_particles, "Particles of the largest benchmark (default: 1000000)")
        ->check(CLI::Range(10000L, 100000000L))
        ->type_name("N");
    sub->add_option("--time", bench_.least_time, "Least time of a benchmark in seconds (default: 0.5)")
        ->check(CLI::PositiveNumber)
        ->type_name("S");
    sub->add_option("--repetitions", bench_.repetitions, "Repetitions of each, with mean, median and deviation (default: 1)")
        ->check(CLI::PositiveNumber)
        ->type_name("N");
    sub->callback([this] { action_ = [this] { return run_benchmarks(bench_); }; });
  }

  void add_python_commands() {
    for (const PythonCommand& one : python_commands) {
      CLI::App* sub = app_.add_subcommand(one.name, one.description);
      sub->set_help_flag();
      sub->prefix_command();
      sub->callback([this, sub, &one] { action_ = [sub, &one] { return become_python(one, sub->remaining()); }; });
    }
  }

  void add_run_case() {
    CLI::App* sub = app_.add_subcommand("run-case", "One case in this process, for the runner")->group("");
    sub->add_option("folder", report_folder_)->required();
    sub->add_option("file", case_file_)->required();
    sub->add_option("id", id_)->required();
    sub->callback([this] { action_ = [this] { return run_one(families_, report_folder_, case_file_, id_); }; });
  }

  std::vector<CaseSpec> all_cases(const Overrides& overrides = {}) const {
    return read_all_cases(families_, project_root(), selection_.case_files, overrides);
  }

  int list() {
    check_family(families_, selection_.family);
    const std::vector<CaseSpec> cases = of_tier(all_cases(), selection_);
    if (json_) list_json(cases);
    else if (ctest_) list_ctest(cases);
    else list_plain(cases);
    return 0;
  }

  int run_named() {
    if (selection_.ids.empty() && selection_.case_files.empty())
      throw InputError("run", 0, "", "found no case, expected the id of one or --case-file FILE; './furrow list' names them all");
    std::vector<CaseSpec> cases = named(all_cases(), selection_);
    if (!options_.overrides.empty()) cases = named(all_cases({options_.overrides, ids_of(cases)}), selection_);
    return start(cases);
  }

  int run_matrix() {
    if (selection_.tier.empty()) selection_.tier = "quick";
    options_.tier = selection_.tier;
    options_.only = selection_.only;
    const std::vector<CaseSpec> cases = of_tier(all_cases(), selection_);
    if (cases.empty())
      throw InputError("matrix", 0, "",
                       fmt::format("found no case in tier {} that matches, expected at least one; './furrow list' names them all",
                                   selection_.tier));
    return start(cases);
  }

  int start(const std::vector<CaseSpec>& cases) {
    options_.jobs = jobs_ > 0 ? jobs_ : default_jobs(options_.threads);
    return run_cases(cases, options_);
  }

  int report() {
    if (!std::filesystem::is_directory(report_folder_))
      throw InputError(report_folder_.string(), 0, "", "found no such folder, expected that of a run");
    if (!make_report(report_folder_)) return 2;
    if (!options_.quiet) fmt::print("report: {}\n", (report_folder_ / "report/index.html").string());
    return 0;
  }

  const std::vector<Family>& families_;
  CLI::App app_{"furrow: verification and validation of SPH for metals that yield and break and soils that flow", "./furrow"};
  Selection selection_;
  RunOptions options_;
  int jobs_ = 0;
  bool json_ = false, ctest_ = false;
  BenchOptions bench_;
  std::filesystem::path report_folder_, case_file_;
  std::string id_;
  std::function<int()> action_;
};

}  // namespace

int command_line(const std::vector<Family>& families, int argc, char** argv) {
  try {
    return CommandLine(families).run(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "furrow: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "furrow: {}\n", error.what());
    return 3;
  }
}

}  // namespace furrow
