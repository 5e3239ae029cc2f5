// The problems of the family.
#pragma once

#include "harness/case.hpp"
#include "solver/materials/materials.hpp"

namespace furrow::elastic_plastic_cases {

Problem piston(const Parameters& input);
Problem collapsing_cylinder(const Parameters& input);
Problem expanding_ring(const Parameters& input);
Problem plastic_hinge(const Parameters& input);

}  // namespace furrow::elastic_plastic_cases
