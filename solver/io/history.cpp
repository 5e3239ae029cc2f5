#include "solver/io/history.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <set>
#include <stdexcept>
#include <utility>

#include "solver/io/hdf5.hpp"

namespace furrow {
namespace {

const std::string history_format = "furrow history";
constexpr std::int64_t history_version = 1;

const HistoryColumn& time_column() {
  static const HistoryColumn column = {"time", "t", "s", "Simulated time."};
  return column;
}

HistoryTable empty_table(const std::vector<HistoryColumn>& columns) {
  HistoryTable table;
  table.columns.push_back(time_column());
  table.columns.insert(table.columns.end(), columns.begin(), columns.end());
  std::set<std::string> names;
  for (const auto& column : table.columns) {
    if (column.name.empty() || column.name.find('/') != std::string::npos)
      throw std::invalid_argument(fmt::format("history: '{}' cannot name a column: it is empty or has a slash", column.name));
    if (!names.insert(column.name).second) throw std::invalid_argument(fmt::format("history: two columns '{}'", column.name));
    if (column.unit.empty())
      throw std::invalid_argument(fmt::format("history: column '{}' has no unit (a pure number has unit 1)", column.name));
  }
  table.values.resize(table.columns.size());
  return table;
}

}  // namespace

HistoryTable read_history(const std::filesystem::path& file) {
  const hdf5::Input input(file);
  const auto& root = input.root();
  if (const auto format = root.text_attribute("format"); format != history_format)
    throw FileError(file, fmt::format("is a '{}', not a '{}'", format, history_format));
  if (const auto version = root.integer_attribute("version"); version != std::vector{history_version})
    throw FileError(file, fmt::format("has history version {}; this program reads version {}",
                                      version.empty() ? 0 : version.front(), history_version));
  HistoryTable table;
  for (const auto& name : root.texts_attribute("columns")) {
    const auto dataset = root.dataset(name);
    table.columns.push_back({name, dataset.text_attribute("symbol"), dataset.text_attribute("unit"),
                             dataset.text_attribute("description")});
    table.values.push_back(dataset.read<double>());
    if (table.values.back().size() != table.rows())
      throw FileError(file, fmt::format("column '{}' has {} rows where '{}' has {}", name, table.values.back().size(),
                                        table.columns.front().name, table.rows()));
  }
  if (table.columns.empty() || table.columns.front() != time_column()) throw FileError(file, "its first column is not time in s");
  return table;
}

History::History(std::filesystem::path file, std::vector<HistoryColumn> columns, Interval flush_interval)
    : History(std::move(file), empty_table(columns), flush_interval) {
  flush();
}

History::History(std::filesystem::path file, HistoryTable table, Interval flush_interval)
    : file_(std::move(file)),
      table_(std::move(table)),
      flush_interval_(flush_interval),
      flushed_(std::chrono::steady_clock::now()) {}

History History::resume(const std::filesystem::path& file, const std::vector<HistoryColumn>& columns, std::size_t rows,
                        Interval flush_interval) {
  auto table = read_history(file);
  if (table.columns != empty_table(columns).columns) throw FileError(file, "has other columns than the run that shall go on");
  if (table.rows() < rows)
    throw FileError(file, fmt::format("has {} rows; the run that shall go on had written {}", table.rows(), rows));
  for (auto& column : table.values) column.resize(rows);
  History history(file, std::move(table), flush_interval);
  history.flush();
  return history;
}

History::~History() {
  if (!pending_ || table_.columns.empty()) return;   // no columns: moved from
  try {
    flush();
  } catch (const std::exception&) {
    // Said in the header: an error may already be under way.
  }
}

void History::append(double time, std::span<const double> values) {
  if (values.size() + 1 != table_.columns.size())
    throw std::invalid_argument(fmt::format("{}: a row of {} values for {} columns beside time", file_.string(), values.size(),
                                            table_.columns.size() - 1));
  pending_ = true;
  table_.values.front().push_back(time);
  for (std::size_t c = 0; c < values.size(); ++c) table_.values[c + 1].push_back(values[c]);
  if (std::chrono::steady_clock::now() - flushed_ >= flush_interval_) flush();
}

void History::flush() {
  hdf5::Output output(file_);
  auto& root = output.root();
  root.set_attribute("format", history_format);
  root.set_attribute("version", std::vector{history_version});
  std::vector<std::string> names;
  for (const auto& column : table_.columns) names.push_back(column.name);
  root.set_attribute("columns", names);
  for (std::size_t c = 0; c < table_.columns.size(); ++c) {
    const auto& column = table_.columns[c];
    auto dataset = root.write(column.name, table_.values[c]);
    dataset.set_attribute("unit", column.unit);
    dataset.set_attribute("symbol", column.symbol);
    dataset.set_attribute("description", column.description);
  }
  output.commit();
  flushed_ = std::chrono::steady_clock::now();
  pending_ = false;
}

}  // namespace furrow
