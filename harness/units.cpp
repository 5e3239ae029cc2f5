#include "harness/units.hpp"

#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace furrow {
namespace {

struct Base {
  std::string_view symbol;
  double factor;
  Dimension dimension;
};

// Units that are read as they stand.
constexpr std::array named{
    Base{"1", 1.0, dimension::none},
    Base{"%", 0.01, dimension::none},
    Base{"rad", 1.0, dimension::none},
    Base{"deg", std::numbers::pi / 180.0, dimension::none},
    Base{"min", 60.0, dimension::time},
    Base{"h", 3600.0, dimension::time},
    Base{"t", 1000.0, dimension::mass},
    Base{"K", 1.0, dimension::temperature},
};

// Units that also take an SI prefix.
constexpr std::array prefixed{
    Base{"m", 1.0, dimension::length},
    Base{"g", 1e-3, dimension::mass},
    Base{"s", 1.0, dimension::time},
    Base{"Hz", 1.0, dimension::rate},
    Base{"N", 1.0, dimension::force},
    Base{"Pa", 1.0, dimension::stress},
    Base{"J", 1.0, dimension::energy},
    Base{"W", 1.0, Dimension{1, 2, -3, 0}},
};

struct Prefix {
  std::string_view symbol;
  double factor;
};
constexpr std::array prefixes{Prefix{"G", 1e9},  Prefix{"M", 1e6},  Prefix{"k", 1e3},   Prefix{"c", 1e-2},
                              Prefix{"m", 1e-3}, Prefix{"u", 1e-6}, Prefix{"\u00b5", 1e-6}, Prefix{"n", 1e-9}};

std::optional<Base> base_unit(std::string_view symbol) {
  for (const Base& b : named)
    if (b.symbol == symbol) return b;
  for (const Base& b : prefixed) {
    if (b.symbol == symbol) return b;
    for (const Prefix& p : prefixes)
      if (symbol.size() == p.symbol.size() + b.symbol.size() && symbol.starts_with(p.symbol) && symbol.ends_with(b.symbol))
        return Base{symbol, p.factor * b.factor, b.dimension};
  }
  return std::nullopt;
}

Dimension power(Dimension d, int n) {
  const auto times = [n](std::int8_t e) { return static_cast<std::int8_t>(e * n); };
  return {times(d.mass), times(d.length), times(d.time), times(d.temperature)};
}

Dimension product(Dimension a, Dimension b) {
  const auto sum = [](std::int8_t x, std::int8_t y) { return static_cast<std::int8_t>(x + y); };
  return {sum(a.mass, b.mass), sum(a.length, b.length), sum(a.time, b.time), sum(a.temperature, b.temperature)};
}

// Grammar: product ["/" product], a product being factors apart by spaces or dots, or a product in parentheses;
// a factor is a unit with an optional power ("m^2", "s^-1").
class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  std::optional<Unit> read() {
    auto result = read_product();
    while (result && take('/')) {
      const auto below = read_term();
      if (!below) return std::nullopt;
      result->factor /= below->factor;
      result->dimension = product(result->dimension, power(below->dimension, -1));
    }
    skip_spaces();
    return rest_.empty() ? result : std::nullopt;
  }

 private:
  void skip_spaces() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
  }
  bool take(char c) {
    skip_spaces();
    if (rest_.empty() || rest_.front() != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  std::optional<Unit> read_product() {
    auto result = read_term();
    while (result) {
      take('.');
      skip_spaces();
      if (rest_.empty() || rest_.front() == '/' || rest_.front() == ')') break;
      const auto next = read_term();
      if (!next) return std::nullopt;
      result->factor *= next->factor;
      result->dimension = product(result->dimension, next->dimension);
    }
    return result;
  }
  std::optional<Unit> read_term() {
    if (take('(')) {
      auto inner = read_product();
      return take(')') ? inner : std::nullopt;
    }
    skip_spaces();
    std::size_t length = 0;
    while (length < rest_.size() && std::string_view(" ./()^").find(rest_[length]) == std::string_view::npos) ++length;
    const auto base = base_unit(rest_.substr(0, length));
    if (!base) return std::nullopt;
    rest_.remove_prefix(length);
    int exponent = 1;
    if (take('^')) {
      const bool negative = take('-');
      if (rest_.empty() || !std::isdigit(static_cast<unsigned char>(rest_.front()))) return std::nullopt;
      exponent = (rest_.front() - '0') * (negative ? -1 : 1);
      rest_.remove_prefix(1);
    }
    return Unit{"", std::pow(base->factor, exponent), power(base->dimension, exponent)};
  }

  std::string_view rest_;
};

}  // namespace

std::optional<Unit> parse_unit(std::string_view text) {
  auto result = Reader(text).read();
  if (result) result->symbol = std::string(text);
  return result;
}

Unit unit(std::string_view text) {
  auto result = parse_unit(text);
  if (!result) throw std::logic_error("'" + std::string(text) + "' is no unit that furrow knows");
  return *std::move(result);
}

std::string si_symbol(Dimension dimension) {
  struct Named {
    Dimension dimension;
    std::string_view symbol;
  };
  constexpr std::array names{Named{dimension::none, "1"}, Named{dimension::stress, "Pa"}, Named{dimension::force, "N"},
                             Named{dimension::energy, "J"}, Named{dimension::force_per_width, "N/m"}};
  for (const Named& n : names)
    if (n.dimension == dimension) return std::string(n.symbol);

  std::string above, below;
  int factors_below = 0;
  const auto put = [&](std::string_view symbol, int exponent) {
    if (exponent == 0) return;
    std::string& side = exponent > 0 ? above : below;
    if (exponent < 0) ++factors_below;
    if (!side.empty()) side += ' ';
    side += symbol;
    if (std::abs(exponent) > 1) side += "^" + std::to_string(std::abs(exponent));
  };
  put("kg", dimension.mass);
  put("m", dimension.length);
  put("s", dimension.time);
  put("K", dimension.temperature);
  if (above.empty()) above = "1";
  if (below.empty()) return above;
  return above + "/" + (factors_below > 1 ? "(" + below + ")" : below);
}

}  // namespace furrow
