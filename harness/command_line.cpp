#include "harness/command_line.hpp"

namespace furrow {

int command_line(const std::vector<Family>& families, int, char**) { return families.empty() ? 0 : 2; }

}  // namespace furrow
