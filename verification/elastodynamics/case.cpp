#include "verification/elastodynamics/problems.hpp"
#include "verification/families.hpp"

#include <fmt/format.h>

namespace furrow {

Family elastodynamics_family() {
  Family family("elastodynamics", "verification/elastodynamics",
                "Elastic bodies that move: waves, impact, bending, rotation. Time integration, boundaries and energy against closed "
                "forms, before anything may yield.");
  family.add("oscillating_plate", elastodynamic_cases::oscillating_plate);
  family.add("cantilever", elastodynamic_cases::cantilever);
  family.add("cantilever_ladder", elastodynamic_cases::cantilever_ladder);
  family.add("longitudinal_wave", elastodynamic_cases::longitudinal_wave);
  family.add("bar_on_wall", elastodynamic_cases::bar_on_wall);
  family.add("spinning_square", elastodynamic_cases::spinning_square);
  family.add("order_in_time", elastodynamic_cases::order_in_time);
  family.add("rubber_rings", elastodynamic_cases::rubber_rings);
  family.add("simple_shear", elastodynamic_cases::simple_shear);
  family.add("passing_rows", elastodynamic_cases::passing_rows);
  family.add("parted_strip", elastodynamic_cases::parted_strip);
  family.add("gravity_column", elastodynamic_cases::gravity_column);
  return family;
}

namespace elastodynamic_cases {

LinearElastic read_elastic(const Parameters& input) {
  return LinearElastic::from_young(input.quantity("density", dimension::density, range::positive),
                                   input.quantity("young_modulus", dimension::stress, range::positive),
                                   input.number("poisson_ratio", {-1.0, 0.5, true, true}));
}

Scheme read_scheme_without_correction(const Parameters& input, std::string_view chosen_by) {
  const Parameters scheme = input.table_or_empty("scheme");
  if (scheme.has("correction"))
    scheme.fail("correction", fmt::format("found a correction here, expected none, for parameters.{} chooses it", chosen_by));
  return read_scheme(input);
}

StepControl read_control(const Parameters& input, double courant) {
  StepControl control;
  control.courant = input.number_or("courant", courant, range::positive);
  return control;
}

std::vector<Vector<2>> block(int columns, int rows, double dx, const Vector<2>& corner) {
  std::vector<Vector<2>> centres;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) centres.push_back(corner + dx * Vector<2>(i + 0.5, j + 0.5));
  return centres;
}

int cells(double length, double dx, std::string_view what) {
  const double count = length / dx;
  if (std::abs(count - std::round(count)) > 1e-6 || count < 0.5)
    throw std::invalid_argument(fmt::format("{} of {:.6g} m is not a whole number of spacings of {:.6g} m", what, length, dx));
  return static_cast<int>(std::lround(count));
}

Body<2> elastic_body(const Run& run, const LinearElastic& material, const Scheme& scheme) {
  Body<2> body;
  body.material = material;
  body.scheme = scheme;
  body.scheme.smoothing_ratio = run.resolution().smoothing_ratio;
  body.spacing = run.resolution().spacing;
  return body;
}

void measure_energy(Run& run, const DynamicRun<2>& dynamic) {
  run.measure("energy_imbalance", dynamic.energy_imbalance());
  energy_figure(run, dynamic);
}

void energy_figure(Run& run, const DynamicRun<2>& dynamic) {
  history_figure(run, dynamic, "energies", "Where the energy is",
                 {"kinetic_energy", "elastic_energy", "plastic_work", "wall_energy", "layer_work", "viscous_dissipation",
                  "artificial_stress_work", "friction", "damping_dissipation", "external_work"},
                 {"energy per width", "J/m"});
}

void history_figure(Run& run, const DynamicRun<2>& dynamic, std::string_view name, std::string_view title,
                    const std::vector<std::string>& columns, const Column& y) {
  Figure figure;
  figure.name = name;
  figure.title = title;
  figure.x = {"t", "s"};
  figure.y = y;
  for (const std::string& column : columns) {
    const auto& values = dynamic.column(column);
    const bool zero = std::all_of(values.begin(), values.end(), [](double v) { return v == 0.0; });
    if (zero && columns.size() > 1) continue;
    Series series;
    series.label = column;
    std::replace(series.label.begin(), series.label.end(), '_', ' ');
    series.x = dynamic.column("time");
    series.y = values;
    figure.add(std::move(series));
  }
  run.figure(std::move(figure));
}

}  // namespace elastodynamic_cases
}  // namespace furrow
