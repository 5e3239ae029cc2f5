#pragma once

#include "solver/materials/first_law.hpp"
#include "solver/materials/linear_eos.hpp"

namespace furrow {

/// Isotropic elasticity in rate form: deviator by Hooke's law, pressure by the linear equation of state p = K (rho/rho_0 - 1).
struct LinearElastic {
  static constexpr std::string_view name = "elastic";

  double reference_density;   ///< rho_0, kg/m^3
  double bulk_modulus;        ///< K, Pa
  double shear_modulus;       ///< G, Pa

  /// From Young's modulus (Pa) and Poisson's ratio in (-1, 0.5).
  static LinearElastic from_young(double density, double E, double nu) {
    return {density, E / (3.0 * (1.0 - 2.0 * nu)), E / (2.0 * (1.0 + nu))};
  }

  LinearEos eos() const { return {reference_density, bulk_modulus}; }

  MaterialState initial_state() const {
    MaterialState state;
    state.density = reference_density;
    return state;
  }

  MaterialState respond(const MaterialState& state, const Increment& increment) const {
    return closed_step(eos(), state, elastic_deviator(state.stress, shear_modulus, increment), increment);
  }

  double sound_speed(const MaterialState& state) const { return longitudinal_speed(eos(), shear_modulus, state); }

  double stored_energy(const MaterialState& state) const { return elastic_energy(eos(), shear_modulus, state); }
};
static_assert(Material<LinearElastic>);

}  // namespace furrow
