// Units: a number enters with its unit and becomes SI; it leaves with its unit again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace furrow {

/// Physical dimension as exponents of the SI base units that furrow meets.
struct Dimension {
  std::int8_t mass = 0, length = 0, time = 0, temperature = 0;
  friend constexpr auto operator<=>(const Dimension&, const Dimension&) = default;
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension mass{1, 0, 0, 0};
inline constexpr Dimension length{0, 1, 0, 0};
inline constexpr Dimension time{0, 0, 1, 0};
inline constexpr Dimension temperature{0, 0, 0, 1};
inline constexpr Dimension velocity{0, 1, -1, 0};
inline constexpr Dimension acceleration{0, 1, -2, 0};
inline constexpr Dimension rate{0, 0, -1, 0};
inline constexpr Dimension density{1, -3, 0, 0};
inline constexpr Dimension stress{1, -1, -2, 0};
inline constexpr Dimension force{1, 1, -2, 0};
inline constexpr Dimension force_per_width{1, 0, -2, 0};
inline constexpr Dimension energy{1, 2, -2, 0};
}  // namespace dimension

/// A unit: a quantity of `value` in this unit is `value * factor` in SI.
struct Unit {
  std::string symbol;
  double factor = 1.0;
  Dimension dimension;
};

/// Reads "mm", "kg/m^3", "J/(kg K)", "N m/m", "1", "%", "deg". Empty when the text is no unit that furrow knows.
std::optional<Unit> parse_unit(std::string_view text);

/// Reads a unit that the code itself names; throws std::logic_error when it is not one.
Unit unit(std::string_view text);

/// SI symbol of a dimension, for messages: "kg/m^3".
std::string si_symbol(Dimension dimension);

}  // namespace furrow
