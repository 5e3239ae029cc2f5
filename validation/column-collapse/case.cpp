#include "validation/column-collapse/problems.hpp"
#include "validation/families.hpp"

namespace furrow {

Family column_collapse_family() {
  Family family("column-collapse", "validation/column-collapse",
                "Columns of soil that are released: rods, sand and clay, from a state at rest to a heap at rest.");
  family.add("rods", column_collapse_cases::rods);
  family.add("sensitivity", column_collapse_cases::sensitivity);
  family.add("granular_column", column_collapse_cases::granular_column);
  family.add("cohesive_column", column_collapse_cases::cohesive_column);
  return family;
}

}  // namespace furrow
