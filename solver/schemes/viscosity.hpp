// Artificial viscosity (Monaghan & Gingold 1983; Monaghan 1992).
#pragma once

#include "solver/tensor/lanes.hpp"

namespace furrow {

struct ArtificialViscosity {
  double alpha = 1.0;   ///< linear term, sound
  double beta = 2.0;    ///< quadratic term, shocks
};

/// Pi_ij = (-alpha c mu + beta mu^2)/rho, mu = h v_ij.x_ij/(r^2 + 0.01 h^2), for approaching pairs; m^5/(kg s^2).
/// c and rho are means of the pair.
inline Lanes artificial_viscosity(const ArtificialViscosity& model, const Lanes& v_dot_x, const Lanes& r, double h, const Lanes& c,
                                  const Lanes& rho) {
  const Lanes approach = v_dot_x < 0.0 ? v_dot_x : Lanes{};
  const Lanes mu_over_rho = h * approach / ((r * r + 0.01 * h * h) * rho);   // one division, not two
  return (model.beta * mu_over_rho * rho - model.alpha * c) * mu_over_rho;
}

}  // namespace furrow
