#pragma once

#include <numbers>
#include <string_view>

#include "solver/tensor/lanes.hpp"

namespace furrow {

/// Quintic B-spline (Schoenberg 1946; Morris, Fox & Zhu 1997), support 3h, as truncated powers so that no branch is taken:
/// w = (3 - q)^5 - 6 (2 - q)^5 + 15 (1 - q)^5.
struct QuinticSpline {
  static constexpr std::string_view name = "quintic_spline";
  static constexpr double support = 3.0;

  template <class Real>
  static constexpr Real w(const Real& q) {
    const Real a = positive_part(3.0 - q), b = positive_part(2.0 - q), c = positive_part(1.0 - q);
    return a * a * a * a * a - 6.0 * b * b * b * b * b + 15.0 * c * c * c * c * c;
  }
  template <class Real>
  static constexpr Real dw(const Real& q) {
    const Real a = positive_part(3.0 - q), b = positive_part(2.0 - q), c = positive_part(1.0 - q);
    return -5.0 * (a * a * a * a - 6.0 * b * b * b * b + 15.0 * c * c * c * c);
  }
  static constexpr double normalisation(int dim) {
    constexpr double pi = std::numbers::pi;
    return dim == 1 ? 1.0 / 120.0 : dim == 2 ? 7.0 / (478.0 * pi) : 1.0 / (120.0 * pi);
  }
};

}  // namespace furrow
