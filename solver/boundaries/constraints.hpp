#pragma once

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

/// A face of a body that is held: v_f = sum_k w_k v_k, the velocity of the face read from each column of particles behind it, stays
/// zero. Held particles would hold the body half a spacing further out or in. The force that holds acts on the column in
/// proportion to the weights and does no work. Body::hold_face finds the weights.
struct HeldFace {
  struct Column {
    std::vector<std::int32_t> ids;   ///< from the face inwards; no particle in two columns
    std::vector<double> weights;     ///< of sum 1, and with no moment about the face
  };
  std::string name;
  std::vector<Column> columns;
};

/// A force shared by particles, by id, in proportion to their mass: a traction on a tip, a load on a patch.
template <int Dim>
struct AppliedForce {
  std::string name;
  std::vector<std::int32_t> ids;
  std::function<Vector<Dim>(double time)> force;      ///< N in all; per metre of width in plane strain
};

/// Forces on single particles, by id, that stay until somebody changes them: what another body does to this one between two looks
/// at the contact.
template <int Dim>
struct HeldForces {
  std::vector<std::int32_t> ids;
  std::vector<Vector<Dim>> forces;   ///< N
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
  HeldForces<Dim> held;
  std::vector<HeldFace> faces;                        ///< by Body::hold_face; velocities must obey them from the start

  Vector<Dim> gravity_at(double time) const { return gravity_factor ? Vector<Dim>(gravity_factor(time) * gravity) : gravity; }
  double damping_at(double time) const { return time < damping_end ? damping : 0.0; }
};

}  // namespace furrow
