// Input: TOML tables read with their place in the file, so that every mistake is named by file, line and key.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "harness/units.hpp"

namespace furrow {

/// Wrong input or usage: one message that names the place, what stands there and what would be right. Exit code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// "FILE:LINE: KEY: MESSAGE"; line 0 is left out.
  InputError(std::string_view file, int line, std::string_view key, std::string_view message);
};

/// Hash of a text as 16 hexadecimal digits (64-bit FNV-1a).
std::string fingerprint(std::string_view text);

/// The word of the list that `word` was most likely meant to be; empty when none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

/// Closed or open interval that an input number must lie in, with the words for a message.
struct Range {
  double low, high;
  bool low_open = false, high_open = false;
  bool contains(double x) const;   ///< false for NaN and infinities outside the interval
  std::string words() const;       ///< "positive", "between 0.8 and 4", ...
};
namespace range {
inline constexpr double infinity = __builtin_huge_val();
inline constexpr Range any{-infinity, infinity, true, true};
inline constexpr Range positive{0.0, infinity, true, true};
inline constexpr Range not_negative{0.0, infinity, false, true};
}  // namespace range

/// A TOML table whose keys are asked for one by one. A key that nobody asked for is an error of the input (unknown key), found
/// by check_all_used() before anything runs. Copies share the record of used keys. All numbers are returned in SI.
/// Every function throws InputError with file, line, key, the value found and what would be right.
class Parameters {
 public:
  /// Parses TOML text; `file` is the name for messages.
  static Parameters parse(std::string_view text, std::string file);
  static Parameters read(const std::filesystem::path& file);

  bool has(std::string_view key) const;
  bool was_read(std::string_view key) const;               ///< whether anybody asked for the key
  bool is_table(std::string_view key) const;               ///< whether the key is there and holds a table

  /// Dimensionless number: a bare TOML number.
  double number(std::string_view key, Range allowed = range::any) const;
  double number_or(std::string_view key, double otherwise, Range allowed = range::any) const;
  /// Number with unit: { value = 25.4, unit = "mm" }; returned in SI. A bare number is an error unless the dimension is none.
  double quantity(std::string_view key, Dimension dimension, Range allowed = range::any) const;
  double quantity_or(std::string_view key, Dimension dimension, double otherwise, Range allowed = range::any) const;
  long integer(std::string_view key, long low, long high) const;
  long integer_or(std::string_view key, long otherwise, long low, long high) const;
  bool flag(std::string_view key) const;
  bool flag_or(std::string_view key, bool otherwise) const;
  std::string text(std::string_view key) const;
  std::string text_or(std::string_view key, std::string_view otherwise) const;
  /// One word of a list; the message of a wrong word prints the list.
  std::string choice(std::string_view key, const std::vector<std::string>& allowed) const;
  std::string choice_or(std::string_view key, std::string_view otherwise, const std::vector<std::string>& allowed) const;
  std::vector<double> numbers(std::string_view key, Range allowed = range::any) const;
  /// Several numbers with one unit: { value = [1, 2], unit = "mm" }.
  std::vector<double> quantities(std::string_view key, Dimension dimension, Range allowed = range::any) const;
  std::vector<std::string> texts(std::string_view key) const;
  Parameters table(std::string_view key) const;            ///< nested table; must be there
  Parameters table_or_empty(std::string_view key) const;   ///< nested table; empty when absent
  std::vector<Parameters> tables(std::string_view key) const;   ///< array of tables; empty when absent

  std::chrono::year_month_day date(std::string_view key) const;   ///< a TOML date: 2026-11-22

  /// A list of plain values or quantities, looked at one by one (for sweeps): how many, and each as it would stand in a name.
  std::size_t length(std::string_view key) const;
  std::string word(std::string_view key, std::size_t index) const;
  std::string word(std::string_view key) const;            ///< a single plain value in the same writing
  bool is_text(std::string_view key) const;

  std::vector<std::string> keys() const;
  const std::string& file() const;
  int line() const;                             ///< where this table begins
  int line(std::string_view key) const;         ///< where a key stands
  [[noreturn]] void fail(std::string_view key, std::string_view message) const;   ///< an InputError at this key

  /// Throws for the first key, in this table or those asked for below it, that was never asked for; suggests the nearest
  /// known key.
  void check_all_used() const;

  /// The same table with a fresh record of used keys, to be changed by the two functions below.
  Parameters copy() const;
  /// Puts the value `from.key[index]` at a dotted path; messages about it name the place where it stands in `from`.
  void assign(std::string_view path, const Parameters& from, std::string_view from_key, std::size_t index);
  /// Puts a value written as TOML at a dotted path; text that is no TOML value is taken as a string.
  void assign(std::string_view path, std::string_view value, const std::string& origin);
  std::string json() const;                     ///< the table as it was read

  /// Says that what this table describes depends on the contents of another file (a material, data) as well.
  void depends_on(const std::filesystem::path& file) const;
  /// Names and hashes of those files as they were then, of this table and those asked for below it: equal inputs, equal text.
  std::string dependencies() const;

  struct Node;
  explicit Parameters(std::shared_ptr<Node> node) : node_(std::move(node)) {}

 private:
  std::shared_ptr<Node> node_;
};

}  // namespace furrow
