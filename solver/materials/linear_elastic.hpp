#pragma once

#include "solver/materials/concept.hpp"

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

  MaterialState initial_state() const {
    MaterialState state;
    state.density = reference_density;
    return state;
  }

  double pressure(double density) const { return bulk_modulus * (density / reference_density - 1.0); }

  MaterialState respond(MaterialState state, const Increment& increment) const {
    const Tensor before = state.stress;
    const Tensor s = deviator(before) + 2.0 * shear_modulus * deviator(increment.strain);
    state.stress = s - pressure(state.density) * Tensor::Identity();
    // Work at the mean stress over the mean mass; the density of the middle of the step is rho exp(tr(de)/2).
    const double middle_density = state.density * std::exp(0.5 * increment.strain.trace());
    state.internal_energy += 0.5 * double_contraction(before + state.stress, increment.strain) / middle_density;
    return state;
  }

  double sound_speed(const MaterialState& state) const {
    return std::sqrt((bulk_modulus + 4.0 / 3.0 * shear_modulus) / state.density);
  }

  /// Integral of p drho/rho^2 and s:s/(4 G rho).
  double stored_energy(const MaterialState& state) const {
    const double ratio = state.density / reference_density;
    const double volumetric = bulk_modulus / reference_density * (std::log(ratio) + 1.0 / ratio - 1.0);
    return volumetric + j2(deviator(state.stress)) / (2.0 * shear_modulus * state.density);
  }
};
static_assert(Material<LinearElastic>);

}  // namespace furrow
