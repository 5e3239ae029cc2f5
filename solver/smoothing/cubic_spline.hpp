#pragma once

#include <numbers>
#include <string_view>

namespace furrow {

/// Cubic B-spline (paper Eq. 4; Monaghan & Lattanzio 1985), support 2h:
/// w = 2/3 - q^2 + q^3/2 for q < 1, (2 - q)^3/6 for q < 2, written as truncated powers so that no branch is taken.
struct CubicSpline {
  static constexpr std::string_view name = "cubic_spline";
  static constexpr double support = 2.0;

  static constexpr double w(double q) {
    const double a = q < 2.0 ? 2.0 - q : 0.0, b = q < 1.0 ? 1.0 - q : 0.0;
    return (a * a * a - 4.0 * b * b * b) / 6.0;
  }
  static constexpr double dw(double q) {
    const double a = q < 2.0 ? 2.0 - q : 0.0, b = q < 1.0 ? 1.0 - q : 0.0;
    return -0.5 * a * a + 2.0 * b * b;
  }
  static constexpr double normalisation(int dim) {
    constexpr double pi = std::numbers::pi;
    return dim == 1 ? 1.0 : dim == 2 ? 15.0 / (7.0 * pi) : 3.0 / (2.0 * pi);
  }
};

}  // namespace furrow
