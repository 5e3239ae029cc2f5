#include "reference/exact/elastic_plastic.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "reference/exact/quadrature.hpp"

namespace furrow::exact {
namespace {

/// Root of f between a and b, where its signs differ, to round-off.
double bisect(const std::function<double(double)>& f, double a, double b) {
  const bool rising = f(b) > 0.0;
  if ((f(a) > 0.0) == rising) throw std::domain_error("no root of the jump conditions in the bracket");
  for (int k = 0; k < 200; ++k) {
    const double middle = 0.5 * (a + b);
    ((f(middle) > 0.0) == rising ? b : a) = middle;
  }
  return 0.5 * (a + b);
}

/// Pressure at the end of a jump from (rho_1, sigma_1, e_1) to density rho with the deviator 2/3 of `strength` in the stress: the
/// jump in energy, e - e_1 = (sigma + sigma_1)/2 (1/rho_1 - 1/rho), is linear in the pressure.
PistonState behind(const PistonMetal& m, double rho_1, double sigma_1, double e_1, double rho, double deviator) {
  const double eta = rho / m.density - 1.0;
  const double d = 1.0 - (m.slope - 1.0) * eta;
  const double cold = m.density * m.sound_speed * m.sound_speed * eta * (1.0 + (1.0 - 0.5 * m.gamma) * eta) / (d * d);
  const double squeeze = 0.5 * (1.0 / rho_1 - 1.0 / rho), g = m.gamma * m.density;
  const double p = (cold + g * (e_1 + squeeze * (sigma_1 + deviator))) / (1.0 - g * squeeze);
  PistonState state{};
  state.density = rho;
  state.pressure = p;
  state.stress = p + deviator;
  state.energy = e_1 + squeeze * (sigma_1 + state.stress);
  return state;
}

}  // namespace

Piston piston(const PistonMetal& m, double velocity) {
  const double deviator = 2.0 / 3.0 * m.yield_stress;
  Piston result;
  PistonState& elastic = result.elastic;
  elastic = behind(m, m.density, 0.0, 0.0, m.density * std::exp(0.5 * m.yield_stress / m.shear_modulus), deviator);
  // rho_0 D = rho (D - u), sigma = rho_0 D u.
  elastic.front_speed = std::sqrt(elastic.stress / (m.density * (1.0 - m.density / elastic.density)));
  elastic.velocity = elastic.stress / (m.density * elastic.front_speed);
  if (!(velocity > elastic.velocity)) throw std::domain_error("the piston is too slow to make the metal yield");

  const auto plastic_at = [&](double rho) {
    PistonState s = behind(m, elastic.density, elastic.stress, elastic.energy, rho, deviator);
    // (sigma_2 - sigma_Y)(1/rho_Y - 1/rho_2) = (u_2 - u_Y)^2.
    s.velocity = elastic.velocity + std::sqrt((s.stress - elastic.stress) * (1.0 / elastic.density - 1.0 / rho));
    s.front_speed = elastic.velocity + (s.stress - elastic.stress) / (elastic.density * (s.velocity - elastic.velocity));
    return s;
  };
  const double rho = bisect([&](double r) { return plastic_at(r).velocity - velocity; }, elastic.density * (1.0 + 1e-9),
                            m.density * (1.0 + 0.5 / m.slope));
  result.plastic = plastic_at(rho);
  if (result.plastic.front_speed >= elastic.front_speed) throw std::domain_error("the shock overtakes the elastic precursor");
  return result;
}

double collapsing_cylinder_speed(double density, double yield_stress, double inner, double outer, double r_stop) {
  const double a = outer / inner - 1.0;
  const double F = integrate([a](double x) { return x * std::log1p((2.0 * a + a * a) / (x * x)); }, r_stop / inner, 1.0);
  return std::sqrt(2.0 * yield_stress * F / (std::sqrt(3.0) * density * std::log(outer / inner)));
}

double outer_radius(double inner, double outer, double r) { return std::sqrt(outer * outer - inner * inner + r * r); }

double expanding_ring_stop(const ExpandingRing& ring) {
  const double hoop = 2.0 * ring.yield_stress / std::sqrt(3.0), yield = hoop / ring.hoop_modulus;
  const double kinetic = 0.5 * ring.density * ring.velocity * ring.velocity;
  const double strain =
      kinetic < 0.5 * hoop * yield ? std::sqrt(2.0 * kinetic / ring.hoop_modulus) : 0.5 * yield + kinetic / hoop;
  return ring.radius * std::exp(strain);
}

double expanding_ring_speed(const ExpandingRing& ring, double r) {
  const double hoop = 2.0 * ring.yield_stress / std::sqrt(3.0), yield = hoop / ring.hoop_modulus, e = std::log(r / ring.radius);
  const double work = e < yield ? 0.5 * ring.hoop_modulus * e * e : hoop * (e - 0.5 * yield);
  return std::sqrt(std::max(0.0, ring.velocity * ring.velocity - 2.0 * work / ring.density));
}

double limit_moment(double yield_stress, double thickness) {
  return yield_stress * thickness * thickness / (2.0 * std::sqrt(3.0));
}

}  // namespace furrow::exact
