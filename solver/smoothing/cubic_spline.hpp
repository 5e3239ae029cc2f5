#pragma once

#include <numbers>
#include <string_view>

#include "solver/tensor/lanes.hpp"

namespace furrow {

/// Cubic B-spline (paper Eq. 4; Monaghan & Lattanzio 1985), support 2h:
/// w = 2/3 - q^2 + q^3/2 for q < 1, (2 - q)^3/6 for q < 2, written as truncated powers so that no branch is taken.
struct CubicSpline {
  static constexpr std::string_view name = "cubic_spline";
  static constexpr double support = 2.0;

  template <class Real>
  static constexpr Real w(const Real& q) {
    const Real a = positive_part(2.0 - q), b = positive_part(1.0 - q);
    return (a * a * a - 4.0 * b * b * b) / 6.0;
  }
  template <class Real>
  static constexpr Real dw(const Real& q) {
    const Real a = positive_part(2.0 - q), b = positive_part(1.0 - q);
    return -0.5 * a * a + 2.0 * b * b;
  }
  static constexpr double normalisation(int dim) {
    constexpr double pi = std::numbers::pi;
    return dim == 1 ? 1.0 : dim == 2 ? 15.0 / (7.0 * pi) : 3.0 / (2.0 * pi);
  }
};

}  // namespace furrow
