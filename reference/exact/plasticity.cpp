#include "reference/exact/plasticity.hpp"

#include <cmath>
#include <stdexcept>
#include <string_view>

#include "reference/exact/quadrature.hpp"

namespace furrow::exact {

std::array<double, 2> jaumann_shear(double G, double strength, double gamma) {
  const double R = strength;
  const double gamma_y = R < 2.0 * G ? 2.0 * std::asin(R / (2.0 * G)) : HUGE_VAL;
  if (gamma <= gamma_y) return {G * (1.0 - std::cos(gamma)), G * std::sin(gamma)};
  // With t = tan(theta/2), a = G/R, w^2 = a^2 - 1: (t - a - w)/(t - a + w) grows as exp(w (gamma - gamma_y)), from
  // theta = gamma_y/2. For large exponents t = a - w.
  const double a = G / R, w = std::sqrt(a * a - 1.0), t_y = std::tan(gamma_y / 4.0);
  const double decay = (t_y - a + w) / (t_y - a - w) * std::exp(-w * (gamma - gamma_y));   // the inverse ratio
  const double t = a + w * (decay + 1.0) / (decay - 1.0);
  const double theta = 2.0 * std::atan(t);
  return {R * std::sin(theta), R * std::cos(theta)};
}

Cone cone(const char* name, double cohesion, double phi, double psi) {
  const std::string_view which(name);
  const double root3 = std::sqrt(3.0);
  if (which == "bui") {
    const double d = std::sqrt(9.0 + 12.0 * std::pow(std::tan(phi), 2));
    return {std::tan(phi) / d, 3.0 * cohesion / d, 3.0 * std::sin(psi)};
  }
  if (which == "compression")
    return {2.0 * std::sin(phi) / (root3 * (3.0 - std::sin(phi))),
            6.0 * cohesion * std::cos(phi) / (root3 * (3.0 - std::sin(phi))),
            2.0 * std::sin(psi) / (root3 * (3.0 - std::sin(psi)))};
  if (which == "extension")
    return {2.0 * std::sin(phi) / (root3 * (3.0 + std::sin(phi))),
            6.0 * cohesion * std::cos(phi) / (root3 * (3.0 + std::sin(phi))),
            2.0 * std::sin(psi) / (root3 * (3.0 + std::sin(psi)))};
  if (which == "plane_strain") {
    // Strength and friction as functions of alpha, k at this beta, inverted: both are monotone and linear in k.
    const double beta = std::tan(psi) / std::sqrt(9.0 + 12.0 * std::pow(std::tan(psi), 2));
    double low = 0.0, high = 0.5;
    for (int i = 0; i < 200; ++i) {
      const double alpha = 0.5 * (low + high);
      (plane_strain_friction({alpha, 1.0, beta}) < phi ? low : high) = alpha;
    }
    const double alpha = 0.5 * (low + high);
    return {alpha, cohesion / plane_strain_cohesion({alpha, 1.0, beta}), beta};
  }
  throw std::invalid_argument("no cone is named " + std::string(which));
}

double triaxial_compression_strength(const Cone& c, double p) {
  return (c.k + 3.0 * c.alpha * p) / (1.0 / std::sqrt(3.0) - c.alpha);
}
double triaxial_extension_strength(const Cone& c, double p) {
  return (c.k + 3.0 * c.alpha * p) / (1.0 / std::sqrt(3.0) + c.alpha);
}

// In the plane the radius is r = (s1 - s3)/2 and the mean stress -(p + r); s_zz = -2 beta sqrt(J2) since no plastic strain leaves
// the plane, hence r = sqrt(J2) sqrt(1 - 3 beta^2) and I1/3 = -(p + r) - beta sqrt(J2), in the surface sqrt(J2) + alpha I1 = k.
double plane_strain_strength(const Cone& c, double p) {
  const double by_radius = (1.0 - 3.0 * c.alpha * c.beta) / std::sqrt(1.0 - 3.0 * c.beta * c.beta);
  return (c.k + 3.0 * c.alpha * p) / (by_radius - 3.0 * c.alpha);
}
// r = c cos(phi) + (p + r) sin(phi): the slope of r over p is sin/(1 - sin), its value at p = 0 c cos/(1 - sin).
double plane_strain_friction(const Cone& c) {
  const double slope = plane_strain_strength({c.alpha, 0.0, c.beta}, 1.0);
  return std::asin(slope / (1.0 + slope));
}
double plane_strain_cohesion(const Cone& c) {
  const double phi = plane_strain_friction(c);
  return plane_strain_strength(c, 0.0) * (1.0 - std::sin(phi)) / std::cos(phi);
}

Adiabatic johnson_cook_adiabatic(const JohnsonCookConstants& c, double density, double rate, double eps) {
  const double R = 1.0 + c.C * std::log(rate / c.reference_rate);
  const double right = c.taylor_quinney * R * (c.A * eps + c.B * std::pow(eps, c.n + 1.0) / (c.n + 1.0)) /
                       (density * c.specific_heat * (c.melting_temperature - c.reference_temperature));
  double low = 0.0, high = 1.0 - 1e-9;
  for (int i = 0; i < 60; ++i) {
    const double theta = 0.5 * (low + high);
    // x = theta u^2 makes the integrand smooth at 0 for every m.
    const double left = integrate([&](double u) { return 2.0 * theta * u / (1.0 - std::pow(theta * u * u, c.m)); }, 0.0, 1.0);
    (left < right ? low : high) = theta;
  }
  const double theta = 0.5 * (low + high);
  return {theta, (c.A + c.B * std::pow(eps, c.n)) * R * (1.0 - std::pow(theta, c.m))};
}

double johnson_cook_fracture_strain(const std::array<double, 5>& D, double triaxiality, double rate_ratio,
                                    double homologous_temperature) {
  return (D[0] + D[1] * std::exp(D[2] * triaxiality)) * (1.0 + D[3] * std::log(rate_ratio)) *
         (1.0 + D[4] * homologous_temperature);
}

}  // namespace furrow::exact
