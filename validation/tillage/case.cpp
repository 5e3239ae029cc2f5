#include "validation/families.hpp"
#include "validation/tillage/problems.hpp"

namespace furrow {

Family tillage_family() {
  Family family("tillage", "validation/tillage", "A blade cuts soil: rigid, and of metal that bends, yields and breaks.");
  family.add("rigid_blade", tillage_cases::rigid_blade);
  family.add("speed_law", tillage_cases::speed_law);
  return family;
}

}  // namespace furrow
