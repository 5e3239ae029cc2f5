// The problems of the family: small bodies, seconds at most, whose answers are conservation laws or definitions.
#pragma once

#include "verification/elastodynamics/problems.hpp"

namespace furrow::loads_cases {

Problem step_length(const Parameters& input);
Problem pushed_block(const Parameters& input);
Problem sliding_block(const Parameters& input);
Problem struck_block(const Parameters& input);
Problem held_block(const Parameters& input);

using elastodynamic_cases::block;
using elastodynamic_cases::elastic_body;
using elastodynamic_cases::measure_energy;
using elastodynamic_cases::read_elastic;

}  // namespace furrow::loads_cases
