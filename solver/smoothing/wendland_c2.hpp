#pragma once

#include <numbers>
#include <string_view>

#include "solver/tensor/lanes.hpp"

namespace furrow {

/// Wendland's C2 function (Wendland 1995; Dehnen & Aly 2012, Table 1) with support 2h: w = (1 - r)^4 (1 + 4 r), r = q/2.
/// In one dimension the function of lowest degree is another one, w = (1 - r)^3 (1 + 3 r).
struct WendlandC2 {
  static constexpr std::string_view name = "wendland_c2";
  static constexpr double support = 2.0;

  template <class Real>
  static constexpr Real w(const Real& q) {
    const Real r = 0.5 * q, a = positive_part(1.0 - r);
    return a * a * a * a * (1.0 + 4.0 * r);
  }
  template <class Real>
  static constexpr Real dw_over_q(const Real& q) {
    const Real r = 0.5 * q, a = positive_part(1.0 - r);
    return -5.0 * a * a * a;
  }
  template <class Real>
  static constexpr Real dw(const Real& q) {
    return q * dw_over_q(q);
  }

  struct OneDimensional {
    template <class Real>
    static constexpr Real w(const Real& q) {
      const Real r = 0.5 * q, a = positive_part(1.0 - r);
      return a * a * a * (1.0 + 3.0 * r);
    }
    template <class Real>
    static constexpr Real dw_over_q(const Real& q) {
      const Real r = 0.5 * q, a = positive_part(1.0 - r);
      return -3.0 * a * a;
    }
    template <class Real>
    static constexpr Real dw(const Real& q) {
      return q * dw_over_q(q);
    }
  };

  static constexpr double normalisation(int dim) {
    constexpr double pi = std::numbers::pi;
    return dim == 1 ? 5.0 / 8.0 : dim == 2 ? 7.0 / (4.0 * pi) : 21.0 / (16.0 * pi);
  }
};

}  // namespace furrow
