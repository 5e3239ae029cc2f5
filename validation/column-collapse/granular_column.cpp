// Sand at several ratios of height to width, against the laws that Lube et al. 2005 (Phys. Rev. E 72:041301) and Lajeunesse et al.
// 2005 (Phys. Fluids 17:103302) found for run-out and height between two walls.
#include <cmath>

#include "validation/column-collapse/problems.hpp"

namespace furrow::column_collapse_cases {

Problem granular_column(const Parameters& input) {
  const SoilColumn column = read_soil_column(input);
  return [=](Run& run) {
    const Collapsed heap = collapse(run, column, 0.05 * column.width);
    const double a = column.height / column.width;
    const double lube = a < 1.8 ? 1.2 * a : 1.9 * std::pow(a, 2.0 / 3.0);
    const double lajeunesse = a < 3.0 ? 1.8 * a : 2.3 * std::pow(a, 2.0 / 3.0);
    const double lube_height = a < 1.15 ? a : std::pow(a, 0.4), lajeunesse_height = a < 0.7 ? a : std::cbrt(a);

    // The foot is where the heap is as high as a grain of the experiments: a hundredth of the width.
    const double run_out = position_at(heap.surface, 0.01 * column.width) / column.width - 1.0;
    run.measure("run_out", run_out, "1", {0.5 * (lube + lajeunesse), 0.25 * std::abs(lajeunesse - lube)});
    run.measure("run_out_between_laws", (run_out - lube) / (lajeunesse - lube));
    run.measure("height", heap.surface.h.front() / column.width, "1",
                {0.5 * (lube_height + lajeunesse_height), 0.25 * std::abs(lajeunesse_height - lube_height)});
    run.measure("rest_time", heap.rest_time / std::sqrt(column.height / column.gravity));
    run.measure("late_motion", heap.late_motion);
    run.measure("volume_change", heap.volume_change);
    run.measure("energy_imbalance", heap.energy_imbalance);
    surface_figure(run, heap.surface, {});
    Table& table = run.table("laws", "Run-out and height in widths", {{"law"}, {"run-out", "1"}, {"height", "1"}});
    table.row({std::string("Lube et al. 2005"), lube, lube_height});
    table.row({std::string("Lajeunesse et al. 2005"), lajeunesse, lajeunesse_height});
    table.row({std::string("computed"), run_out, heap.surface.h.front() / column.width});
  };
}

}  // namespace furrow::column_collapse_cases
