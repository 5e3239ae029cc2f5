// Artificial stress against the tensile instability (Monaghan 2000; Gray, Monaghan & Swift 2001), in principal axes.
#pragma once

#include <cmath>

#include "solver/smoothing/kernel.hpp"
#include "solver/tensor/tensor.hpp"

namespace furrow {

/// R = -eps sigma/rho^2 along each principal axis in tension, weighed in a pair by f^n, f = W(r)/W(dx). So it takes the part
/// eps artificial_share of every tension away, whatever the spacing: soil loses that much of its tensile strength. The neutral form
/// weighs by f^n less this share of f^n: it pushes what is near and pulls what is far, and carries no stress where particles
/// are in order.
struct ArtificialStress {
  double eps = 0.3;
  double n = 4.0;
  bool neutral = false;
};

/// Part of a uniform stress that pairs weighed by f^n carry on a square or cubic lattice of the spacing dx:
/// sum r dW/dr f^n / sum r dW/dr.
template <SmoothingKernel K, int Dim>
double artificial_share(double n, double dx, double h) {
  const int reach = static_cast<int>(K::support * h / dx);
  double carried = 0.0, all = 0.0;
  for (int a = -reach; a <= reach; ++a)
    for (int b = -reach; b <= reach; ++b)
      for (int c = Dim == 3 ? -reach : 0; c <= (Dim == 3 ? reach : 0); ++c) {
        const double r = dx * std::sqrt(a * a + b * b + c * c);
        if (r == 0.0 || r >= K::support * h) continue;
        const double part = r * derivative<K, Dim>(r, h);
        all += part;
        carried += part * std::pow(value<K, Dim>(r, h) / value<K, Dim>(dx, h), n);
      }
  return carried / all;
}

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
