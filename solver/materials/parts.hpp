// Which modules a material is made of.
#pragma once

#include "solver/materials/materials.hpp"
#include "solver/modules.hpp"

namespace furrow {

/// Calls f(Module) for the law and each of its parts: equation of state, damage.
template <class F>
void for_each_part(const AnyMaterial& material, F&& f) {
  const auto eos = [&f](const auto& law) {
    f(std::is_same_v<std::decay_t<decltype(law.eos)>, LinearEos> ? Module::linear_eos : Module::mie_grueneisen);
  };
  std::visit(
      [&]<class Law>(const Law& law) {
        if constexpr (std::is_same_v<Law, LinearElastic>) {
          f(Module::linear_elastic);
        } else if constexpr (std::is_same_v<Law, DruckerPrager>) {
          f(Module::drucker_prager);
        } else if constexpr (requires { law.damage; }) {
          f(Module::johnson_cook);
          if (law.damage) f(Module::johnson_cook_damage);
          eos(law);
        } else {
          f(Module::j2_plastic);
          eos(law);
        }
      },
      material);
}

}  // namespace furrow
