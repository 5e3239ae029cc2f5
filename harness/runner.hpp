// Runner: many cases side by side, each in a process of its own, into one run folder with its report.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/case_file.hpp"

namespace furrow {

struct RunOptions {
  std::filesystem::path folder;              ///< empty: runs/<date>-<time>-<commit>, or with resume the latest one
  int jobs = 1, threads = 1;
  bool resume = false, replace = false, quiet = false, report = true;
  std::uint64_t particle_order = 0;          ///< 0, or the seed of another order of particles
  std::string tier;                          ///< as asked for; empty for `run`
  std::vector<std::string> only;             ///< of the tier, only ids that match one of these; empty: all
  std::vector<std::string> command;          ///< the command line as given, for the record
  std::vector<std::string> overrides;
};

/// Exit code: 0 nothing red, 1 a metric is red, 3 a case ended as error (or the report failed), 130 interrupted.
/// Throws InputError when the folder cannot be used.
int run_cases(const std::vector<CaseSpec>& cases, const RunOptions& options);

/// Makes the report of a run folder; true when it succeeded. A failure says why on standard error.
bool make_report(const std::filesystem::path& folder);

/// The hidden command of a case's own process: run-case RUNDIR CASEFILE ID.
int run_one(const std::vector<Family>& families, const std::filesystem::path& run_folder, const std::filesystem::path& case_file,
            const std::string& id);

}  // namespace furrow
