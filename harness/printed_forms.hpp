// The paper's printed equations of a metal, one at a time, as changes of a material file: for the tables that set each beside the
// right form, on a point of material and on a rod.
#pragma once

#include <string>
#include <vector>

#include "harness/material_file.hpp"

namespace furrow {

struct PrintedForm {
  std::string name, difference;
  std::vector<MaterialChange> changes;
};

/// The first is the right form, without changes.
inline const std::vector<PrintedForm> printed_forms_of_metals{
    {"right", "all equations in their right form", {}},
    {"eq_9", "Eq. 9: no stress power in the energy, no heating", {{"form.eq_9", "printed"}}},
    {"eq_17", "Eq. 17: denominator not squared", {{"form.eq_17", "printed"}}},
    {"eq_19", "Eq. 19: f_y = sigma_y/(sqrt(3) J2), no root", {{"form.eq_19", "printed"}}},
    {"eq_21", "Eq. 21: rate of the total strain", {{"form.eq_21", "printed"}}},
    {"eq_24", "Eq. 24: brackets, and strain for its rate", {{"form.eq_24", "printed"}}},
    {"failure", "failure zeroes shear only", {{"form.failure", "printed"}}},
    {"table_1",
     "Table 1: N and C interchanged",
     {{"strength.n", R"({ value = 0.002, unit = "1", source = "tillage-tools-2024" })"},
      {"strength.C", R"({ value = 0.42, unit = "1", source = "tillage-tools-2024" })"}}},
};

}  // namespace furrow
