#include "verification/families.hpp"
#include "verification/material-point/problems.hpp"

namespace furrow {

Family material_point_family() {
  using namespace material_point_cases;
  Family family("material-point", "verification/material-point",
                "One point of material driven along a prescribed path: the laws alone, without particles.");
  family.add("metal_path", metal_path);
  family.add("adiabatic_flow", adiabatic_flow);
  family.add("hugoniot", hugoniot);
  family.add("linear_pressure", linear_pressure);
  family.add("single_step", single_step);
  family.add("fracture", fracture);
  family.add("simple_shear", simple_shear);
  family.add("rotation", rotation);
  family.add("soil_strength", soil_strength);
  family.add("soil_path", soil_path);
  family.add("printed_forms", printed_forms);
  return family;
}

}  // namespace furrow
