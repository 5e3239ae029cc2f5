#include "verification/families.hpp"
#include "verification/loads/problems.hpp"

namespace furrow {

Family loads_family() {
  Family family("loads", "verification/loads",
                "What acts on a body from outside, and how long its steps are: momentum, work and friction of small bodies, by "
                "conservation laws and definitions.");
  family.add("step_length", loads_cases::step_length);
  family.add("pushed_block", loads_cases::pushed_block);
  family.add("sliding_block", loads_cases::sliding_block);
  family.add("struck_block", loads_cases::struck_block);
  family.add("held_block", loads_cases::held_block);
  return family;
}

}  // namespace furrow
