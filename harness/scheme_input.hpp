// The numerical choices of a case, by name:
//
//   scheme = { kernel = "wendland_c2", correction = "linear", density = "continuity", viscosity = { alpha = 1, beta = 2 },
//              artificial_stress = { eps = 0.3, n = 4, neutral = false }, hourglass = 0.1, xsph = 0.5, shepard_every = 20, energy = true }
//
//   scheme = { frame = "reference", correction = "linear", bulk_viscosity = { linear = 0.06, quadratic = 1.2 },
//              hourglass = 0.1, hourglass_damping = 0.1, cracks = true, sub_cycling = true }
//
// frame: current (default, the paper's form: the kernel moves with the particles) | reference (total Lagrangian: the kernel stays
// with the undeformed body; viscosity, artificial stress, XSPH and density equations of the current frame have no place there).
// correction: none (the paper's form) | linear | quadratic; dual_gradient, without correction: velocity gradient with m_j/rho_i, the
// dual of the momentum sum, for the paper's m_j/rho_j; least_span: how far neighbours must span space for a linear one, from 0
// (on a line) to 1 (all around), default 1e-4, more for soil that flies apart; density: continuity | shepard | summation | constant.
// cracks: in the reference frame pairs no longer see each other through failed particles. sub_cycling:
// in the reference frame particles that are squeezed much take short steps of their own. Viscosity, artificial stress, hourglass
// control, cracks and XSPH are off where they are not named; each may be switched off by name as well (viscosity = false).
#pragma once

#include "harness/case.hpp"
#include "harness/input.hpp"
#include "solver/schemes/scheme.hpp"

namespace furrow {

/// The table `scheme` of a case's parameters; the smoothing ratio comes with the resolution.
Scheme read_scheme(const Parameters& parameters);

/// The key `correction` of a table, for cases that sweep over it.
Correction read_correction(const Parameters& table);

/// Tells the run which modules a scheme puts to work.
void exercise(Run& run, const Scheme& scheme);

}  // namespace furrow
