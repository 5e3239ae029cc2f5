// Reference data: a curve or table of a measurement or of another computation, reference/data/<set>/ with
//   data.csv      first line the columns, each with its unit: "x (mm),height (mm)"; numbers only; an empty field is a number
//                 that is not reported
//   source.toml   what a reader needs to judge it:
//     source = "bui-2008"                # key of the bibliography
//     citation = "..."                   # figure or table, how it was digitised or computed
//     doi = "..."                        # optional
//     class = "experiment"               # experiment | published | independent
//     uncertainty = "..."                # standard uncertainty, in words and numbers
//     licence = "..."
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace furrow {

struct ReferenceData {
  std::string set, source, citation, doi, reference_class, uncertainty, licence;
  std::vector<std::string> columns;
  std::vector<std::vector<double>> values;   ///< one vector a column, in SI; NaN where a field is empty

  /// Values of a column by name, in SI; a std::out_of_range that names the columns there are.
  const std::vector<double>& column(std::string_view name) const;
  std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
};

/// The set of this name below `folder` (default: reference/data of the project). Throws InputError with file and line.
ReferenceData read_reference_data(std::string_view set, const std::filesystem::path& folder = {});

}  // namespace furrow
