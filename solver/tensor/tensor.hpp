// Algebra of 3x3 tensors over Eigen. Stress, strain rate and materials are always 3x3; plane strain is embedded, so that the
// out-of-plane stress is there.
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cmath>

namespace furrow {

using Tensor = Eigen::Matrix3d;
template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Matrix = Eigen::Matrix<double, Dim, Dim>;

/// a - tr(a)/3 I.
inline Tensor deviator(const Tensor& a) { return a - a.trace() / 3.0 * Tensor::Identity(); }

/// a : b.
inline double double_contraction(const Tensor& a, const Tensor& b) { return a.cwiseProduct(b).sum(); }

/// Second invariant of a deviator, J2 = s:s/2.
inline double j2(const Tensor& s) { return 0.5 * s.squaredNorm(); }

/// Von Mises equivalent stress sqrt(3 J2) of a full stress tensor.
inline double von_mises(const Tensor& stress) { return std::sqrt(3.0 * j2(deviator(stress))); }

inline Tensor symmetric_part(const Tensor& a) { return 0.5 * (a + a.transpose()); }
inline Tensor skew_part(const Tensor& a) { return 0.5 * (a - a.transpose()); }

/// A Dim x Dim matrix in the upper left of a 3x3 tensor, zero elsewhere: plane strain for Dim = 2.
template <int Dim>
Tensor embed(const Matrix<Dim>& a) {
  Tensor full = Tensor::Zero();
  full.template topLeftCorner<Dim, Dim>() = a;
  return full;
}

/// Rotation exp(W) of a skew tensor W (rad), orthogonal to round-off (Rodrigues). A stress that turns with constant spin w
/// for a time dt is exp(w dt) s exp(w dt)^T: the Jaumann rate without any error of its own.
inline Tensor rotation(const Tensor& W) {
  const double angle = std::sqrt(0.5 * W.squaredNorm());
  if (angle == 0.0) return Tensor::Identity();
  const double a = std::sin(angle) / angle;
  const double b = 0.5 * std::pow(std::sin(0.5 * angle) / (0.5 * angle), 2);
  return Tensor::Identity() + a * W + b * W * W;
}

/// R a R^T.
inline Tensor rotated(const Tensor& a, const Tensor& R) { return R * a * R.transpose(); }

}  // namespace furrow
