// The program behind ./furrow: every family by name, then the command line.
#include "harness/command_line.hpp"
#include "validation/families.hpp"
#include "verification/families.hpp"

int main(int argc, char** argv) {
  const std::vector<furrow::Family> families = {
      furrow::kernel_family(),
      furrow::operators_family(),
      furrow::material_point_family(),
      furrow::loads_family(),
      furrow::elastodynamics_family(),
      furrow::elastic_plastic_family(),
      furrow::earth_pressure_family(),
      furrow::taylor_bar_family(),
      furrow::column_collapse_family(),
      furrow::tillage_family(),
  };
  return furrow::command_line(families, argc, argv);
}
