// The problems of the family `material-point`.
#pragma once

#include "harness/case.hpp"

namespace furrow::material_point_cases {

Problem metal_path(const Parameters& input);       ///< strength, heating, unloading and reversal against the rate equations
Problem adiabatic_flow(const Parameters& input);   ///< Johnson-Cook at constant rate against its closed form
Problem hugoniot(const Parameters& input);         ///< equation of state: shocks, tension, sound, a closed cycle
Problem linear_pressure(const Parameters& input);  ///< the linear equation of state: sound, energy
Problem single_step(const Parameters& input);      ///< hardening: the return of one step of any size
Problem fracture(const Parameters& input);         ///< damage at constant and at changing triaxiality
Problem simple_shear(const Parameters& input);     ///< metal or soil in simple shear against the Jaumann closed form
Problem rotation(const Parameters& input);         ///< a stressed point that spins; a path seen from a turned frame
Problem soil_strength(const Parameters& input);    ///< Drucker-Prager: strength, dilation, apex
Problem soil_path(const Parameters& input);       ///< Drucker-Prager: paths with unloading and turning against the rate equations
Problem printed_forms(const Parameters& input);   ///< what each of the paper's printed equations does to a point

}  // namespace furrow::material_point_cases
