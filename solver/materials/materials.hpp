// THE list of materials. A new law is a header of its own and a word here.
#pragma once

#include <variant>

#include "solver/materials/linear_elastic.hpp"

namespace furrow {

using AnyMaterial = std::variant<LinearElastic>;

}  // namespace furrow
