// Surface of a heap: height as volume per width, and what is read from it.
#pragma once

#include <vector>

namespace furrow::column_collapse_cases {

/// Heights h at places x, m.
struct Surface {
  std::vector<double> x, h;
};

/// Height at 0, step, 2 step, ... as volume per width in windows of width `step` about these places; the first window is cut at
/// the wall x = 0. Each particle is a strip of width `spacing` about its centre with the volume `volume` (m^2 in plane strain).
Surface surface_of(const std::vector<double>& centres, double volume, double spacing, double step);

/// Where the surface of the heap at the wall first falls through `height`, linear between places: what has run ahead and lies
/// apart is no part of the heap. 0 where it is lower everywhere; the last place where it is not yet lower there.
double position_at(const Surface& surface, double height);

/// The farthest place where anything lies as high as `height`, as above.
double farthest_at(const Surface& surface, double height);

/// Height at x, linear between places, 0 beyond the last.
double height_at(const Surface& surface, double x);

/// Root of the mean square of the difference of heights over 0 <= x <= end, m, at the places of `surface`.
double distance(const Surface& surface, const Surface& reference, double end);

/// The surface that cells of half the size would have, were the error of the first order in the cell: at each height of the finer
/// one x = 2 x_fine - x_coarse. Both must fall monotonously from `lowest` up; heights in steps of a hundredth of the greatest.
Surface extrapolated(const Surface& fine, const Surface& coarse, double lowest);

}  // namespace furrow::column_collapse_cases
