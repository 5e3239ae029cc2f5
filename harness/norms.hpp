// Norms of a field over particles, weighted by volume, so that a norm does not change when particles are split or crowded.
#pragma once

#include <span>

namespace furrow {

struct FieldNorms {
  double l1 = 0.0;     ///< sum V |e| / sum V
  double l2 = 0.0;     ///< sqrt(sum V e^2 / sum V)
  double linf = 0.0;   ///< max |e|
};

/// Norms of a field, in the field's unit. `volume` holds one weight a particle (m^Dim); of a vector or tensor field the
/// magnitudes are given. NaN where an entry is not finite; std::invalid_argument when the lengths differ, nothing is given or
/// the volumes do not sum to a positive number.
FieldNorms norms(std::span<const double> field, std::span<const double> volume);

/// Norms of computed - exact, in the field's unit.
FieldNorms error_norms(std::span<const double> computed, std::span<const double> exact, std::span<const double> volume);

/// Norms of computed - exact, each divided by the same norm of exact; NaN where exact vanishes.
FieldNorms relative_error_norms(std::span<const double> computed, std::span<const double> exact, std::span<const double> volume);

}  // namespace furrow
