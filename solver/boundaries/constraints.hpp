#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "solver/tensor/tensor.hpp"

namespace furrow {

/// Particles, by id, that move as prescribed whatever acts on them: clamps, pistons, rigid parts of a body. Their stress still
/// follows from the motion around them.
template <int Dim>
struct PrescribedMotion {
  std::string name;
  std::vector<std::int32_t> ids;
  std::function<Vector<Dim>(double time)> velocity;   ///< m/s
};

/// A face of a body that is held: half a spacing outside the outermost particles, where the velocity read across from the two
/// outermost, 3/2 v_1 - 1/2 v_2, stays zero. Held particles hold the body half a spacing further out or in, an error of first
/// order in the spacing; this one is of second order. The force that holds acts in the same proportion and does no work.
struct HeldFace {
  std::string name;
  std::vector<std::array<std::int32_t, 2>> columns;   ///< ids, the outermost first; no particle in two of them
};

/// A force shared by particles, by id, in proportion to their mass: a traction on a tip, a load on a patch.
template <int Dim>
struct AppliedForce {
  std::string name;
  std::vector<std::int32_t> ids;
  std::function<Vector<Dim>(double time)> force;      ///< N in all; per metre of width in plane strain
};

/// Everything that acts on a body from outside.
template <int Dim>
struct Loads {
  Vector<Dim> gravity = Vector<Dim>::Zero();          ///< m/s^2
  std::function<double(double time)> gravity_factor;  ///< times gravity; empty = 1
  double damping = 0.0;                               ///< 1/s: acceleration -damping v, to reach rest; 0 = none
  double damping_end = std::numeric_limits<double>::infinity();   ///< s; from then on there is no damping
  std::vector<PrescribedMotion<Dim>> motions;
  std::vector<AppliedForce<Dim>> forces;
  std::vector<HeldFace> faces;                        ///< velocities must obey them from the start

  Vector<Dim> gravity_at(double time) const { return gravity_factor ? Vector<Dim>(gravity_factor(time) * gravity) : gravity; }
  double damping_at(double time) const { return time < damping_end ? damping : 0.0; }
};

}  // namespace furrow
