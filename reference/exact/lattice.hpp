// Discrete sums of a kernel over explicit points: perfect lattices, and any block of points by the double loop over all pairs.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "reference/exact/kernels.hpp"

namespace furrow::exact {

using Point = std::array<double, 3>;   ///< unused components are zero
using Matrix = std::array<Point, 3>;   ///< rows

/// Points of an infinite lattice within `radius` of the one at the origin, spacing 1, and the volume that each stands for.
struct Lattice {
  std::vector<Point> points;
  double volume = 1.0;
};
/// "line" (1D), "square" and "hexagonal" (2D), "cubic" and "fcc" (3D; 1 is the nearest-neighbour distance in hexagonal and fcc).
Lattice lattice(std::string_view name, double radius);

/// What a perfect lattice makes of one and of a linear field: sum V W, and -sum V x dW/dx, the gradient it gives to the field x.
struct LatticeNorms {
  double unity = 0.0, gradient = 0.0;
};
LatticeNorms lattice_norms(std::string_view lattice, const Kernel& kernel, double h_over_dx);

/// Numerical over exact speed of a plane longitudinal wave along x under the standard symmetric form without background stress:
/// c/c0 = |sum V dW/dx sin(k x)|/k for wavelength/dx. Both the divergence of stress and the velocity gradient carry this factor.
double lattice_wave_speed(std::string_view lattice, const Kernel& kernel, double h_over_dx, double wavelength_over_dx);

/// Sums over all pairs, of every point i: sum V_j W_ij, sum V_j grad_i W_ij, and sum V_j (x_j - x_i) (x) grad_i W_ij (row: the
/// component of x). Lengths in m. Where a period is positive the box repeats and the nearest image counts; the support must then
/// fit twice into the period (std::invalid_argument).
struct PairSums {
  std::vector<double> unity;
  std::vector<Point> gradient;
  std::vector<Matrix> first;
};
PairSums pair_sums(const std::vector<Point>& x, const std::vector<double>& volume, const Kernel& kernel, double h,
                   const Point& period);

}  // namespace furrow::exact
