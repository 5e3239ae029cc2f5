// A shot: a rod of a laboratory's table, run with a material and compared with what was measured on it.
#pragma once

#include <string>

#include "harness/reference_data.hpp"
#include "validation/taylor-bar/impact.hpp"

namespace furrow::taylor_bar_cases {

/// What was measured on one rod, m; NaN where nothing was reported.
struct Measured {
  double final_length, foot_diameter, undeformed_length, diameter_at_fifth;
};

struct Shot {
  Impact impact;
  Measured measured{};
  std::vector<double> height, radius;   ///< digitised profile; empty where there is none
};

/// Standard uncertainties of the experiments, relative to the quantity; of the undeformed length relative to the first length.
/// They are those that the sets' source.toml states.
namespace uncertainty {
inline constexpr double final_length = 0.01, foot_diameter = 0.025, diameter_at_fifth = 0.015, undeformed_length = 0.1;
}

/// The shot of this impact speed (in m/s, as in the table) of a set, with material, scheme and arrangement of the case. A set is
/// a folder beside the case file, or else of reference/data. Throws InputError.
Shot read_shot(const Parameters& input, const ReferenceData& set, double speed);
ReferenceData read_set(const Parameters& input, const std::string& name);

/// Material, scheme and arrangement of a case, common to all problems of the family: `material`, `fracture` (default false: rods
/// of these shots did not break), `scheme`, `arrangement`.
Impact read_impact(const Parameters& input);

/// Sentences for the report on where the law is asked for more than it was measured for; empty when it is not.
/// Throws InputError at `key` for a rod that is molten before the impact.
std::vector<std::string> warnings(const Parameters& input, std::string_view key, const Impact& impact);
std::vector<std::string> warnings_after(const Impact& impact, const Outcome& outcome);

}  // namespace furrow::taylor_bar_cases
