#include "verification/earth-pressure/problems.hpp"
#include "verification/families.hpp"

namespace furrow {

Family earth_pressure_family() {
  Family family("earth-pressure", "verification/earth-pressure",
                "Soil at rest and at its limit: the stress under its own weight, earth pressure, bearing, a vertical cut.");
  family.add("static_column", earth_pressure_cases::static_column);
  family.add("moving_wall", earth_pressure_cases::moving_wall);
  family.add("strip_load", earth_pressure_cases::strip_load);
  family.add("vertical_cut", earth_pressure_cases::vertical_cut);
  return family;
}

namespace earth_pressure_cases {

Body<2> soil_body(const Run& run, const DruckerPrager& law, const Scheme& scheme, double gravity) {
  Body<2> body;
  body.name = "soil";
  body.material = law;
  body.scheme = scheme;
  body.scheme.smoothing_ratio = run.resolution().smoothing_ratio;
  body.spacing = run.resolution().spacing;
  body.loads.gravity = {0.0, -gravity};
  return body;
}

void exercise_soil(Run& run, const Scheme& scheme) {
  exercise(run, scheme);
  run.exercises("materials/drucker_prager");
  run.exercises("particles/images");
}

void history_figure(Run& run, const DynamicRun<2>& dynamic, std::string_view name, std::string_view title,
                    const std::vector<std::string>& columns, const Column& y) {
  Figure figure;
  figure.name = name;
  figure.title = title;
  figure.x = {"time", "s"};
  figure.y = y;
  for (const std::string& column : columns) figure.add({.label = column, .x = dynamic.column("time"), .y = dynamic.column(column)});
  run.figure(std::move(figure));
}

}  // namespace earth_pressure_cases

}  // namespace furrow
