// Plane waves on perfect lattices: every sum over neighbours turns a plane wave into itself times a number, and that number is a
// lattice sum. And what a little disorder adds to the sums of a constant and of a linear field.
#pragma once

#include <string_view>

#include "reference/exact/lattice.hpp"

namespace furrow::exact {

/// The numbers for the wave number `k` (per lattice spacing): sum V W cos(k.x), and k.g/k^2 with g = -sum V grad W sin(k.x), by
/// which the gradient of the wave is too small where g is along k. Both tend to the kernel's Fourier transform for h >> dx.
struct PlaneWaveFactors {
  double value = 0.0, gradient = 0.0;
};
PlaneWaveFactors plane_wave_factors(std::string_view lattice, const Kernel& kernel, double h_over_dx, const Point& k);

/// Root mean square, over particles and directions, of the relative error in the sum of a constant, |sum V W - 1|, and in the
/// gradient of a linear field, when every point of a lattice of the plane has been moved along each axis by an even random part of
/// +-fraction of the spacing. To first order in the fraction: from the variance of the moves and the slope of each term, beside
/// the error of the lattice itself. Relative error of the result: of the order of (10 fraction)^2/10.
struct DisorderLevels {
  double value = 0.0, gradient = 0.0;
};
DisorderLevels disorder_levels(std::string_view lattice, const Kernel& kernel, double h_over_dx, double fraction);

}  // namespace furrow::exact
