// The problems of the family.
#pragma once

#include "harness/case.hpp"

namespace furrow::taylor_bar_cases {

Problem benchmark(const Parameters& input);       ///< a rod whose converged shape other codes give
Problem whole_rod_too(const Parameters& input);   ///< a quarter of a rod against the whole of it
Problem sub_steps(const Parameters& input);       ///< short steps of squeezed particles against one step for all
Problem printed_forms(const Parameters& input);   ///< one rod by each of the paper's printed equations
Problem shot(const Parameters& input);            ///< a shot of a laboratory's table
Problem shot_series(const Parameters& input);     ///< every shot of some tables

}  // namespace furrow::taylor_bar_cases
