#include "verification/elastic-plastic/problems.hpp"
#include "verification/families.hpp"

namespace furrow {

Family elastic_plastic_family() {
  Family family("elastic-plastic", "verification/elastic-plastic",
                "Bodies that yield, where the answer is a closed form: waves, rings that stop, a strip that folds.");
  family.add("piston", elastic_plastic_cases::piston);
  family.add("collapsing_cylinder", elastic_plastic_cases::collapsing_cylinder);
  family.add("expanding_ring", elastic_plastic_cases::expanding_ring);
  family.add("plastic_hinge", elastic_plastic_cases::plastic_hinge);
  return family;
}

}  // namespace furrow
