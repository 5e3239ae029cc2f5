#include "reference/exact/rate_laws.hpp"

#include <algorithm>
#include <cmath>

namespace furrow::exact {
namespace {

/// d sqrt(3 J2)/d sigma = 3 s/(2 q), the direction of flow of von Mises.
Voigt normal(const Point& p, double q) {
  Voigt n = deviator(p.stress);
  for (double& x : n) x *= 1.5 / q;
  return n;
}

double equivalent_stress(const Point& p) { return std::sqrt(3.0) * sqrt_j2(p.stress); }

Voigt scaled(Voigt a, double factor) {
  for (double& x : a) x *= factor;
  return a;
}

RateLaw metal(const PressureLaw& pressure, double G, double stress_scale) {
  RateLaw law;
  law.shear_modulus = G;
  law.bulk_modulus = [pressure](const Point& p) { return pressure.stiffness(p.density); };
  law.pressure_by_energy = [pressure](const Point&) { return pressure.by_energy(); };
  law.stress_scale = stress_scale;
  return law;
}

struct Softening {
  double factor, by_temperature;   // 1 - T*^m, and its derivative by T
};
Softening softening(const JohnsonCookConstants& c, double T) {
  const double range = c.melting_temperature - c.reference_temperature;
  const double x = (T - c.reference_temperature) / range;
  if (x <= 0.0) return {1.0, 0.0};
  if (x >= 1.0) return {0.0, 0.0};
  return {1.0 - std::pow(x, c.m), -c.m * std::pow(x, c.m - 1.0) / range};
}

}  // namespace

double PressureLaw::pressure(double density, double energy) const {
  if (sound_speed == 0.0) return bulk_modulus * (density / reference_density - 1.0);
  const double chi = 1.0 - reference_density / density, base = reference_density * sound_speed * sound_speed;
  const double hot = gamma * reference_density * energy;
  if (chi < 0.0) return base * (density / reference_density - 1.0) + hot;
  return base * chi / std::pow(1.0 - slope * chi, 2) * (1.0 - 0.5 * gamma * chi) + hot;
}

double PressureLaw::stiffness(double density) const {
  const double ratio = density / reference_density;
  if (sound_speed == 0.0) return bulk_modulus * ratio;
  const double chi = 1.0 - 1.0 / ratio, base = reference_density * sound_speed * sound_speed;
  if (chi < 0.0) return base * ratio;
  const double d = 1.0 - slope * chi;
  const double hugoniot = base * chi / (d * d), hugoniot_by_chi = base * (1.0 + slope * chi) / (d * d * d);
  return (hugoniot_by_chi * (1.0 - 0.5 * gamma * chi) - 0.5 * gamma * hugoniot) / ratio;   // rho dchi/drho = rho_0/rho
}

double PressureLaw::by_energy() const { return gamma * reference_density; }

RateLaw von_mises(const PressureLaw& pressure, double G, double Y, double H) {
  RateLaw law = metal(pressure, G, Y);
  law.yield = [=](const Point& p) { return equivalent_stress(p) - Y - H * p.hardening; };
  law.flow = [=](const Point& p) {
    Flow f;
    f.direction = normal(p, equivalent_stress(p));
    f.gradient = scaled(f.direction, 2.0 * G / (3.0 * G + H));   // 2 G n : D = 3 G lambda + H lambda
    return f;
  };
  return law;
}

RateLaw johnson_cook(const PressureLaw& pressure, double G, const JohnsonCookConstants& c) {
  RateLaw law = metal(pressure, G, c.A);
  law.hardening_scale = c.A;
  const auto slow_stress = [c](const Point& p) { return (c.A + p.hardening) * softening(c, p.temperature).factor; };
  const auto softness = [c](const Point& p) {   // d eps_p/dz for z = B eps_p^n, finite at z = 0 where dz/d eps_p is not
    return std::pow(std::max(0.0, p.hardening) / c.B, 1.0 / c.n - 1.0) / (c.n * c.B);
  };
  const auto heating = [c](const Point& p) { return c.taylor_quinney / (p.density * c.specific_heat); };

  law.yield = [=](const Point& p) { return equivalent_stress(p) - slow_stress(p); };
  law.flow = [=](const Point& p) {   // multiplier z_dot
    const double q = equivalent_stress(p);
    const Softening S = softening(c, p.temperature);
    const Voigt n = normal(p, q);
    Flow f;
    f.strain = softness(p);
    f.direction = scaled(n, f.strain);
    f.heating = heating(p);
    // q_dot = 2 G n : D - 3 G eps_p_dot is to be S z_dot + (A + z) dS/dT b q eps_p_dot.
    f.gradient = scaled(n, 2.0 * G / (S.factor + ((c.A + p.hardening) * S.by_temperature * f.heating * q + 3.0 * G) * f.strain));
    return f;
  };
  if (c.C == 0.0) return law;
  law.slowest_fast = c.reference_rate;
  law.fast = [=](const Point& p) {   // multiplier eps_p_dot
    const double q = equivalent_stress(p);
    Flow f;
    f.direction = normal(p, q);
    f.multiplier = c.reference_rate * std::exp((q / slow_stress(p) - 1.0) / c.C);
    f.hardening = 1.0 / softness(p);
    f.heating = heating(p);
    return f;
  };
  return law;
}

double plastic_strain(const JohnsonCookConstants& c, double hardening) {
  return std::pow(std::max(0.0, hardening) / c.B, 1.0 / c.n);
}

RateLaw drucker_prager(double K, double G, double alpha, double k, double beta) {
  RateLaw law;
  law.shear_modulus = G;
  law.bulk_modulus = [K](const Point&) { return K; };
  law.pressure_by_energy = [](const Point&) { return 0.0; };
  law.stress_scale = std::max(k, 1e-3 * G);
  law.yield = [=](const Point& p) { return sqrt_j2(p.stress) + alpha * trace(p.stress) - k; };
  law.flow = [=](const Point& p) {
    Flow f;
    const Voigt s = deviator(p.stress);
    const double J = sqrt_j2(p.stress);
    for (std::size_t i = 0; i < 6; ++i) {
      const double identity = i < 3 ? 1.0 : 0.0;
      f.direction[i] = 0.5 * s[i] / J + beta * identity;
      f.gradient[i] = (3.0 * alpha * K * identity + G / J * s[i]) / (9.0 * alpha * beta * K + G);
    }
    f.strain = f.hardening = 1.0 / std::sqrt(3.0);
    return f;
  };
  return law;
}

}  // namespace furrow::exact
