// Scheme: the numerical choices of a body, by name. The paper's form and the right form stand side by side.
#pragma once

#include <optional>

#include "solver/schemes/artificial_stress.hpp"
#include "solver/schemes/viscosity.hpp"
#include "solver/smoothing/kernels.hpp"

namespace furrow {

enum class DensityEquation {
  continuity,   ///< d rho/dt = -rho tr L
  shepard,      ///< paper Eq. 7 and nothing else: a uniform density never changes
  summation,    ///< paper Eq. 6 with f = rho
  constant      ///< none: for soil that shears at constant volume, where a gap that opens between grains is no soil
};

/// What makes gradients consistent. With a correction the momentum sum is the dual of the corrected velocity gradient.
enum class Correction {
  none,        ///< the paper's form
  linear,      ///< Bonet & Lok: exact for linear fields
  quadratic    ///< moving least squares of second order: exact for quadratic fields; what bending needs
};

/// Where the kernel lives.
enum class Frame {
  current,     ///< it moves with the particles: the paper's form, and the one for what flows or breaks
  reference    ///< it stays with the undeformed body (reference_frame.hpp): for solids that stay whole
};

/// Bulk viscosity of von Neumann and Richtmyer, for shocks in the reference frame; lengths are the particle spacing.
struct BulkViscosity {
  double linear = 0.06, quadratic = 1.2;
};

struct Scheme {
  Frame frame = Frame::current;
  AnyKernel kernel = WendlandC2{};
  double smoothing_ratio = 1.5;                          ///< h/dx
  Correction correction = Correction::linear;
  bool dual_gradient = false;                            ///< without correction: m_j/rho_i for the paper's m_j/rho_j in Eqs 12, 13
  double least_span = 1e-4;                              ///< below which a linear correction is none (kernel_correction.hpp)
  DensityEquation density = DensityEquation::continuity;
  int shepard_every = 0;                                 ///< steps between re-normalisations of the density by Eq. 7; 0 = never
  std::optional<ArtificialViscosity> viscosity = ArtificialViscosity{};
  std::optional<ArtificialStress> artificial_stress;
  std::optional<BulkViscosity> bulk_viscosity;           ///< in the reference frame, in place of `viscosity`
  double hourglass = 0.0;                                ///< chi of the hourglass control; 0 = off
  double hourglass_damping = 0.0;                        ///< zeta, in the reference frame; 0 = off
  bool sub_cycling = false;                              ///< in the reference frame: squeezed particles take short steps (fast_part.hpp)
  bool cracks = false;                                   ///< in the reference frame: failed particles cut pairs (cracks.hpp)
  double xsph = 0.0;                                     ///< eps of XSPH; 0 = off
  bool energy = true;                                    ///< stress work and viscous heat go into internal energy
};

}  // namespace furrow
