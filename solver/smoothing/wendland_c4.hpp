#pragma once

#include <numbers>
#include <string_view>

#include "solver/tensor/lanes.hpp"

namespace furrow {

/// Wendland's C4 function (Wendland 1995; Dehnen & Aly 2012, Table 1) with support 2h: w = (1 - r)^6 (1 + 6 r + 35/3 r^2),
/// r = q/2. In one dimension the function of lowest degree is another one, w = (1 - r)^5 (1 + 5 r + 8 r^2).
struct WendlandC4 {
  static constexpr std::string_view name = "wendland_c4";
  static constexpr double support = 2.0;

  template <class Real>
  static constexpr Real w(const Real& q) {
    const Real r = 0.5 * q, a = positive_part(1.0 - r), a2 = a * a;
    return a2 * a2 * a2 * (1.0 + r * (6.0 + 35.0 / 3.0 * r));
  }
  template <class Real>
  static constexpr Real dw_over_q(const Real& q) {
    const Real r = 0.5 * q, a = positive_part(1.0 - r), a2 = a * a;
    return -14.0 / 3.0 * (1.0 + 5.0 * r) * a2 * a2 * a;
  }
  template <class Real>
  static constexpr Real dw(const Real& q) {
    return q * dw_over_q(q);
  }

  struct OneDimensional {
    template <class Real>
    static constexpr Real w(const Real& q) {
      const Real r = 0.5 * q, a = positive_part(1.0 - r), a2 = a * a;
      return a2 * a2 * a * (1.0 + r * (5.0 + 8.0 * r));
    }
    template <class Real>
    static constexpr Real dw_over_q(const Real& q) {
      const Real r = 0.5 * q, a = positive_part(1.0 - r), a2 = a * a;
      return -3.5 * (1.0 + 4.0 * r) * a2 * a2;
    }
    template <class Real>
    static constexpr Real dw(const Real& q) {
      return q * dw_over_q(q);
    }
  };

  static constexpr double normalisation(int dim) {
    constexpr double pi = std::numbers::pi;
    return dim == 1 ? 3.0 / 4.0 : dim == 2 ? 9.0 / (4.0 * pi) : 495.0 / (256.0 * pi);
  }
};

}  // namespace furrow
