// The families whose reference is mathematics, one function each, defined in the family's case.cpp.
#pragma once

#include "harness/case.hpp"

namespace furrow {

Family kernel_family();      ///< verification/kernel: smoothing kernels, continuous and discrete
Family operators_family();   ///< verification/operators: SPH sums on given particles, nothing moves
Family material_point_family();   ///< verification/material-point: one point of material along a prescribed path
Family loads_family();   ///< verification/loads: what acts from outside, and how long steps are
Family elastodynamics_family();   ///< verification/elastodynamics: elastic bodies that move
Family elastic_plastic_family();   ///< verification/elastic-plastic: bodies that yield, closed forms
Family earth_pressure_family();   ///< verification/earth-pressure: soil at rest and at its limit

}  // namespace furrow
