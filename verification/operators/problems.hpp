// The problems of the family `operators`.
#pragma once

#include "harness/case.hpp"

namespace furrow::operator_cases {

Problem plane_waves(const Parameters& input);            ///< every sum on a plane wave on a lattice, against lattice sums
Problem tabulated_wave_speeds(const Parameters& input);  ///< the wave speed against a printed table
Problem smooth_field(const Parameters& input);           ///< interpolation and gradient of a manufactured field, with their orders
Problem disordered_field(const Parameters& input);       ///< the same on jittered particles
Problem rigid_and_shear(const Parameters& input);        ///< strain rate and spin of a rotating and of a sheared block
Problem conservation(const Parameters& input);           ///< momentum, angular momentum and power of random particles
Problem compressed_block(const Parameters& input);       ///< three ways to a density, and the one that misses
Problem stress_power(const Parameters& input);           ///< the energy that a uniform deformation does
Problem deformed_block(const Parameters& input);         ///< the undeformed body's sums, and what holds zigzags, on random particles
Problem uneven_norms(const Parameters& input);           ///< the norms of a known field on cells of two sizes
Problem stressed_layers(const Parameters& input);        ///< what boundary layers carry beside evenly stressed soil

}  // namespace furrow::operator_cases
