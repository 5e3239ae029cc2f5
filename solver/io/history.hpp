// Histories: quantities over time in an HDF5 file, one dataset a column under "/". Each has the attributes `unit`, `symbol` and
// `description`; the attribute `columns` of "/" gives their order, `time` first (HDF5 itself lists names by alphabet).
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace furrow {

struct HistoryColumn {
  std::string name;           ///< "kinetic_energy"
  std::string symbol;         ///< "E_k"
  std::string unit;           ///< SI; "1" for a number without unit
  std::string description;    ///< one sentence
  bool operator==(const HistoryColumn&) const = default;
};

/// Columns and their values; columns[0] is time. values[c][r] is column c at row r.
struct HistoryTable {
  std::vector<HistoryColumn> columns;
  std::vector<std::vector<double>> values;
  std::size_t rows() const { return values.empty() ? 0 : values.front().size(); }
};

/// Reads what a History wrote.
/// @throws FileError if the file is unreadable, of another kind or version, or its columns differ in length
HistoryTable read_history(const std::filesystem::path& file);

/// A time series under construction. Rows are kept in memory; the whole file is written anew beside its name and renamed at the
/// first row after `flush_interval` of wall time, so a killed run keeps all but the last interval and never half a row.
class History {
 public:
  using Interval = std::chrono::steady_clock::duration;
  static constexpr Interval default_interval = std::chrono::seconds(5);

  /// A new history; `columns` without time, which every history has. Writes the (still empty) file at once, so that a folder that
  /// cannot be written to is known before anything is computed.
  /// @throws std::invalid_argument for an empty, repeated or slashed name or an empty unit
  /// @throws FileError
  History(std::filesystem::path file, std::vector<HistoryColumn> columns, Interval flush_interval = default_interval);

  /// Goes on with an existing history after its first `rows` rows (those known when a checkpoint was taken; later ones are
  /// dropped, they will be computed again). Flush before a checkpoint is written, so that its rows are there.
  /// @throws FileError if the file has other columns or fewer rows
  static History resume(const std::filesystem::path& file, const std::vector<HistoryColumn>& columns, std::size_t rows,
                        Interval flush_interval = default_interval);

  History(History&&) = default;
  History& operator=(History&&) = delete;
  /// Writes rows not yet written. A failure here is dropped, because a destructor may run while another error is under way: call
  /// flush() at the end of a run to hear of it.
  ~History();

  /// One row: time in s and the other columns in their order.
  /// @throws std::invalid_argument if the number of values is wrong
  /// @throws FileError from a flush that is due
  void append(double time, std::span<const double> values);
  /// Writes all rows.
  void flush();

  std::size_t rows() const { return table_.rows(); }
  const HistoryTable& table() const { return table_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  History(std::filesystem::path file, HistoryTable table, Interval flush_interval);

  std::filesystem::path file_;
  HistoryTable table_;
  Interval flush_interval_;
  std::chrono::steady_clock::time_point flushed_;
  bool pending_ = true;
};

}  // namespace furrow
