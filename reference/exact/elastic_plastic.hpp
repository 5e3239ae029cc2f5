// Closed forms of bodies that yield: waves ahead of a piston, rings that collapse or expand, a strip that is bent.
#pragma once

namespace furrow::exact {

/// Metal with a linear Hugoniot, p = rho_0 c_0^2 eta [1 + (1 - Gamma/2) eta]/[1 - (S - 1) eta]^2 + Gamma rho_0 e with
/// eta = rho/rho_0 - 1, hypoelastic in shear and perfectly plastic at Y.
struct PistonMetal {
  double density;          ///< rho_0, kg/m^3
  double sound_speed;      ///< c_0, m/s
  double slope, gamma;     ///< S, Gamma
  double shear_modulus;    ///< G, Pa
  double yield_stress;     ///< Y, Pa
};

/// State behind a front. stress: magnitude along the wave, Pa.
struct PistonState {
  double front_speed, density, pressure, stress, velocity, energy;
};

/// Uniaxial strain ahead of a piston that moves with `velocity` into metal at rest (Udaykumar et al. 2003; Lieberman et al.
/// 2019): an elastic precursor to rho_Y = rho_0 exp(Y/2G), where the deviator 4/3 G ln(rho/rho_0) reaches 2Y/3, and a plastic shock to
/// the piston's velocity. Both obey the jump conditions of mass, momentum and energy. Front speeds in the frame of the metal at
/// rest. Throws std::domain_error when the piston is too slow to make the metal yield or so fast that the shock overtakes the
/// precursor.
struct Piston {
  PistonState elastic, plastic;
};
Piston piston(const PistonMetal& metal, double velocity);

/// Speed of the inner surface with which an incompressible rigid-plastic cylindrical shell, R_0 < r < R_1 in plane strain, must
/// start inwards (v = -u_0 R_0/r) to stop with the inner radius r_stop (Verney; Howell & Ball 2002), m/s:
///   u_0^2 = 2 Y F/(sqrt(3) rho ln(R_1/R_0)),  F = int_(r_stop/R_0)^1 x ln[1 + (2a + a^2)/x^2] dx,  a = R_1/R_0 - 1.
double collapsing_cylinder_speed(double density, double yield_stress, double inner, double outer, double r_stop);
/// Outer radius of the shell whose inner one is r, by its constant volume.
double outer_radius(double inner, double outer, double r);

/// Thin ring that expands with v_0 in plane strain, perfectly plastic. Per volume its hoop stress takes the work w(e) of the hoop
/// strain e = ln(r/r_0): E' e^2/2 up to e_y = Y'/E', Y' (e - e_y/2) beyond, with Y' = 2Y/sqrt(3) and E' = E/(1 - nu^2) (infinite:
/// a rigid-plastic ring); rho (v_0^2 - v^2)/2 = w. Radius at which it stops, and speed at radius r (0 beyond).
struct ExpandingRing {
  double density, yield_stress, hoop_modulus;   ///< rho, Y, E'
  double radius, velocity;                      ///< r_0, v_0
};
double expanding_ring_stop(const ExpandingRing& ring);
double expanding_ring_speed(const ExpandingRing& ring, double r);

/// Limit moment of a strip of thickness t per width in plane strain, N: (2/sqrt(3)) Y t^2/4.
double limit_moment(double yield_stress, double thickness);

}  // namespace furrow::exact
