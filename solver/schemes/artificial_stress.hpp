// Artificial stress against the tensile instability (Monaghan 2000; Gray, Monaghan & Swift 2001), in principal axes.
#pragma once

#include <cmath>

#include "solver/tensor/tensor.hpp"

namespace furrow {

/// R = -eps sigma/rho^2 along each principal axis in tension, weighed in a pair by f^n, f = W(r)/W(dx).
struct ArtificialStress {
  double eps = 0.3;
  double n = 4.0;
};

/// R of one particle, m^5/(kg s^2): `stress` the block of the stress in the space of motion.
template <int Dim>
Matrix<Dim> artificial_stress(const ArtificialStress& model, const Matrix<Dim>& stress, double density) {
  Eigen::SelfAdjointEigenSolver<Matrix<Dim>> principal;
  principal.computeDirect(stress);
  const Vector<Dim> tension = principal.eigenvalues().cwiseMax(0.0);
  if (tension.isZero(0.0)) return Matrix<Dim>::Zero();
  const Matrix<Dim>& axes = principal.eigenvectors();
  return -model.eps / (density * density) * (axes * tension.asDiagonal() * axes.transpose());
}

}  // namespace furrow
