// The problems of the family.
#pragma once

#include "harness/case.hpp"

namespace furrow::taylor_bar_cases {

Problem benchmark(const Parameters& input);

}  // namespace furrow::taylor_bar_cases
