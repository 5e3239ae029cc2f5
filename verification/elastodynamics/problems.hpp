// The problems of the family, and what they share.
#pragma once

#include <cmath>
#include <vector>

#include "harness/case.hpp"
#include "harness/dynamic_run.hpp"
#include "harness/scheme_input.hpp"

namespace furrow::elastodynamic_cases {

Problem oscillating_plate(const Parameters& input);
Problem cantilever(const Parameters& input);
Problem cantilever_ladder(const Parameters& input);
Problem longitudinal_wave(const Parameters& input);
Problem bar_on_wall(const Parameters& input);
Problem spinning_square(const Parameters& input);
Problem order_in_time(const Parameters& input);
Problem rubber_rings(const Parameters& input);
Problem simple_shear(const Parameters& input);
Problem passing_rows(const Parameters& input);
Problem parted_strip(const Parameters& input);
Problem gravity_column(const Parameters& input);

/// Elastic material of a case: density, young_modulus, poisson_ratio.
LinearElastic read_elastic(const Parameters& input);

/// Centres of columns x rows cells of edge dx, the lower left corner of the block at `corner`; column by column.
std::vector<Vector<2>> block(int columns, int rows, double dx, const Vector<2>& corner);

/// How many cells of edge dx fit into `length`; an std::invalid_argument when no whole number does.
int cells(double length, double dx, std::string_view what);

/// A body of this material and scheme at the run's resolution, without particles.
Body<2> elastic_body(const Run& run, const LinearElastic& material, const Scheme& scheme);

/// Measures the energy balance, with its figure.
void measure_energy(Run& run, const DynamicRun<2>& dynamic);
/// Where the energy is over time.
void energy_figure(Run& run, const DynamicRun<2>& dynamic);

/// The scheme of a case whose correction another key chooses; an InputError where the scheme names one as well.
Scheme read_scheme_without_correction(const Parameters& input, std::string_view chosen_by);

/// How long steps are: `courant`, by default as in StepControl or as given.
StepControl read_control(const Parameters& input, double courant = StepControl{}.courant);

/// A figure of columns of the history over time.
void history_figure(Run& run, const DynamicRun<2>& dynamic, std::string_view name, std::string_view title,
                    const std::vector<std::string>& columns, const Column& y);

}  // namespace furrow::elastodynamic_cases
