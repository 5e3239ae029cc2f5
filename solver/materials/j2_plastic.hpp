#pragma once

#include <algorithm>

#include "solver/materials/first_law.hpp"
#include "solver/materials/linear_eos.hpp"
#include "solver/materials/mie_grueneisen.hpp"
#include "solver/materials/straight_path.hpp"

namespace furrow {

/// Von Mises plasticity with linear hardening, sigma_y = Y + H eps_p; H = 0 is perfect plasticity. The return to the yield
/// surface is exact, sqrt(3 J2) = sigma_y(eps_p + d_eps_p) with d_eps_p = (q_trial - sigma_y(eps_p))/(3 G + H), and the whole
/// step is for H = 0 and straight strain (straight_path.hpp); along the stress it is the radial return.
template <class Eos>
struct J2Plastic {
  static constexpr std::string_view name = "j2";

  Eos eos;
  double shear_modulus;             ///< G, Pa
  double yield_stress;              ///< Y, Pa
  double hardening_modulus = 0.0;   ///< H, Pa

  MaterialState initial_state() const {
    MaterialState state;
    state.density = eos.reference_density;
    return state;
  }

  double flow_stress(double plastic_strain) const { return yield_stress + hardening_modulus * plastic_strain; }

  MaterialState respond(MaterialState state, const Increment& increment) const {
    const double G = shear_modulus;
    const double yield = flow_stress(state.plastic_strain);
    const StraightPath path = straight_path(deviator(state.stress), 2.0 * G * deviator(increment.strain), yield);
    const double d_eps_p = std::max(0.0, (path.q_trial - yield) / (3.0 * G + hardening_modulus));
    const double q = path.q_trial - 3.0 * G * d_eps_p;
    state.plastic_strain += d_eps_p;
    state.plastic_work += q * d_eps_p / state.density;
    return closed_step(eos, state, q * path.direction, increment);
  }

  double sound_speed(const MaterialState& state) const { return longitudinal_speed(eos, shear_modulus, state); }
  double stored_energy(const MaterialState& state) const { return elastic_energy(eos, shear_modulus, state); }
};
static_assert(Material<J2Plastic<LinearEos>> && Material<J2Plastic<MieGrueneisen>>);

}  // namespace furrow
