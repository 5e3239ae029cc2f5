#include "verification/families.hpp"
#include "verification/operators/problems.hpp"

namespace furrow {

Family operators_family() {
  Family family("operators", "verification/operators",
                "The solver's sums over neighbours on given particles, nothing moves: what they make of waves, fields, rotations and "
                "stresses, and what they conserve.");
  family.add("plane_waves", operator_cases::plane_waves);
  family.add("tabulated_wave_speeds", operator_cases::tabulated_wave_speeds);
  family.add("smooth_field", operator_cases::smooth_field);
  family.add("disordered_field", operator_cases::disordered_field);
  family.add("rigid_and_shear", operator_cases::rigid_and_shear);
  family.add("conservation", operator_cases::conservation);
  family.add("compressed_block", operator_cases::compressed_block);
  family.add("stress_power", operator_cases::stress_power);
  family.add("deformed_block", operator_cases::deformed_block);
  family.add("stressed_layers", operator_cases::stressed_layers);
  family.add("uneven_norms", operator_cases::uneven_norms);
  return family;
}

}  // namespace furrow
