// A point of material driven along a path, as a system of ordinary differential equations solved by GSL to 1e-10. Constitutive
// equations enter in their rate form; nothing is stepped, returned or split as a solver does it.
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace furrow::exact {

/// Components xx, yy, zz, xy, yz, zx of a symmetric tensor (shear as tensor components, not engineering strains).
using Voigt = std::array<double, 6>;

double contraction(const Voigt& a, const Voigt& b);   ///< a : b
double trace(const Voigt& a);
Voigt deviator(const Voigt& a);
double sqrt_j2(const Voigt& stress);   ///< sqrt(s:s/2) of the deviator

struct Point {
  Voigt stress{};             ///< Cauchy, tension positive, Pa
  double density = 0.0;       ///< kg/m^3
  double energy = 0.0;        ///< J/kg
  double hardening = 0.0;     ///< the law's hardening variable: equivalent plastic strain unless the law says otherwise
  double temperature = 0.0;   ///< K
};

/// A stretch of path at constant rates: for each component either the strain rate (1/s) is given or the rate of the stress
/// (Pa/s), and the spin W_xy, W_yz, W_zx (rad/s) with W = (grad v - grad v^T)/2.
struct Leg {
  double duration = 0.0;   ///< s
  int samples = 1;         ///< states wanted, equally spaced in time, the last at the end
  std::array<bool, 6> stress_controlled{};
  Voigt rate{};
  std::array<double, 3> spin{};
};

/// Plastic flow at a state. The multiplier follows from the strain rate D as gradient : D, or is a function of the state alone.
struct Flow {
  Voigt direction{};         ///< plastic strain rate per multiplier
  Voigt gradient{};          ///< multiplier per strain rate; rate-independent flow
  double multiplier = 0.0;   ///< 1/s; viscoplastic flow
  double strain = 1.0;       ///< equivalent plastic strain rate per multiplier
  double hardening = 1.0;    ///< rate of the hardening variable per multiplier
  double heating = 0.0;      ///< K per J/m^3 of plastic work
};

/// A law in rate form: Jaumann rate of stress = 2 G (D - D_p)' + K tr(D - D_p) I - dp/de e_dot I, with rho e_dot = sigma : D.
/// Plastic flow is rate-independent on the surface yield = 0; a law with `fast` leaves the surface outwards where the flow would
/// be faster than `slowest_fast`, and is viscoplastic there.
struct RateLaw {
  double shear_modulus = 0.0;                               ///< G, Pa
  std::function<double(const Point&)> bulk_modulus;         ///< rho dp/drho at constant e, Pa
  std::function<double(const Point&)> pressure_by_energy;   ///< dp/de, kg/m^3
  std::function<double(const Point&)> yield;                ///< Pa, negative inside
  std::function<Flow(const Point&)> flow;                   ///< on the surface
  std::function<Flow(const Point&)> fast;                   ///< outside it, and continued smoothly to it; may be empty
  double slowest_fast = 0.0;                                ///< equivalent plastic strain rate, 1/s
  double stress_scale = 1.0, hardening_scale = 1.0;         ///< of the tolerance; stress in Pa
};

/// The states at the samples of all legs, one after another. Tolerance relative to the scale of each quantity.
std::vector<Point> follow(const RateLaw& law, const Point& start, const std::vector<Leg>& legs, double tolerance = 1e-10);

}  // namespace furrow::exact
