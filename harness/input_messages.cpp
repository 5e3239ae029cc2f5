// The words of input errors: where, what was found, what would be right.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/input.hpp"

namespace furrow {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : known)
    if (const std::size_t distance = edit_distance(word, candidate); distance < least) {
      least = distance;
      best = candidate;
    }
  return best;
}

InputError::InputError(std::string_view file, int line, std::string_view key, std::string_view message)
    : std::runtime_error(
          fmt::format("{}{}: {}{}{}", file, line > 0 ? fmt::format(":{}", line) : "", key, key.empty() ? "" : ": ", message)) {}

bool Range::contains(double x) const { return (low_open ? x > low : x >= low) && (high_open ? x < high : x <= high); }

std::string Range::words() const {
  if (std::isinf(low) && std::isinf(high)) return low_open || high_open ? "finite" : "a number";
  if (std::isinf(high)) {
    if (low == 0.0) return low_open ? "positive" : "zero or positive";
    return fmt::format("{} {:g}", low_open ? "greater than" : "at least", low);
  }
  if (std::isinf(low)) return fmt::format("{} {:g}", high_open ? "less than" : "at most", high);
  return fmt::format("between {:g}{} and {:g}{}", low, low_open ? " (excluded)" : "", high, high_open ? " (excluded)" : "");
}

}  // namespace furrow
