// A column of cohesive soil, 4 x 2 m (Bui et al. 2008), a little higher than a vertical cut can stand: it slumps along a circle.
#include "validation/column-collapse/problems.hpp"

namespace furrow::column_collapse_cases {

Problem cohesive_column(const Parameters& input) {
  const SoilColumn column = read_soil_column(input);
  return [=](Run& run) {
    const Collapsed heap = collapse(run, column, 0.05 * column.height);
    run.measure("crest_settlement", heap.crest_settlement, "m");
    run.measure("run_out", heap.front - column.width, "m");
    run.measure("greatest_speed", heap.greatest_speed, "m/s");
    run.measure("time_of_greatest_speed", heap.time_of_greatest_speed, "s");
    run.measure("rest_time", heap.rest_time, "s");
    run.measure("late_motion", heap.late_motion);
    run.measure("volume_change", heap.volume_change);
    run.measure("energy_imbalance", heap.energy_imbalance);
    surface_figure(run, heap.surface, {});
  };
}

}  // namespace furrow::column_collapse_cases
