// The problems of the family.
#pragma once

#include "harness/case.hpp"

namespace furrow::tillage_cases {

Problem rigid_blade(const Parameters& input);     ///< a rigid blade at one speed
Problem speed_law(const Parameters& input);       ///< the same at several speeds: F = F_0 + F_2 v^2
Problem elastic_tool(const Parameters& input);    ///< a tool that stays elastic, against beam theory
Problem breaking_tool(const Parameters& input);   ///< a tool that yields and breaks
Problem interface_patch(const Parameters& input); ///< what sums over soil and tool alike do to the tool's skin
Problem multi_rate(const Parameters& input);      ///< sub-steps of the tool against one step for both

}  // namespace furrow::tillage_cases
