#pragma once

#include "solver/body.hpp"

namespace furrow {

/// Where the energy is and where it went since the start, J (per metre of width in plane strain). Plastic and contact work have
/// their places, filled when a law yields or bodies touch.
struct EnergyLedger {
  double kinetic = 0.0;
  double elastic = 0.0;      ///< recoverable, from the state of each particle
  double plastic = 0.0;      ///< stress work that is not recoverable
  double wall = 0.0;         ///< in the springs of rigid walls
  double layer = 0.0;        ///< taken up by the soil that boundary layers stand for
  double viscous = 0.0;      ///< dissipated by artificial viscosity
  double artificial = 0.0;   ///< taken up by artificial stress
  double damping = 0.0;      ///< taken out by damping
  double contact = 0.0;      ///< in and lost to contact between bodies, and to friction on walls
  double external = 0.0;     ///< put in by gravity, applied forces and prescribed motion

  double total() const { return kinetic + elastic + plastic + wall + layer + viscous + artificial + damping + contact - external; }
};

}  // namespace furrow
