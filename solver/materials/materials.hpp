// THE list of materials. A new law is a header of its own and a word here.
#pragma once

#include <variant>

#include "solver/materials/drucker_prager.hpp"
#include "solver/materials/j2_plastic.hpp"
#include "solver/materials/johnson_cook.hpp"
#include "solver/materials/linear_elastic.hpp"

namespace furrow {

using AnyMaterial = std::variant<LinearElastic, J2Plastic<LinearEos>, J2Plastic<MieGrueneisen>, JohnsonCook<LinearEos>,
                                 JohnsonCook<MieGrueneisen>, DruckerPrager>;

}  // namespace furrow
