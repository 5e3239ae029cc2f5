// Materials and random motions for the tests of the laws.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "solver/materials/materials.hpp"

namespace furrow::test {

inline LinearElastic elastic() { return {2700.0, 66.4e9, 26e9}; }
inline MieGrueneisen aluminium_eos() { return {2700.0, 4921.0, 1.34, 2.0}; }
inline JohnsonCookStrength aluminium_strength() { return {324e6, 114e6, 0.42, 0.002, 1.34, 1.0, 294.0, 925.0}; }
inline JohnsonCookDamage aluminium_damage() { return {-0.77, 1.45, -0.47, 0.0, 1.6, -1.0 / 3.0, 1.0, 0.05}; }
inline DruckerPrager soil(double psi = 0.1) { return {1540.0, 1.5e6, 0.9e6, DruckerPragerCone::plane_strain(5e3, 0.4887, psi)}; }

inline std::vector<AnyMaterial> laws() {
  const LinearEos linear{2700.0, 66.4e9};
  return {elastic(),
          J2Plastic<LinearEos>{linear, 26e9, 300e6},
          J2Plastic<MieGrueneisen>{aluminium_eos(), 26e9, 300e6, 1e9},
          JohnsonCook<LinearEos>{linear, 26e9, aluminium_strength(), 875.0, 0.0},
          JohnsonCook<MieGrueneisen>{aluminium_eos(), 26e9, aluminium_strength(), 875.0, 0.9, aluminium_damage()},
          soil()};
}

class RandomMotion {
 public:
  explicit RandomMotion(unsigned seed) : random_(seed) {}
  double number() { return normal_(random_); }
  Tensor tensor() {
    return Tensor::NullaryExpr([this] { return number(); });
  }
  Tensor symmetric() { return symmetric_part(tensor()); }
  Tensor turn() { return rotation(skew_part(3.0 * tensor())); }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace furrow::test
