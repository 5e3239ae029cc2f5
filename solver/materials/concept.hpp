// Materials are pure laws: state in, new state out. No particles, no loops, no files in them.
#pragma once

#include <cmath>
#include <concepts>
#include <string_view>

#include "solver/tensor/tensor.hpp"

namespace furrow {

/// All that a point of material remembers; complete enough to restart from.
struct MaterialState {
  Tensor stress = Tensor::Zero();    ///< Cauchy, tension positive, Pa
  double density = 0.0;              ///< kg/m^3
  double internal_energy = 0.0;      ///< J/kg, from the reference state
  double plastic_strain = 0.0;       ///< equivalent
  double plastic_work = 0.0;         ///< J/kg, dissipated so far
  double temperature = 0.0;          ///< K
  double fracture_onset = 0.0;       ///< sum of plastic strain over fracture strain; 1 when fracture begins
  double damage = 0.0;               ///< 1 when failed
};

/// What happens to a point in one step, in the frame of the middle of the step: strain = sym(L) dt, spin = skew(L) dt (rad).
struct Increment {
  Tensor strain = Tensor::Zero();
  Tensor spin = Tensor::Zero();
  double dt = 0.0;
};

template <class M>
concept Material = requires(const M& m, const MaterialState& state, const Increment& increment) {
  { M::name } -> std::convertible_to<std::string_view>;          // as in case files: "elastic"
  { m.initial_state() } -> std::same_as<MaterialState>;          // stress free, at rest, at the reference temperature
  // The state after a strain increment without spin. `state.density` is that of the end already (continuity).
  { m.respond(state, increment) } -> std::same_as<MaterialState>;
  { m.sound_speed(state) } -> std::same_as<double>;              // longitudinal, m/s: for time step and viscosity
  { m.stored_energy(state) } -> std::same_as<double>;            // recoverable, J/kg
};

/// One step at a density that is known already: half the spin, the law's own response, the other half of the spin. Of second
/// order in dt for any path; exact in the stress's invariants under pure spin (Jaumann rate).
template <class M>
MaterialState turn_and_respond(const M& material, MaterialState state, const Increment& increment) {
  const Tensor half_turn = rotation(0.5 * increment.spin);
  state.stress = rotated(state.stress, half_turn);
  state = material.respond(state, increment);
  state.stress = rotated(state.stress, half_turn);
  return state;
}

/// One step of a material point, its density by continuity.
template <class M>
MaterialState advance(const M& material, MaterialState state, const Increment& increment) {
  state.density *= std::exp(-increment.strain.trace());
  return turn_and_respond(material, state, increment);
}

}  // namespace furrow
