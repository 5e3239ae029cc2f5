#include "verification/families.hpp"
#include "verification/kernel/problems.hpp"

namespace furrow {

Family kernel_family() {
  Family family("kernel", "verification/kernel",
                "Smoothing kernels: what theory promises of the function, and what is left of it when summed over particles.");
  family.add("continuous", kernel_cases::continuous);
  family.add("discrete", kernel_cases::discrete);
  return family;
}

}  // namespace furrow
