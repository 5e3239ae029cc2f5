// Which numerical knob the heap hangs on: the rods of Bui et al. again, one choice of the scheme changed at a time.
#include <fmt/format.h>

#include "validation/column-collapse/problems.hpp"

namespace furrow::column_collapse_cases {
namespace {

struct Variant {
  std::string knob, setting;
  Scheme scheme;
  double smoothing_ratio = 0.0;   ///< 0: that of the run
};

/// The scheme with one thing changed, for each thing and setting.
std::vector<Variant> variants_of(const Scheme& base, const std::vector<double>& alphas, const std::vector<double>& ratios) {
  std::vector<Variant> all;
  const auto add = [&](std::string knob, std::string setting, auto&& change) {
    Variant v{std::move(knob), std::move(setting), base};
    change(v);
    all.push_back(std::move(v));
  };
  for (const double alpha : alphas)
    add("viscosity alpha", fmt::format("{:g}", alpha), [=](Variant& v) {
      v.scheme.viscosity = ArtificialViscosity{alpha, v.scheme.viscosity ? v.scheme.viscosity->beta : 0.0};
    });
  for (const double ratio : ratios) add("h/dx", fmt::format("{:g}", ratio), [=](Variant& v) { v.smoothing_ratio = ratio; });
  add("artificial stress", "off", [](Variant& v) { v.scheme.artificial_stress.reset(); });
  add("artificial stress", "0.3, n = 4", [](Variant& v) { v.scheme.artificial_stress = ArtificialStress{0.3, 4.0}; });
  add("density", "constant", [](Variant& v) { v.scheme.density = DensityEquation::constant; });
  add("density", "continuity", [](Variant& v) { v.scheme.density = DensityEquation::continuity; });
  add("correction", "none", [](Variant& v) { v.scheme.correction = Correction::none; });
  add("correction", "linear", [](Variant& v) { v.scheme.correction = Correction::linear; });
  return all;
}

}  // namespace

Problem sensitivity(const Parameters& input) {
  const SoilColumn column = read_soil_column(input);
  const ReferenceSurfaces reference = read_reference_surfaces(input);
  const std::vector<Variant> variants =
      variants_of(column.scheme, input.numbers("alphas", range::not_negative), input.numbers("ratios", {1.0, 3.0}));
  return [=](Run& run) {
    const Surface limit = extrapolated(reference.fine, reference.coarse, 0.01);
    Table& table = run.table("knobs", "One choice changed at a time",
                             {{"choice"}, {"setting"}, {"x(50 mm)", "mm"}, {"x(30 mm)", "mm"}, {"x(10 mm)", "mm"}, {"toe", "mm"},
                              {"rest", "s"}, {"surface error", "1"}, {"energy balance", "1"}});
    Figure& figure = run.figure({.name = "surfaces", .title = "Surfaces at rest", .x = {"x", "m"}, .y = {"height", "m"}});
    figure.add({.label = "independent", .role = "reference", .x = limit.x, .y = limit.h});
    double least = 1e30, most = 0.0, nearest = 1e30;
    for (std::size_t k = 0; k < variants.size(); ++k) {
      const Variant& v = variants[k];
      SoilColumn changed = column;
      changed.scheme = v.scheme;
      Resolution resolution = run.resolution();
      if (v.smoothing_ratio > 0.0) resolution.smoothing_ratio = v.smoothing_ratio;
      Run part(resolution, run.folder() / fmt::format("variant-{:02d}", k), run.threads());
      try {
        const Collapsed heap = collapse(part, changed, reference_window);
        const double error = distance(heap.surface, limit, position_at(limit, 0.01)) / column.height;
        const double x = position_at(heap.surface, 0.03);
        least = std::min(least, x);
        most = std::max(most, x);
        nearest = std::min(nearest, error);
        table.row({v.knob, v.setting, 1e3 * position_at(heap.surface, 0.05), 1e3 * x, 1e3 * position_at(heap.surface, 0.01),
                   1e3 * farthest_at(heap.surface, 0.002), heap.rest_time, error, heap.energy_imbalance});
        figure.add({.label = v.knob + " " + v.setting, .x = heap.surface.x, .y = heap.surface.h});
      } catch (const Divergence& divergence) {
        table.row({v.knob, v.setting + ": " + divergence.what(), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
      }
      run.count(part.steps(), part.particles());
      run.progress(static_cast<double>(k + 1), static_cast<double>(variants.size()), part.steps());
    }
    run.measure("spread_of_position_30", (most - least) / position_at(limit, 0.03));
    run.measure("least_surface_error", nearest);
  };
}

}  // namespace furrow::column_collapse_cases
