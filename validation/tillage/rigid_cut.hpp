// A cut with a rigid blade, as run and as measured.
#pragma once

#include "validation/tillage/bed.hpp"

namespace furrow::tillage_cases {

/// Forces of the soil on the blade per width, over its travel, in means over `bin`.
struct CutHistory {
  std::vector<double> travel, draft, vertical;   ///< m, N/m (against the motion; up)
};

struct CutResult {
  CutHistory history;
  double draft, vertical;     ///< means over the window of travel, N/m
  double scatter;             ///< standard deviation of the draft in the window over its mean
  double peak, peak_travel;   ///< of the draft, N/m and m
  double chip_direction;      ///< of the soil that the blade carries along at the end, above the horizontal ahead, rad
  double penetration;         ///< largest, in spacings
  double energy_imbalance;
};

/// Runs the cut and measures over travel from `window_start` to its end; history and snapshots go to the run's folder.
CutResult cut(Run& run, const Bed& bed, const Blade& blade, const ContactLaw& contact, double window_start, bool pictures);

/// The independent means (reference/data/blade-mpm) over travel from `from` to `to`, of the finest grid there is for this speed,
/// smooth or with Coulomb's friction.
struct IndependentCut {
  CutHistory history;
  double draft, vertical, cell;
};
std::optional<IndependentCut> independent_cut(double speed, bool friction, double from, double to);

}  // namespace furrow::tillage_cases
