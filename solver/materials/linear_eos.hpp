#pragma once

#include <cmath>

namespace furrow {

/// p = K (rho/rho_0 - 1): pressure by density alone.
struct LinearEos {
  double reference_density;   ///< rho_0, kg/m^3
  double bulk_modulus;        ///< K, Pa

  /// Pressure (Pa) at density rho without internal energy.
  double cold_pressure(double rho) const { return bulk_modulus * (rho / reference_density - 1.0); }
  /// dp/de at constant density, kg/m^3.
  double pressure_per_energy() const { return 0.0; }
  /// rho dp/drho at constant entropy, Pa.
  double isentropic_stiffness(double rho, double) const { return bulk_modulus * rho / reference_density; }
  /// Energy (J/kg) of slow compression from rho_0: integral of p drho/rho^2.
  double cold_energy(double rho) const {
    const double eta = rho / reference_density - 1.0;
    return bulk_modulus / reference_density * (std::log1p(eta) - eta / (1.0 + eta));
  }
};

}  // namespace furrow
