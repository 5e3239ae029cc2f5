#include "validation/families.hpp"
#include "validation/taylor-bar/problems.hpp"

namespace furrow {

Family taylor_bar_family() {
  Family family("taylor-bar", "validation/taylor-bar",
                "Metal rods that hit a rigid wall: strength, heating and hardening at rates and strains that no testing machine "
                "reaches.");
  family.add("benchmark", taylor_bar_cases::benchmark);
  family.add("whole_rod_too", taylor_bar_cases::whole_rod_too);
  family.add("sub_steps", taylor_bar_cases::sub_steps);
  family.add("printed_forms", taylor_bar_cases::printed_forms);
  family.add("shot", taylor_bar_cases::shot);
  family.add("shot_series", taylor_bar_cases::shot_series);
  return family;
}

}  // namespace furrow
