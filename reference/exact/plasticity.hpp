// Closed forms of plasticity at a point.
#pragma once

#include <array>

#include "reference/exact/rate_laws.hpp"

namespace furrow::exact {

/// Simple shear x' = gamma y of a hypoelastic solid with Jaumann rate (Dienes 1979), cut off where sqrt(J2) reaches `strength`:
/// elastic s12 = G sin(gamma), s11 = -s22 = G (1 - cos gamma); on the surface s12 = R cos(theta), s11 = R sin(theta) with
/// dtheta/dgamma = 1 - (G/R) sin(theta), which tends to sin(theta) = R/G. Returns {s11, s12}, Pa. strength may be infinite.
std::array<double, 2> jaumann_shear(double G, double strength, double gamma);

/// Constants of Drucker and Prager's cone by name: "bui", "plane_strain", "compression", "extension";
/// angles in rad. Throws std::invalid_argument for another name.
struct Cone {
  double alpha, k, beta;
};
Cone cone(const char* name, double cohesion, double phi, double psi);

/// sigma_axial - sigma_cell at failure (Pa, magnitude) at cell pressure p: axial stress raised or lowered.
double triaxial_compression_strength(const Cone& c, double p);
double triaxial_extension_strength(const Cone& c, double p);
/// Half of sigma_1 - sigma_3 at failure in plane strain at cell pressure p: zero plastic strain out of plane.
double plane_strain_strength(const Cone& c, double p);
/// Angle of friction (rad) and cohesion (Pa) that Mohr-Coulomb would need for that strength.
double plane_strain_friction(const Cone& c);
double plane_strain_cohesion(const Cone& c);

/// Johnson-Cook at constant plastic strain rate, adiabatic, at constant density: T* and flow stress at plastic strain eps, from
///   int_0^T* dx/(1 - x^m) = beta R (A eps + B eps^(n+1)/(n+1))/(rho c_p (T_melt - T_ref)),  R = 1 + C ln(rate/rate_0).
struct Adiabatic {
  double homologous_temperature, flow_stress;
};
Adiabatic johnson_cook_adiabatic(const JohnsonCookConstants& c, double density, double rate, double eps);

/// [D1 + D2 exp(D3 s)] [1 + D4 ln(rate ratio)] [1 + D5 T*].
double johnson_cook_fracture_strain(const std::array<double, 5>& D, double triaxiality, double rate_ratio,
                                    double homologous_temperature);

}  // namespace furrow::exact
