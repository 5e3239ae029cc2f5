// The project's laws once more, in rate form, for rate_path.hpp: written down from the equations of the literature, not from the
// solver.
#pragma once

#include "reference/exact/rate_path.hpp"

namespace furrow::exact {

/// p = K (rho/rho_0 - 1), or the Mie-Grueneisen equation of state written in the compression chi = 1 - rho_0/rho:
/// p = rho_0 c_0^2 chi/(1 - S chi)^2 (1 - Gamma_0 chi/2) + Gamma_0 rho_0 e, in expansion rho_0 c_0^2 (rho/rho_0 - 1) + Gamma_0
/// rho_0 e.
struct PressureLaw {
  double reference_density;                             ///< kg/m^3
  double bulk_modulus = 0.0;                            ///< K, Pa; of the linear law
  double sound_speed = 0.0, slope = 0.0, gamma = 0.0;   ///< c_0 (m/s), S, Gamma_0; Mie-Grueneisen where c_0 > 0

  double pressure(double density, double energy) const;
  double stiffness(double density) const;   ///< rho dp/drho at constant energy, Pa
  double by_energy() const;                 ///< dp/de, kg/m^3
};

struct JohnsonCookConstants {
  double A, B, n, C, m, reference_rate, reference_temperature, melting_temperature;
  double specific_heat, taylor_quinney;
};

/// Von Mises with linear hardening.
RateLaw von_mises(const PressureLaw& pressure, double G, double Y, double H);

/// Johnson-Cook flow. Below the reference rate it does not depend on the rate: q = Y(eps_p) S(T). Above, it is solved for the
/// rate: eps_p_dot = eps_0_dot exp[(q/(Y S) - 1)/C]; C = 0 has no such branch. The hardening variable of the states is B eps_p^n,
/// which grows regularly from zero where eps_p does not.
RateLaw johnson_cook(const PressureLaw& pressure, double G, const JohnsonCookConstants& c);
double plastic_strain(const JohnsonCookConstants& c, double hardening);

/// Hypoelastic soil with yield sqrt(J2) + alpha I1 = k and potential sqrt(J2) + beta I1 (paper Eqs 11, 14 in the right form).
RateLaw drucker_prager(double K, double G, double alpha, double k, double beta);

}  // namespace furrow::exact
