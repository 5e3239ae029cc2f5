#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace furrow {

/// Mie-Grueneisen equation of state on the linear Hugoniot U_s = c_0 + S u_p, with Gamma rho = Gamma_0 rho_0 (paper Eq. 17 with
/// the denominator squared, as the jump conditions give it), eta = rho/rho_0 - 1 and e the internal energy per mass:
///   p = rho_0 c_0^2 eta [1 + (1 - Gamma_0/2) eta] / [1 - (S - 1) eta]^2 + Gamma_0 rho_0 e   in compression,
///   p = rho_0 c_0^2 eta + Gamma_0 rho_0 e                                                   in expansion.
/// Beyond eta = 1/(S - 1) no shock compresses the material: the pressure is NaN there, not a number from the wrong side of the
/// pole.
struct MieGrueneisen {
  double reference_density;          ///< rho_0, kg/m^3
  double sound_speed;                ///< c_0, m/s, of bulk waves
  double slope;                      ///< S
  double gamma;                      ///< Gamma_0
  bool squared_denominator = true;   ///< false: Eq. 17 as the paper prints it

  double cold_pressure(double rho) const {
    const double eta = rho / reference_density - 1.0;
    const double stiffness = reference_density * sound_speed * sound_speed;
    if (eta <= 0.0) return stiffness * eta;
    const double D = denominator(eta);
    return stiffness * eta * (1.0 + (1.0 - 0.5 * gamma) * eta) / (squared_denominator ? D * D : D);
  }

  double pressure_per_energy() const { return gamma * reference_density; }

  double isentropic_stiffness(double rho, double pressure) const {
    return rho * cold_slope(rho) + gamma * reference_density * pressure / rho;
  }

  /// Energy of slow compression from rho_0 at constant entropy: de = -p dv with p = p(rho, e), a linear equation whose solution
  /// is v_0 int_0^x exp(Gamma_0 (x - y)) p_cold(rho_0/(1 - y)) dy with x = 1 - rho_0/rho, by Gauss-Legendre with eight points.
  double cold_energy(double rho) const {
    constexpr std::array<double, 4> node{0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
    constexpr std::array<double, 4> weight{0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
    const double x = 1.0 - reference_density / rho;
    double sum = 0.0;
    for (std::size_t k = 0; k < node.size(); ++k)
      for (const double side : {-1.0, 1.0}) {
        const double y = 0.5 * x * (1.0 + side * node[k]);
        sum += weight[k] * std::exp(gamma * (x - y)) * cold_pressure(reference_density / (1.0 - y));
      }
    return 0.5 * x * sum / reference_density;
  }

 private:
  double denominator(double eta) const {
    const double D = 1.0 - (slope - 1.0) * eta;
    return D > 0.0 ? D : std::numeric_limits<double>::quiet_NaN();
  }

  double cold_slope(double rho) const {   // dp_cold/drho
    const double eta = rho / reference_density - 1.0;
    const double c2 = sound_speed * sound_speed;
    if (eta <= 0.0) return c2;
    const double a = 1.0 - 0.5 * gamma, D = denominator(eta);
    const double N = eta * (1.0 + a * eta), dN = 1.0 + 2.0 * a * eta;
    return squared_denominator ? c2 * (dN + 2.0 * (slope - 1.0) * N / D) / (D * D) : c2 * (dN + (slope - 1.0) * N / D) / D;
  }
};

}  // namespace furrow
