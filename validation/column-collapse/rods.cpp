// Rods of Bui et al. 2008, IJNAMG 32:1537, and of Nguyen et al. 2017, Landslides 14:69: a heap of rods, which is plane by nature,
// is released at one side.
#include <cmath>

#include "harness/reference_data.hpp"
#include "validation/column-collapse/problems.hpp"

namespace furrow::column_collapse_cases {
namespace {

/// The surface of one of the reference's grids.
Surface grid_of(const ReferenceData& data, double cell, double low_dissipation) {
  Surface s;
  for (std::size_t k = 0; k < data.rows(); ++k)
    if (std::abs(data.column("cell")[k] - cell) < 1e-9 && data.column("low dissipation")[k] == low_dissipation) {
      s.x.push_back(data.column("x")[k]);
      s.h.push_back(data.column("height")[k]);
    }
  return s;
}

}  // namespace

ReferenceSurfaces read_reference_surfaces(const Parameters& input) {
  const ReferenceData data = read_reference_data(input.text("reference"));
  return {grid_of(data, 0.00125, 0.0), grid_of(data, 0.0025, 0.0), grid_of(data, 0.0025, 1.0)};
}

Problem rods(const Parameters& input) {
  const SoilColumn column = read_soil_column(input);
  const ReferenceSurfaces reference = read_reference_surfaces(input);
  return [=](Run& run) {
    const Collapsed heap = collapse(run, column, reference_window);

    // Reference: extrapolated from its two finest grids with the first order that it shows.
    const Surface& fine = reference.fine;
    const Surface limit = extrapolated(fine, reference.coarse, 0.01);
    surface_figure(run, heap.surface, {{"independent, extrapolated", limit}, {"independent, low dissipation", reference.lively}});
    for (const auto& [metric, height, uncertainty] : {std::tuple{"position_50", 0.05, 0.02}, {"position_30", 0.03, 0.02}, {"position_10", 0.01, 0.026}}) {
      const double x = position_at(limit, height);
      run.measure(metric, position_at(heap.surface, height), "m", {x, uncertainty * x});
    }
    run.measure("toe", farthest_at(heap.surface, 0.002), "m", {farthest_at(fine, 0.002), 0.05 * farthest_at(fine, 0.002)});
    run.measure("surface_error", distance(heap.surface, limit, position_at(limit, 0.01)) / column.height);
    run.measure("wall_height", heap.surface.h.front(), "m");
    run.measure("rest_time", heap.rest_time, "s");
    run.measure("late_motion", heap.late_motion);
    run.measure("volume_change", heap.volume_change);
    run.measure("energy_imbalance", heap.energy_imbalance);
  };
}

}  // namespace furrow::column_collapse_cases
