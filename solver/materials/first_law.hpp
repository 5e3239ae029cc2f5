// The end of a step of a solid with an equation of state: pressure and internal energy, which depend on each other.
#pragma once

#include <cmath>

#include "solver/materials/concept.hpp"

namespace furrow {

/// How a step is closed; the defaults are what mechanics says.
struct Closing {
  double tension_kept = 1.0;   ///< factor of a tensile pressure, 0 for a failed point
  bool stress_power = true;    ///< false: the shear stress does no work on the internal energy (paper Eq. 9 as printed)
};

/// Sets stress and internal energy of `state`, which holds the old stress and the new density, from the new deviator s:
///   sigma = s - p I,  p = p(rho, e),  e = e_0 - (p_0 + p)/2 (v - v_0) + (s_0 + s)/2 : de / rho_middle,
/// which is linear in e and solved exactly. v = 1/rho, and v_0 = exp(-tr de)/rho. A single step from rest ends on the Hugoniot.
template <class Eos>
MaterialState closed_step(const Eos& eos, MaterialState state, const Tensor& s, const Increment& increment,
                          const Closing& closing = {}) {
  const Tensor s_0 = deviator(state.stress);
  const double p_0 = -state.stress.trace() / 3.0;
  const double trace = increment.strain.trace();
  const double dv = -std::expm1(-trace) / state.density;
  double e = state.internal_energy - 0.5 * p_0 * dv;
  if (closing.stress_power) e += 0.5 * double_contraction(s_0 + s, increment.strain) / (state.density * std::exp(0.5 * trace));

  const auto solve = [&](double kept) {   // e + kept (p_cold + a e) dv/2 = known
    const double a = kept * eos.pressure_per_energy();
    const double cold = kept * eos.cold_pressure(state.density);
    state.internal_energy = (e - 0.5 * cold * dv) / (1.0 + 0.5 * a * dv);
    return cold + a * state.internal_energy;
  };
  double p = solve(1.0);
  if (p < 0.0 && closing.tension_kept < 1.0) p = solve(closing.tension_kept);
  state.stress = s - p * Tensor::Identity();
  return state;
}

/// Deviator after an elastic step: s_0 + 2 G de'.
inline Tensor elastic_deviator(const Tensor& stress, double G, const Increment& increment) {
  return deviator(stress) + 2.0 * G * deviator(increment.strain);
}

/// Speed of longitudinal waves, m/s: sqrt((rho dp/drho + 4 G/3)/rho).
template <class Eos>
double longitudinal_speed(const Eos& eos, double G, const MaterialState& state) {
  const double p = -state.stress.trace() / 3.0;
  return std::sqrt((eos.isentropic_stiffness(state.density, p) + 4.0 / 3.0 * G) / state.density);
}

/// Recoverable energy, J/kg: slow compression, and s:s/(4 G rho).
template <class Eos>
double elastic_energy(const Eos& eos, double G, const MaterialState& state) {
  return eos.cold_energy(state.density) + j2(deviator(state.stress)) / (2.0 * G * state.density);
}

}  // namespace furrow
