// Ladders: how a number behaves while the spacing falls at fixed h/dx. An order is never given without the state of its ladder.
//
// SPH has two resolutions, h and dx/h. At fixed h/dx the error falls as h^2 and then stands still, because the quadrature error
// of the particle sums depends on dx/h alone (Quinlan, Basa & Lastiwka 2006); so each h/dx has a ladder of its own.
#pragma once

#include <limits>
#include <string_view>
#include <vector>

namespace furrow {

/// Local order: log(e_i/e_(i+1)) / log(dx_i/dx_(i+1)) between neighbouring rungs. States of a ladder of errors, the first that
/// holds:
///   undetermined  fewer than three rungs, a number that is not finite, or a rung other than the finest at round-off
///   round-off     the finest error is at or below the round-off floor
///   plateau       every local order is below 0.25 in magnitude; or local orders of at least half the largest one (which is
///                 0.25 or more) are followed, up to the finest rung, by local orders below half of it in magnitude
///   diverging     the fitted order is below -0.1 and so is the local order at the finest rung
///   oscillatory   local orders of both signs
///   asymptotic    every local order lies within 0.2 of the fitted one, and that is at least 0.5
///   undetermined  none of these: the order still changes
/// States of a ladder of values that tend to a limit (differences d_i = f_(i+1) - f_i, fit f = f0 + C dx^p):
///   undetermined  fewer than three rungs, or a number that is not finite
///   round-off     the finest difference is at or below the round-off floor
///   oscillatory   differences of both signs
///   diverging     p <= 0
///   asymptotic    0.5 <= p <= 4 and the standard deviation of the fit is at most 5 % of the ladder's range
///   undetermined  none of these
enum class LadderState { asymptotic, plateau, oscillatory, diverging, round_off, undetermined };
std::string_view name(LadderState state);

enum class LadderKind { error, value };   ///< converges to zero, or to a limit
std::string_view name(LadderKind kind);

struct Ladder {
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();

  LadderKind kind = LadderKind::error;
  double smoothing_ratio = 0.0;         ///< h/dx, the same on every rung
  std::vector<double> spacing;          ///< m, coarse to fine
  std::vector<double> value;            ///< magnitudes of errors, or values
  double order = none;                  ///< observed order; on a plateau that of the falling part
  double order_stderr = none;   ///< its standard error; none when the fit is exact (two or three unknowns from as many rungs)
  LadderState state = LadderState::undetermined;
  double gci = none;                    ///< grid convergence index: numerical uncertainty of the finest value, relative to it
  double extrapolated = none;           ///< f0
};

/// Observed order of errors by least squares of log(error) over log(dx). `round_off` is the error that round-off alone may cause.
Ladder error_ladder(std::vector<double> spacing, std::vector<double> error, double round_off);

/// Limit, observed order and GCI of values by least squares of f = f0 + C dx^p (Roache 1998; Eca & Hoekstra, J. Comput. Phys. 262
/// (2014) 104-130, Eqs 6 to 8 and 17 to 19, without weights). The safety factor is 1.25 where the ladder is asymptotic with
/// 0.5 <= p <= 2.1, else 3; where there is no usable fit the error estimate is the range of the values.
Ladder value_ladder(std::vector<double> spacing, std::vector<double> value, double round_off);

}  // namespace furrow
