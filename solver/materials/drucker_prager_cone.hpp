#pragma once

#include <cmath>
#include <limits>

namespace furrow {

/// Drucker and Prager's cone sqrt(J2) + alpha I1 - k = 0 and plastic potential sqrt(J2) + beta I1, tension positive.
struct DruckerPragerCone {
  double alpha, k, beta;   ///< k in Pa

  /// Mean stress at the apex, Pa.
  double apex() const { return alpha > 0.0 ? k / (3.0 * alpha) : std::numeric_limits<double>::infinity(); }

  /// The constants of Bui et al. 2008 that the paper takes: Mohr-Coulomb's in plane strain for associated flow; but the potential
  /// is sqrt(J2) + 3 I1 sin(psi), so that for psi = 0 the angle of friction in plane strain is asin(3 alpha), less than phi; and
  /// psi is not an angle of dilation.
  static DruckerPragerCone bui(double c, double phi, double psi) {
    const double t = std::tan(phi), root = std::sqrt(9.0 + 12.0 * t * t);
    return {t / root, 3.0 * c / root, 3.0 * std::sin(psi)};
  }

  /// Mohr-Coulomb's strength and angle of dilation in plane strain, exactly, for every psi. With the out-of-plane deviator at
  /// failure s_zz = -2 beta sqrt(J2), the in-plane radius is sqrt(J2) sqrt(1 - 3 beta^2) and the in-plane mean stress
  /// I1/3 + beta sqrt(J2). For psi = 0: alpha = sin(phi)/3, k = c cos(phi); for psi = phi the constants of Bui et al.
  static DruckerPragerCone plane_strain(double c, double phi, double psi) {
    const double beta = std::sin(psi) / std::sqrt(9.0 + 3.0 * std::sin(psi) * std::sin(psi));
    const double d = std::sqrt(1.0 - 3.0 * beta * beta) + beta * std::sin(phi);
    return {std::sin(phi) / (3.0 * d), c * std::cos(phi) / d, beta};
  }

  /// Through the compressive meridian of Mohr-Coulomb's pyramid: exact in triaxial compression.
  static DruckerPragerCone compression(double c, double phi, double psi) { return meridian(c, phi, psi, -1.0); }

  /// Through the extensive meridian: exact in triaxial extension.
  static DruckerPragerCone extension(double c, double phi, double psi) { return meridian(c, phi, psi, 1.0); }

 private:
  static DruckerPragerCone meridian(double c, double phi, double psi, double side) {
    const double d = std::sqrt(3.0) * (3.0 + side * std::sin(phi)), d_psi = std::sqrt(3.0) * (3.0 + side * std::sin(psi));
    return {2.0 * std::sin(phi) / d, 6.0 * c * std::cos(phi) / d, 2.0 * std::sin(psi) / d_psi};
  }
};

}  // namespace furrow
