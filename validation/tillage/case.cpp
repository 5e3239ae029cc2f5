#include "validation/families.hpp"
#include "validation/tillage/problems.hpp"

namespace furrow {

Family tillage_family() {
  Family family("tillage", "validation/tillage", "A blade cuts soil: rigid, and of metal that bends, yields and breaks.");
  family.add("rigid_blade", tillage_cases::rigid_blade);
  family.add("speed_law", tillage_cases::speed_law);
  family.add("elastic_tool", tillage_cases::elastic_tool);
  family.add("breaking_tool", tillage_cases::breaking_tool);
  family.add("interface_patch", tillage_cases::interface_patch);
  family.add("multi_rate", tillage_cases::multi_rate);
  return family;
}

}  // namespace furrow
