// The gate: from what the runs of a case measured to a verdict. A green needs a finite number inside a declared band; whatever is
// missing, left over or not a number is an error and never a pass.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "harness/case.hpp"
#include "harness/case_file.hpp"
#include "harness/ladder.hpp"

namespace furrow {

enum class Verdict { pass, fail, error, known_gap, skipped, reported };
std::string_view name(Verdict verdict);

/// What one rung of a case measured.
struct Rung {
  std::size_t spacing_index = 0, ratio_index = 0;
  std::map<std::string, Measurement, std::less<>> measurements;
};

struct MetricResult {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  double value = none;                    ///< in the metric's unit, at the gated rung
  double reference = none, standard_uncertainty = none;   ///< in the metric's unit
  double error = none;                    ///< the number that the band is about, by the metric's norm
  Verdict verdict = Verdict::error;
  std::string reason;
  std::vector<Ladder> ladders;            ///< one for each h/dx, in the order of the case file
};

struct CaseVerdict {
  Verdict verdict = Verdict::error;
  std::string reason;                     ///< of an error or a known gap
  std::vector<MetricResult> metrics;      ///< in the order of the case's metrics
};

/// Judges a case from all its rungs. `today` decides whether known gaps have expired.
CaseVerdict judge(const CaseSpec& spec, const std::vector<Rung>& rungs, std::chrono::year_month_day today);

/// The verdict of a case that produced nothing: every metric is an error for this reason.
CaseVerdict all_error(const CaseSpec& spec, const std::string& reason);

}  // namespace furrow
