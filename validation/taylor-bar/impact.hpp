// An impact: a rod of a material flies against a rigid, frictionless wall and comes to rest.
#pragma once

#include <optional>

#include "harness/case.hpp"
#include "harness/dynamic_run.hpp"
#include "harness/material_file.hpp"
#include "validation/taylor-bar/rod.hpp"

namespace furrow::taylor_bar_cases {

struct Impact {
  Rod rod;
  double speed = 0.0;                  ///< m/s
  std::optional<double> temperature;   ///< of the rod before impact, K; empty: the law's reference temperature
  AnyMaterial material;
  Scheme scheme;
  Arrangement arrangement = Arrangement::rings;
  bool whole = false;                  ///< without symmetry planes along the axis
};

/// What is left of the rod, and how it came about.
struct Outcome {
  RodShape shape;                                       ///< at rest
  double length = 0.0, foot_radius = 0.0;            ///< means over the last transit
  std::vector<double> time, foot_radius_at, length_at;   ///< history
  double rest_time = 0.0;                            ///< s
  double greatest_plastic_strain = 0.0, highest_temperature = 0.0, energy_imbalance = 0.0, viscous_share = 0.0;
  double strained_share = 0.0;                       ///< volume strained by more than 1
  double failed_share = 0.0;                         ///< particles that have lost their strength
};

/// Runs until the rod is at rest: over the last transit, 3 L/c_L, plastic work has grown by less than a thousandth of the kinetic
/// energy before impact. Throws std::runtime_error when it does not come to rest.
Outcome collide(Run& run, const Impact& impact);

}  // namespace furrow::taylor_bar_cases
