// One case, run in this process: every rung of its ladder, the gate, result.json.
#pragma once

#include <filesystem>

#include "harness/case_file.hpp"
#include "harness/provenance.hpp"

namespace furrow {

/// What the process of a case tells the testbed through its pipe, one line each: fields apart by spaces, in this order.
struct CaseProgress {
  int rung = 0, rungs = 1;               ///< how many rungs are done, of how many
  double simulated_time = 0.0, end_time = 0.0;   ///< s
  double steps_per_second = 0.0;
};
std::string to_line(const CaseProgress& progress);
CaseProgress case_progress(const std::string& line);

/// Runs the case and writes `folder`/result.json. An exception of the problem becomes an error result.
/// `progress` is a file descriptor, or -1; `particle_order` is Run's.
void run_case(const CaseSpec& spec, const std::filesystem::path& folder, const Json& provenance, int threads, int progress,
              std::uint64_t particle_order);

}  // namespace furrow
