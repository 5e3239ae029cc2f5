// The problems of the family, and the collapse that they share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/case.hpp"
#include "harness/dynamic_run.hpp"
#include "harness/scheme_input.hpp"
#include "harness/soil_box.hpp"
#include "validation/column-collapse/surface.hpp"

namespace furrow::column_collapse_cases {

Problem sensitivity(const Parameters& input);       ///< the same, one numerical choice changed at a time
Problem rods(const Parameters& input);              ///< rods of Bui and of Nguyen against the independent surface
Problem granular_column(const Parameters& input);   ///< run-out against the laws of Lube and of Lajeunesse
Problem cohesive_column(const Parameters& input);   ///< a column of clay that slumps

/// A column at a smooth wall x = 0 on a floor y = 0, whose right face is released.
struct SoilColumn {
  Soil soil;
  RestingRatio resting;
  double left, bottom;                  ///< m: its lower left corner, (0, 0) where it leans on the wall and stands on the floor
  double width, height, floor_length;   ///< m
  Slip floor;
  double gate_speed;                    ///< m/s, upwards; 0: there is no gate from the start on
  double gravity, end_time, courant;
  double rest_speed;                    ///< m/s: what is slower is at rest
  double rest_held;                     ///< s: the run ends when the heap has been at rest for so long
  Scheme scheme;
};
SoilColumn read_soil_column(const Parameters& input);

/// What a collapse leaves behind.
struct Collapsed {
  Surface surface;                  ///< at the end
  double rest_time;                 ///< s, from which on less than 1 % of the mass moves faster than the speed of rest
  double greatest_speed, time_of_greatest_speed;   ///< of all but a thousandth of the mass
  double crest_settlement;          ///< m, of the upper particle at the face
  double front;                     ///< m, farthest particle with at least four neighbours of soil within two spacings
  double late_motion;               ///< way of the centre of mass over the last two thirds of `rest_held`, over the initial height
  double volume_change;             ///< of the sum of m/rho, relative
  double energy_imbalance;
};

/// Runs the collapse, with its figures and the modules it puts to work.
Collapsed collapse(Run& run, const SoilColumn& column, double window);

/// The independent surface (reference/data) on its two finest grids, and with low dissipation.
struct ReferenceSurfaces {
  Surface fine, coarse, lively;
};
inline constexpr double reference_window = 0.01;   ///< m: its windows
ReferenceSurfaces read_reference_surfaces(const Parameters& input);

/// Adds a figure of surfaces.
void surface_figure(Run& run, const Surface& computed, const std::vector<std::pair<std::string, Surface>>& references);

}  // namespace furrow::column_collapse_cases
