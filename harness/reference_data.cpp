#include "harness/reference_data.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "harness/input.hpp"
#include "harness/provenance.hpp"
#include "harness/units.hpp"

namespace furrow {
namespace {

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> out(1);
  for (const char c : line)
    if (c == ',')
      out.emplace_back();
    else if (c != '\r')
      out.back() += c;
  return out;
}

}  // namespace

const std::vector<double>& ReferenceData::column(std::string_view name) const {
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c] == name) return values[c];
  throw std::out_of_range("reference data " + set + " has no column \"" + std::string(name) + "\"; there are: " +
                          fmt::to_string(fmt::join(columns, ", ")));
}

ReferenceData read_reference_data(std::string_view set, const std::filesystem::path& folder) {
  const std::filesystem::path home = (folder.empty() ? project_root() / "reference/data" : folder) / set;
  ReferenceData data;
  data.set = set;

  const Parameters source = Parameters::read(home / "source.toml");
  data.source = source.text("source");
  data.citation = source.text("citation");
  data.doi = source.text_or("doi", "");
  data.reference_class = source.choice("class", {"experiment", "published", "independent"});
  data.uncertainty = source.text("uncertainty");
  data.licence = source.text("licence");
  source.check_all_used();

  const std::string file = (home / "data.csv").string();
  std::ifstream in(file);
  std::string line;
  if (!in || !std::getline(in, line)) throw InputError(file, 0, "", "is not there or is empty, expected columns with units");
  std::vector<double> factor;
  for (const std::string& head : fields(line)) {
    const std::size_t open = head.find(" ("), close = head.rfind(')');
    const auto unit = open == std::string::npos || close != head.size() - 1 ? std::nullopt : parse_unit(head.substr(open + 2, close - open - 2));
    if (!unit) throw InputError(file, 1, head, "found no unit, expected a column head as in \"height (mm)\"");
    data.columns.push_back(head.substr(0, open));
    factor.push_back(unit->factor);
  }
  data.values.resize(data.columns.size());
  for (int number = 2; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    const std::vector<std::string> row = fields(line);
    if (row.size() != data.columns.size())
      throw InputError(file, number, "", "found " + std::to_string(row.size()) + " fields, expected " + std::to_string(data.columns.size()));
    for (std::size_t c = 0; c < row.size(); ++c) {
      double value = std::numeric_limits<double>::quiet_NaN();
      const char* const end = row[c].data() + row[c].size();
      if (!row[c].empty()) {
        const auto [stop, error] = std::from_chars(row[c].data(), end, value);
        if (error != std::errc{} || stop != end)
          throw InputError(file, number, data.columns[c], "found \"" + row[c] + "\", expected a number");
      }
      data.values[c].push_back(value * factor[c]);
    }
  }
  if (data.rows() == 0) throw InputError(file, 0, "", "has no rows");
  return data;
}

}  // namespace furrow
