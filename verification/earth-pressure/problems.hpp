// The problems of the family.
#pragma once

#include "harness/case.hpp"
#include "harness/dynamic_run.hpp"
#include "harness/scheme_input.hpp"
#include "harness/soil_box.hpp"

namespace furrow::earth_pressure_cases {

Problem static_column(const Parameters& input);   ///< a column that settles under its weight and stays
Problem moving_wall(const Parameters& input);     ///< Rankine: a smooth wall that yields or is pushed in
Problem strip_load(const Parameters& input);      ///< Prandtl: a rough strip on clay without friction
Problem vertical_cut(const Parameters& input);    ///< the cohesion with which a vertical cut just stands

/// A body of this soil and scheme at the run's resolution under gravity, without particles.
Body<2> soil_body(const Run& run, const DruckerPrager& law, const Scheme& scheme, double gravity);

/// The modules that every problem of the family puts to work.
void exercise_soil(Run& run, const Scheme& scheme);

/// A figure of columns of the history over time or over another column.
void history_figure(Run& run, const DynamicRun<2>& dynamic, std::string_view name, std::string_view title,
                    const std::vector<std::string>& columns, const Column& y);

}  // namespace furrow::earth_pressure_cases
