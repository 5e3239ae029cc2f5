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
  const double x2 = 0.5 * W.squaredNorm();   // angle squared
  if (x2 == 0.0) return Tensor::Identity();
  double a, b;   // sin x / x, (1 - cos x)/x^2
  if (x2 < 0.01) {   // their series, to round-off: a step turns by little
    a = 1.0 - x2 * (1.0 / 6.0) * (1.0 - x2 * (1.0 / 20.0) * (1.0 - x2 * (1.0 / 42.0) * (1.0 - x2 * (1.0 / 72.0))));
    b = 0.5 * (1.0 - x2 * (1.0 / 12.0) * (1.0 - x2 * (1.0 / 30.0) * (1.0 - x2 * (1.0 / 56.0) * (1.0 - x2 * (1.0 / 90.0)))));
  } else {
    const double x = std::sqrt(x2), s = std::sin(0.5 * x) / (0.5 * x);
    a = std::sin(x) / x;
    b = 0.5 * s * s;
  }
  if (W(0, 2) == 0.0 && W(1, 2) == 0.0) {   // in the plane
    const double c = 1.0 - b * x2, s = a * W(1, 0);
    return (Tensor() << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0).finished();
  }
  const Vector<3> w(W(2, 1), W(0, 2), W(1, 0));   // W^2 = w w^T - x^2 I
  return (1.0 - b * x2) * Tensor::Identity() + a * W + b * w * w.transpose();
}

/// R a R^T.
inline Tensor rotated(const Tensor& a, const Tensor& R) {
  const auto plane = [](const Tensor& t) { return t(0, 2) == 0.0 && t(1, 2) == 0.0 && t(2, 0) == 0.0 && t(2, 1) == 0.0; };
  if (!plane(R) || !plane(a)) {   // lazy: written out in place
    Tensor half_turned;
    half_turned.noalias() = R.lazyProduct(a);
    return half_turned.lazyProduct(R.transpose());
  }
  const double b00 = R(0, 0) * a(0, 0) + R(0, 1) * a(1, 0), b01 = R(0, 0) * a(0, 1) + R(0, 1) * a(1, 1);
  const double b10 = R(1, 0) * a(0, 0) + R(1, 1) * a(1, 0), b11 = R(1, 0) * a(0, 1) + R(1, 1) * a(1, 1);
  Tensor turned = Tensor::Zero();
  turned(0, 0) = b00 * R(0, 0) + b01 * R(0, 1);
  turned(0, 1) = b00 * R(1, 0) + b01 * R(1, 1);
  turned(1, 0) = b10 * R(0, 0) + b11 * R(0, 1);
  turned(1, 1) = b10 * R(1, 0) + b11 * R(1, 1);
  turned(2, 2) = R(2, 2) * a(2, 2) * R(2, 2);
  return turned;
}

}  // namespace furrow
