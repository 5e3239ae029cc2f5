// The independent computations of plasticity against each other and against closed forms that they do not use.
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/exact/plasticity.hpp"
#include "reference/exact/rate_laws.hpp"
#include "tests/catch.hpp"

using namespace furrow::exact;

namespace {

constexpr double degree = std::numbers::pi / 180.0;
const PressureLaw linear{2700.0, 66.4e9};
const JohnsonCookConstants aluminium{324e6, 114e6, 0.42, 0.002, 1.34, 1.0, 294.0, 925.0, 896.0, 0.9};

Point at_rest(double density) {
  Point p;
  p.density = density;
  p.temperature = 294.0;
  return p;
}

Leg shear(double gamma) {
  Leg leg{.duration = 1.0, .samples = 10};
  leg.rate[3] = 0.5 * gamma;
  leg.spin[0] = 0.5 * gamma;
  return leg;
}

Leg pull(double strain, double seconds) {
  Leg leg{.duration = seconds, .samples = 10, .stress_controlled = {false, true, true, false, false, false}};
  leg.rate[0] = strain / seconds;
  return leg;
}

}  // namespace

TEST_CASE("Simple shear: the system of equations and Dienes' closed form agree", "[reference]") {
  const double G = 26e9, infinite = std::numeric_limits<double>::infinity();
  for (const double Y : {0.5e9, 20e9, infinite}) {
    const auto states = follow(von_mises(linear, G, std::isinf(Y) ? 1e300 : Y, 0.0), at_rest(2700.0), {shear(3.0)});
    for (std::size_t k = 0; k < states.size(); ++k) {
      const auto [s11, s12] = jaumann_shear(G, Y / std::sqrt(3.0), 0.3 * static_cast<double>(k + 1));
      CHECK(states[k].stress[0] == Approx(s11).epsilon(1e-8));
      CHECK(states[k].stress[3] == Approx(s12).epsilon(1e-8));
      CHECK(states[k].stress[1] == Approx(-s11).epsilon(1e-8));
    }
  }
}

TEST_CASE("Uniaxial stress: the axial stress is the flow stress at its own plastic strain, rate and temperature", "[reference]") {
  for (const double rate : {1e-3, 1e3}) {
    const auto states = follow(johnson_cook(linear, 26e9, aluminium), at_rest(2700.0), {pull(0.3, 0.3 / rate)});
    const Point& end = states.back();
    const double eps = plastic_strain(aluminium, end.hardening);
    const double theta = (end.temperature - 294.0) / 631.0;
    const double R = rate > 1.0 ? 1.0 + 0.002 * std::log(rate) : 1.0;
    CHECK(end.stress[0] == Approx((324e6 + 114e6 * std::pow(eps, 0.42)) * R * (1.0 - std::pow(theta, 1.34)))
                               .epsilon(1e-5));   // total rate for plastic rate
    CHECK(std::abs(end.stress[1]) < 1.0);
    const double plastic_work = end.energy * 2700.0 - end.stress[0] * end.stress[0] / (2.0 * 69e9);
    CHECK((end.temperature - 294.0) * 2700.0 * 896.0 / plastic_work == Approx(0.9).epsilon(3e-3));   // density changes by 0.2 %
  }
}

TEST_CASE("Adiabatic flow: for m = 1 the temperature has an elementary form, and the path agrees", "[reference]") {
  JohnsonCookConstants c = aluminium;
  c.m = 1.0;
  const double rate = 1e3, eps = 0.5, R = 1.0 + 0.002 * std::log(rate);
  const double exponent = 0.9 * R * (324e6 * eps + 114e6 * std::pow(eps, 1.42) / 1.42) / (2700.0 * 896.0 * 631.0);
  CHECK(johnson_cook_adiabatic(c, 2700.0, rate, eps).homologous_temperature == Approx(1.0 - std::exp(-exponent)).epsilon(1e-10));

  // Very stiff elastically, the path is one of constant plastic strain rate.
  const auto states = follow(johnson_cook({2700.0, 66.4e11}, 26e11, aluminium), at_rest(2700.0), {pull(0.01, 0.01 / rate)}, 1e-8);
  const Adiabatic exact = johnson_cook_adiabatic(aluminium, 2700.0, rate, plastic_strain(aluminium, states.back().hardening));
  CHECK((states.back().temperature - 294.0) / 631.0 == Approx(exact.homologous_temperature).epsilon(1e-4));
  CHECK(states.back().stress[0] == Approx(exact.flow_stress).epsilon(1e-6));
}

TEST_CASE("Mie-Grueneisen: stiffness is the slope of the pressure, and the Hugoniot is linear", "[reference]") {
  const PressureLaw eos{.reference_density = 2700.0, .sound_speed = 5386.0, .slope = 1.339, .gamma = 1.99};
  for (const double rho : {2600.0, 2750.0, 3300.0}) {
    const double h = 1e-4 * rho;
    CHECK(eos.stiffness(rho) ==
          Approx(rho * (eos.pressure(rho + h, 1e4) - eos.pressure(rho - h, 1e4)) / (2.0 * h)).epsilon(1e-6));
  }
  const double u = 1500.0, U = 5386.0 + 1.339 * u;
  CHECK(eos.pressure(2700.0 * U / (U - u), 0.5 * u * u) == Approx(2700.0 * U * u).epsilon(1e-12));
}

TEST_CASE("Cones: tabulated constants, and strengths that Mohr-Coulomb has where a cone is made to have them", "[reference]") {
  const double phi = 28.0 * degree, c = 5e3;
  CHECK(cone("bui", c, phi, 0.0).alpha == Approx(0.151041).epsilon(1e-5));
  CHECK(cone("compression", c, phi, 0.0).k == Approx(6043.4).epsilon(1e-5));
  CHECK(cone("plane_strain", c, phi, 0.0).alpha == Approx(std::sin(phi) / 3.0).epsilon(1e-12));
  CHECK(cone("plane_strain", c, phi, phi).alpha == Approx(cone("bui", c, phi, 0.0).alpha).epsilon(1e-12));
  CHECK(plane_strain_friction(cone("bui", c, phi, 0.0)) / degree == Approx(26.94).epsilon(2e-4));
  CHECK(plane_strain_cohesion(cone("bui", c, phi, 0.0)) == Approx(4780.0).epsilon(1e-3));
  CHECK(triaxial_compression_strength(cone("bui", c, phi, 0.0), 0.0) == Approx(9995.0).epsilon(1e-4));
  // Mohr-Coulomb: s1 - s3 = (2 c cos(phi) + 2 p sin(phi))/(1 - sin(phi)), and with (1 + sin(phi)) in extension.
  const double p = 20e3, mohr = 2.0 * c * std::cos(phi) + 2.0 * p * std::sin(phi);
  CHECK(triaxial_compression_strength(cone("compression", c, phi, 0.0), p) ==
        Approx(mohr / (1.0 - std::sin(phi))).epsilon(1e-12));
  CHECK(triaxial_extension_strength(cone("extension", c, phi, 0.0), p) == Approx(mohr / (1.0 + std::sin(phi))).epsilon(1e-12));
  CHECK(2.0 * plane_strain_strength(cone("plane_strain", c, phi, 0.1), p) == Approx(mohr / (1.0 - std::sin(phi))).epsilon(1e-10));
}

TEST_CASE("Drucker-Prager: the path ends at the strength, dilating by the flow rule", "[reference]") {
  const double K = 1.5e6, G = 0.9e6, p = 30e3;
  const Cone c = cone("plane_strain", 5e3, 28.0 * degree, 8.0 * degree);
  Point start = at_rest(1540.0);
  for (std::size_t i = 0; i < 3; ++i) start.stress[i] = -p;
  Leg squeeze{.duration = 1.0, .samples = 2, .stress_controlled = {false, true, false, false, false, false}};
  squeeze.rate[0] = -0.8;   // the out-of-plane stress finds its value exponentially
  const auto states = follow(drucker_prager(K, G, c.alpha, c.k, c.beta), start, {squeeze});
  CHECK((states[1].stress[1] - states[1].stress[0]) / 2.0 == Approx(plane_strain_strength(c, p)).epsilon(1e-8));
  // At constant stress all strain is plastic: d(volume) = 3 beta lambda and equivalent plastic strain lambda/sqrt(3).
  const double volume = std::log(states[0].density / states[1].density);
  CHECK(volume / (states[1].hardening - states[0].hardening) == Approx(3.0 * std::sqrt(3.0) * c.beta).epsilon(1e-6));
}
