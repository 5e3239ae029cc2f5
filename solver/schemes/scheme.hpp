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
  summation     ///< paper Eq. 6 with f = rho
};

/// What makes gradients consistent. With a correction the momentum sum is the dual of the corrected velocity gradient.
enum class Correction {
  none,        ///< the paper's form
  linear,      ///< Bonet & Lok: exact for linear fields
  quadratic    ///< moving least squares of second order: exact for quadratic fields; what bending needs
};

struct Scheme {
  AnyKernel kernel = WendlandC2{};
  double smoothing_ratio = 1.5;                          ///< h/dx
  Correction correction = Correction::linear;
  DensityEquation density = DensityEquation::continuity;
  int shepard_every = 0;                                 ///< steps between re-normalisations of the density by Eq. 7; 0 = never
  std::optional<ArtificialViscosity> viscosity = ArtificialViscosity{};
  std::optional<ArtificialStress> artificial_stress;
  double hourglass = 0.0;                                ///< chi of the hourglass control; 0 = off
  double xsph = 0.0;                                     ///< eps of XSPH; 0 = off
  bool energy = true;                                    ///< stress work and viscous heat go into internal energy
};

}  // namespace furrow
