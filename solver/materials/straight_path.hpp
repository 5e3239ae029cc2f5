#pragma once

#include <algorithm>
#include <cmath>

#include "solver/tensor/tensor.hpp"

namespace furrow {

/// Where a step of straight deviatoric strain leads a deviator that may move in no wider a circle than it has reached.
struct StraightPath {
  Tensor direction;   ///< s at the end is q times this; sqrt(3 J2) of it is 1
  double q_trial;     ///< Pa; q at the end is q_trial - 3 G d_eps_p
};

/// Von Mises flow along straight strain, exact for perfect plasticity (Krieg & Krieg 1977): s moves elastically along `way`
/// = 2 G de' until sqrt(3 J2) = q_yield, and from there turns towards it on the circle of that radius r. With c the cosine
/// between s and way where flow begins and u = |way|/r what is left of the way,
///   s -> r [s/r + (sinh u + c (cosh u - 1)) way/|way|] / (cosh u + c sinh u),   q_trial = q + sqrt(3/2) r ln(cosh u + c sinh u).
/// Along s the two are those of the radial return, s + way. A radial return over a large step that turns s errs by u^2/4.
inline StraightPath straight_path(const Tensor& s, const Tensor& way, double q_yield) {
  const double root = std::sqrt(1.5);
  const Tensor trial = s + way;
  const double length = way.norm(), q_end = root * trial.norm();
  if (q_end <= q_yield || length == 0.0) return {q_end > 0.0 ? Tensor(trial / q_end) : Tensor(Tensor::Zero()), q_end};

  const Tensor e = way / length;
  const double along = double_contraction(s, e), inside = 2.0 / 3.0 * q_yield * q_yield - s.squaredNorm();
  // The part of the length that is elastic: out of the circle from inside, or inwards from outside (viscous overstress) and out
  // again.
  const double elastic = inside > 0.0 || along < 0.0 ? -along + std::sqrt(std::max(0.0, along * along + inside)) : 0.0;
  const Tensor at_yield = s + elastic * e;
  const double r = at_yield.norm();
  if (elastic >= length || r == 0.0) return {trial / q_end, q_end};
  const double u = (length - elastic) / r, c = (along + elastic) / r;
  const double E = std::exp(-u);   // cosh u and sinh u times E do not overflow
  const double cosh_u = 0.5 * (1.0 + E * E), sinh_u = 0.5 * (1.0 - E * E), d = cosh_u + c * sinh_u;
  return {(E / r * at_yield + (sinh_u + c * (cosh_u - E)) * e) / (root * d), root * r * (1.0 + u + std::log(d))};
}

}  // namespace furrow
