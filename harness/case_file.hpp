// Case files: cases.toml of a family, or a file from outside the repository, read into case specifications. Everything is checked
// here, problems are built, and nothing runs.
//
//   family = "kernel"                    # in the repository: the family of the folder
//   [sources.my-report]                  # optional; more entries for the bibliography (reference/sources.toml), for this file
//   text = "..."; doi = "..."            #   (each on a line of its own)
//
//   [[case]]
//   name = "continuous-{kernel}-{dimension}d"   # id is family/name; {x} is filled in from the sweep, underscores become dashes
//   problem = "continuous"                      # a word that the family's case.cpp adds
//   title = "..."                               # in title, why and description {x} is filled in too, underscores become spaces
//   why = "..."                                 # the reason why this case exists
//   description = "..."                         # a paragraph: the problem as a mechanician tells it
//   tier = "smoke"                              # smoke | quick | nightly | full
//   time_limit = { value = 60, unit = "s" }     # optional; default 60 s, 5 min, 60 min, 6 h by tier
//   sources = ["tillage-tools-2024"]                     # optional; citations beside those of the metrics
//   sweep = { kernel = ["cubic_spline"], dimension = [1, 2, 3] }    # optional; an instance a combination of parameters
//   parameters = { ... }                        # what the problem asks for
//   resolution = { spacing = { value = [4, 2, 1], unit = "mm" }, h_over_dx = [1.2, 1.5] }   # optional; a run a pair
//   metric_sets = ["conservation"]              # optional; metrics that several cases share, before the case's own. Of one name,
//                                               # a later set's and the case's own stand in the place of an earlier set's
//
//   [[metric-set.conservation]]                 # one metric of a set, with the keys of [[case.metric]]
//
//   [[case.metric]]
//   name = "unit_integral"; symbol = "int W dV"; unit = "1"; description = "..."
//   class = "exact"                             # exact | manufactured | independent | experiment | published | self
//   reference = { value = 1.0, standard_uncertainty = 0.0, source = "monaghan-1985" }
//                                               # value in the metric's unit, or "computed": the code hands it over; with norm
//                                               # "value" it may be left out; source is a key of the bibliography
//   norm = "absolute"                           # absolute: value - reference; relative: (value - reference)/reference; value:
//                                               # the band is on the value itself. A field norm may stand before: "L2 relative".
//                                               # A value that is itself a norm of an error says which: "L2 relative value"
//   band = [-1e-10, 1e-10]                      # in the metric's unit (relative: 1); -inf or inf is an open end
//   band_why = "..."                            # where the band comes from
//   reported = true                             # instead of band and band_why: shown, not gated
//   at = { h_over_dx = 1.5, spacing = { value = 1, unit = "mm" } }   # optional; the gated rung; default: finest, first h/dx
//   ladder = "error"                            # optional; "error" converges to zero, "value" to a limit
//   observed_order_of = "gradient_l2"           # instead of being measured: the order of that metric's ladder at this h/dx
//   states = ["asymptotic", "plateau"]          # optional, with observed_order_of; the states in which the order may pass
//                                               # (asymptotic, plateau, undetermined); default: asymptotic alone
//   limit_of = "final_length"                   # instead of being measured: what that metric's ladder of values tends to. Where it
//                                               # has no usable fit, the finest value with its numerical uncertainty on both sides
//   when = { kernel = ["wendland_c2"] }         # optional; the metric is there for these parameter values only
//   known_gap = { reason = "...", date = 2026-11-22, expires = 2027-05-22 }   # optional
#pragma once

#include <array>
#include <chrono>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/case.hpp"
#include "harness/input.hpp"
#include "harness/ladder.hpp"
#include "harness/units.hpp"

namespace furrow {

enum class Tier { smoke, quick, nightly, full };
inline const std::vector<std::string> tier_names{"smoke", "quick", "nightly", "full"};
inline const std::string& name(Tier tier) { return tier_names[static_cast<std::size_t>(tier)]; }
Tier tier_by_name(const std::string& name);

struct Citation {
  std::string key, text, doi;
};
using Bibliography = std::map<std::string, Citation, std::less<>>;
Bibliography read_bibliography(const std::filesystem::path& file);

struct KnownGap {
  std::string reason;
  std::chrono::year_month_day date, expires;   ///< from the day of expiry on the gap is a failure
};

struct Band {
  double low, high;
  bool contains(double x) const { return low <= x && x <= high; }
};

enum class Norm { absolute, relative, value };

struct MetricSpec {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  std::string name, symbol, description, reference_class;
  Unit unit;
  bool computed_reference = false;         ///< the code hands the reference over
  double reference = none;                 ///< in `unit`
  double standard_uncertainty = none;      ///< in `unit`
  std::string source;                      ///< key of the bibliography
  Norm norm = Norm::absolute;
  std::string norm_words;                  ///< as in the file: "L2 relative"
  std::optional<Band> band;                ///< empty: reported, not gated
  std::string band_why;
  std::size_t spacing_index = 0, ratio_index = 0;   ///< the gated rung
  std::optional<LadderKind> ladder;
  std::string observed_order_of, limit_of;   ///< both empty for a metric that the code measures
  std::vector<LadderState> states;         ///< in which an observed order may pass
  std::optional<KnownGap> known_gap;

  /// The metric whose ladder this one is read from; empty where the code measures it.
  const std::string& ladder_of() const { return observed_order_of.empty() ? limit_of : observed_order_of; }
};

struct CaseSpec {
  std::string id, family, problem, title, why, description;
  Tier tier = Tier::smoke;
  double time_limit = 0.0;                 ///< s
  std::vector<double> spacing;             ///< m, coarse to fine; empty for a problem without ladder
  std::vector<double> smoothing_ratio;     ///< h/dx in the order of the file
  std::string spacing_unit = "m";          ///< as in the file, for output
  std::string parameters_json;             ///< the instance's parameters as read
  std::vector<MetricSpec> metrics;
  std::vector<Citation> citations;
  std::vector<std::string> overrides;      ///< --set KEY=VALUE
  Problem run;
  std::filesystem::path file;
  std::string fingerprint;                 ///< hash of the instance and the files that it reads: equal inputs, equal fingerprint
};

/// Overrides of the command line ("parameters.kernel=wendland_c2") and the ids of the cases that they apply to.
struct Overrides {
  std::vector<std::string> assignments;
  std::vector<std::string> ids;
};

/// Reads a case file; throws InputError. `family` is the one the file must name (in the repository), or null.
std::vector<CaseSpec> read_case_file(const std::filesystem::path& file, const std::vector<Family>& families, const Family* family,
                                     const Bibliography& bibliography, const Overrides& overrides = {});

/// Every case of the families (their cases.toml below `root`) and of the files from outside, ids unique.
std::vector<CaseSpec> read_all_cases(const std::vector<Family>& families, const std::filesystem::path& root,
                                     const std::vector<std::filesystem::path>& outside, const Overrides& overrides = {});

}  // namespace furrow
