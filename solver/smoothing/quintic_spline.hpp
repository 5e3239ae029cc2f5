#pragma once

#include <numbers>
#include <string_view>

namespace furrow {

/// Quintic B-spline (Schoenberg 1946; Morris, Fox & Zhu 1997), support 3h, as truncated powers so that no branch is taken:
/// w = (3 - q)^5 - 6 (2 - q)^5 + 15 (1 - q)^5.
struct QuinticSpline {
  static constexpr std::string_view name = "quintic_spline";
  static constexpr double support = 3.0;

  static constexpr double w(double q) {
    const double a = q < 3.0 ? 3.0 - q : 0.0, b = q < 2.0 ? 2.0 - q : 0.0, c = q < 1.0 ? 1.0 - q : 0.0;
    return a * a * a * a * a - 6.0 * b * b * b * b * b + 15.0 * c * c * c * c * c;
  }
  static constexpr double dw(double q) {
    const double a = q < 3.0 ? 3.0 - q : 0.0, b = q < 2.0 ? 2.0 - q : 0.0, c = q < 1.0 ? 1.0 - q : 0.0;
    return -5.0 * (a * a * a * a - 6.0 * b * b * b * b + 15.0 * c * c * c * c);
  }
  static constexpr double normalisation(int dim) {
    constexpr double pi = std::numbers::pi;
    return dim == 1 ? 1.0 / 120.0 : dim == 2 ? 7.0 / (478.0 * pi) : 1.0 / (120.0 * pi);
  }
};

}  // namespace furrow
