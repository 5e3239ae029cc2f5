#include "harness/runner.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <fstream>
#include <optional>

#include <unistd.h>

#include <fmt/format.h>

#include "harness/case_run.hpp"
#include "harness/dynamic_run.hpp"
#include "harness/process.hpp"
#include "harness/progress.hpp"
#include "harness/result.hpp"

namespace furrow {
namespace {

namespace fs = std::filesystem;

// The folder of this run, there and writable. A folder that already holds a run is only touched when the caller says so.
fs::path prepared_folder(const RunOptions& options, const Json& provenance) {
  fs::path folder = options.folder;
  if (folder.empty() && options.resume) {
    folder = project_root() / "runs/latest";
    if (!fs::exists(folder))
      throw InputError("--resume", 0, "", "found no earlier run in runs/latest, expected one, or --out DIR");
    folder = fs::canonical(folder);
  }
  if (folder.empty()) folder = project_root() / "runs" / fmt::format("{}-{}", time_for_names(), short_commit(provenance));
  folder = fs::absolute(folder).lexically_normal();
  std::error_code error;
  if (fs::exists(folder / "run.json", error) && !options.resume && !options.replace)
    throw InputError("--out " + folder.string(), 0, "",
                     "found an earlier run there, expected an empty folder, or --resume to go on with it, or --replace");
  fs::create_directories(folder, error);
  if (error)
    throw InputError("--out " + folder.string(), 0, "",
                     fmt::format("found {}, expected a folder that can be made", error.message()));
  try {
    write_whole(folder / ".writable",
                "");   // asking for permissions is not enough: root may everything, and a read-only mount nobody
    fs::remove(folder / ".writable");
  } catch (const std::runtime_error& reason) {
    throw InputError("--out " + folder.string(), 0, "",
                     fmt::format("found a folder that cannot be written ({}), expected one that can", reason.what()));
  }
  return folder;
}

// runs/latest -> the folder, for folders below runs/; renamed over the old link so that it is never missing.
void link_latest(const fs::path& folder) {
  const fs::path runs = project_root() / "runs";
  if (folder.parent_path() != runs.lexically_normal()) return;
  const fs::path beside = runs / fmt::format(".latest.{}", getpid());
  std::error_code ignored;
  fs::remove(beside, ignored);
  fs::create_symlink(folder.filename(), beside, ignored);
  if (!ignored) fs::rename(beside, runs / "latest", ignored);
}

bool may_be_kept(const Json& result, const CaseSpec& spec, const Json& provenance) {
  if (!result.is_object() || result.value("schema", 0) != 1 || result.value("case", "") != spec.id) return false;
  if (result.value("verdict", "error") == "error" || !result.contains("provenance")) return false;
  const Json& made = result["provenance"];
  const auto same = [&](const char* key) { return made.contains(key) && made[key] == provenance.at(key); };
  return same("commit") && same("program") && same("particle_order") && made.value("inputs", "") == spec.fingerprint;
}

// What makes two runs of a case the same computation. Written into its folder before it begins, so that a later run knows whether
// a checkpoint there is its own.
Json identity(const CaseSpec& spec, const Json& provenance) {
  return {{"case", spec.id},
          {"commit", provenance.at("commit")},
          {"program", provenance.at("program")},
          {"particle_order", provenance.at("particle_order")},
          {"inputs", spec.fingerprint}};
}
constexpr const char* identity_file = "begun.json";

// What the last run says that a case takes; empty where it says nothing.
std::optional<double> expected_seconds(const CaseSpec& spec) {
  const Json earlier = read_json(project_root() / "runs/latest" / spec.id / "result.json");
  if (!earlier.is_object() || !earlier.contains("cost") || earlier.value("verdict", "error") == "error") return std::nullopt;
  return earlier["cost"]["wall_s"].get<double>();
}

std::string last_words(const fs::path& log) {
  std::ifstream in(log);
  std::string last;
  for (std::string line; std::getline(in, line);)
    if (line.find_first_not_of(" \t=") != std::string::npos) last = line;
  return last.substr(0, 300);
}

// Runs one of the project's Python packages to its end; true when it succeeded, else it says on standard error what failed and how.
bool python(const char* what, std::vector<std::string> words, const fs::path& log) {
  const std::string root = project_root().string();
  words.insert(words.begin(), {"/usr/bin/env", "-C", root, "/usr/bin/python3", "-m"});
  Child child(words, {{"PYTHONPATH", root}, {"PYTHONDONTWRITEBYTECODE", "1"}}, log);
  while (!child.ended()) wait_for_any({&child}, 0.02);
  if (child.how().empty()) {
    fs::remove(log);
    return true;
  }
  const std::string last = last_words(log);
  fmt::print(stderr, "furrow: {} failed ({}){}{}\n", what, child.how(), last.empty() ? "" : ": ", last);
  return false;
}

struct RunningCase {
  const CaseSpec* spec;
  Child child;
  bool timed_out = false;
};

class Runner {
 public:
  Runner(const std::vector<CaseSpec>& cases, const RunOptions& options)
      : cases_(cases),
        options_(options),
        provenance_(provenance(options.threads, options.particle_order)),
        folder_(prepared_folder(options, provenance_)) {}

  int run() {
    catch_interrupts();
    checkpoint_interval();   // throws, before anything runs, when it is not one
    const auto start = std::chrono::steady_clock::now();
    std::map<std::string, std::optional<double>> expected;
    for (const CaseSpec& spec : cases_) expected[spec.id] = expected_seconds(spec);
    write_run(false, 0.0, 0);
    link_latest(folder_);
    run_all(std::move(expected));
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    std::vector<Json> results;
    for (const CaseSpec& spec : cases_)
      if (Json result = read_json(folder_ / spec.id / "result.json"); result.is_object()) results.push_back(std::move(result));
    write_whole(folder_ / "junit.xml", junit_xml(results));
    for (const Json& result : results) ++counts_[result["verdict"]];
    int code = interrupted() ? 130 : counts_["error"] > 0 ? 3 : counts_["fail"] > 0 ? 1 : 0;
    write_run(true, wall, code);
    // What moved since the baseline is for the report; here it is no verdict, and a baseline that cannot be read no failure.
    if (options_.report) python("the comparison with the baselines", {"gate", "record", folder_.string()}, folder_ / "gate.log");
    const bool reported = !options_.report || make_report(folder_);
    if (!reported && code < 2) write_run(true, wall, code = 3);
    if (!options_.quiet) summary(wall, reported);
    return code;
  }

 private:
  void run_all(std::map<std::string, std::optional<double>> expected) {
    std::deque<const CaseSpec*> waiting;
    for (const CaseSpec& spec : cases_) {
      const fs::path file = folder_ / spec.id / "result.json";
      if (options_.resume && may_be_kept(read_json(file), spec, provenance_)) {
        ++kept_;
        expected.erase(spec.id);
        continue;
      }
      prepare_place(spec);
      waiting.push_back(&spec);
    }
    const auto at_most = [&](const CaseSpec* spec) { return expected[spec->id].value_or(spec->time_limit); };
    std::stable_sort(waiting.begin(), waiting.end(),
                     [&](const CaseSpec* a, const CaseSpec* b) { return at_most(a) > at_most(b); });

    Progress progress(expected, options_.jobs, options_.quiet);
    std::deque<RunningCase> running;
    while (!interrupted() && (!waiting.empty() || !running.empty())) {
      while (!waiting.empty() && running.size() < static_cast<std::size_t>(options_.jobs)) {
        progress.started(waiting.front()->id);
        running.push_back({waiting.front(), start(*waiting.front())});
        waiting.pop_front();
      }
      std::vector<const Child*> children;
      for (const RunningCase& r : running) children.push_back(&r.child);
      wait_for_any(children, 0.05);
      std::deque<RunningCase> still;
      for (RunningCase& r : running) {
        if (const std::string line = r.child.last_line(); !line.empty()) progress.moved(r.spec->id, case_progress(line));
        if (r.child.ended()) {
          const Json result = completed(r);
          cpu_seconds_ += r.child.cpu_seconds();
          progress.finished(r.spec->id, result["verdict"], result.value("reason", ""), r.child.seconds());
          continue;
        }
        if (r.child.seconds() > r.spec->time_limit) {
          r.timed_out = true;
          r.child.kill();
        }
        still.push_back(std::move(r));
      }
      running = std::move(still);
      progress.draw();
    }
  }

  // An empty folder for the case; or, to go on, the one that the same computation has left, without its result.
  void prepare_place(const CaseSpec& spec) const {
    const fs::path place = folder_ / spec.id;
    const Json ours = identity(spec, provenance_);
    if (options_.resume && read_json(place / identity_file) == ours) {
      fs::remove(place / "result.json");
      return;
    }
    fs::remove_all(place);
    fs::create_directories(place);
    write_json(place / identity_file, ours);
  }

  Child start(const CaseSpec& spec) const {
    const fs::path place = folder_ / spec.id;
    const std::string threads = std::to_string(options_.threads);
    return Child(
        {fs::read_symlink("/proc/self/exe").string(), "run-case", folder_.string(), fs::absolute(spec.file).string(), spec.id},
        {{"OMP_NUM_THREADS", threads}}, place / "log.txt");
  }

  // The result that the case's process has left; when it has left none, an error result that says how it ended.
  Json completed(const RunningCase& ended) const {
    const fs::path place = folder_ / ended.spec->id, log = place / "log.txt";
    std::string how = ended.child.how();
    if (ended.timed_out) how = fmt::format("ran longer than its time limit of {}", duration_words(ended.spec->time_limit));
    Json result = read_json(place / "result.json");
    const bool whole = result.is_object() && result.value("case", "") == ended.spec->id;
    if (!how.empty() || !whole) {
      const std::string words = last_words(log);
      const std::string reason = (how.empty() ? "it left no result" : how) + (words.empty() ? "" : ": " + words);
      Cost cost;
      cost.wall = ended.child.seconds();
      cost.cpu = ended.child.cpu_seconds();
      cost.peak_rss = ended.child.peak_rss();
      result = result_json(*ended.spec, all_error(*ended.spec, reason), {}, cost, provenance_);
      write_json(place / "result.json", result);
    }
    std::error_code ignored;
    if (fs::file_size(log, ignored) == 0) fs::remove(log, ignored);
    return result;
  }

  void write_run(bool ended, double wall, int code) const {
    Json ids = Json::array(), files = Json::array(), seeds = Json::object();
    for (const CaseSpec& spec : cases_) {
      ids.push_back(spec.id);
      if (const std::string file = spec.file.string(); std::find(files.begin(), files.end(), file) == files.end())
        files.push_back(file);
      if (const Json parameters = Json::parse(spec.parameters_json); parameters.contains("seed"))
        seeds[spec.id] = parameters["seed"];
    }
    Json run{{"schema", 1}, {"provenance", provenance_}, {"command", options_.command}};
    if (!options_.tier.empty()) run["tier"] = options_.tier;
    if (!options_.only.empty()) run["only"] = options_.only;
    run["cases"] = ids;
    run["case_files"] = files;
    run["overrides"] = options_.overrides;
    run["seeds"] = seeds;
    run["jobs"] = options_.jobs;
    run["threads"] = options_.threads;
    run["started"] = provenance_["started"];
    run["state"] = !ended ? "running" : code == 130 ? "interrupted" : "finished";
    if (ended) {
      run["finished"] = time_for_records();
      run["wall_s"] = wall;
      run["cpu_s"] = cpu_seconds_;
      run["counts"] = counts_;
      run["exit_code"] = code;
    }
    write_json(folder_ / "run.json", run);
  }

  void summary(double wall, bool reported) {
    const int done = counts_["pass"] + counts_["fail"] + counts_["error"] + counts_["known-gap"];
    fmt::print("{} of {} cases in {}: {} pass, {} fail, {} error, {} known-gap{}\n", done, cases_.size(), duration_words(wall),
               counts_["pass"], counts_["fail"], counts_["error"], counts_["known-gap"],
               kept_ > 0 ? fmt::format(" ({} kept from before)", kept_) : "");
    if (options_.report && reported) fmt::print("report: {}\n", (folder_ / "report/index.html").string());
    else fmt::print("results: {}\n", folder_.string());
  }

  const std::vector<CaseSpec>& cases_;
  const RunOptions& options_;
  const Json provenance_;
  const fs::path folder_;
  std::map<std::string, int> counts_;
  double cpu_seconds_ = 0.0;
  int kept_ = 0;
};

}  // namespace

int run_cases(const std::vector<CaseSpec>& cases, const RunOptions& options) { return Runner(cases, options).run(); }

bool make_report(const fs::path& folder) {
  return python("the report", {"reports", fs::absolute(folder).string(), "--quiet"}, folder / "report.log");
}

int run_one(const std::vector<Family>& families, const fs::path& run_folder, const fs::path& case_file, const std::string& id) {
  const Json run = read_json(run_folder / "run.json");
  if (!run.is_object()) throw InputError((run_folder / "run.json").string(), 0, "", "found no record of a run, expected one");
  const Bibliography bibliography = read_bibliography(project_root() / "reference/sources.toml");
  const std::vector<CaseSpec> specs = read_case_file(case_file, families, nullptr, bibliography, {run["overrides"], {id}});
  const auto spec = std::find_if(specs.begin(), specs.end(), [&](const CaseSpec& s) { return s.id == id; });
  if (spec == specs.end()) throw InputError(case_file.string(), 0, id, "found no such case, expected it there");
  run_case(*spec, run_folder / id, run["provenance"], run["threads"], 3, run["provenance"]["particle_order"]);
  return 0;
}

}  // namespace furrow
