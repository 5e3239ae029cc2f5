// The families whose reference is an experiment, another computation or the paper, one function each, defined in the family's
// case.cpp.
#pragma once

#include "harness/case.hpp"

namespace furrow {

Family taylor_bar_family();   ///< validation/taylor-bar: metal rods against a rigid wall
Family column_collapse_family();   ///< validation/column-collapse: columns of soil that are released
Family tillage_family();   ///< validation/tillage: a blade cuts soil

}  // namespace furrow
