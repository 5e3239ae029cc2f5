#include <cmath>

#include "tests/catch.hpp"
#include "tests/solver/materials/points.hpp"

using namespace furrow;

namespace {

template <class Eos>
double numerical_stiffness(const Eos& eos, double rho, double p) {
  // Along the isentrope: de = p drho/rho^2.
  const double h = 1e-5 * rho;
  const double a = eos.pressure_per_energy();
  const auto pressure = [&](double step) {
    const double e = (p - eos.cold_pressure(rho)) / std::max(a, 1e-300);
    return eos.cold_pressure(rho + step) + (a > 0.0 ? a * (e + p * step / (rho * rho)) : 0.0);
  };
  return rho * (pressure(h) - pressure(-h)) / (2.0 * h);
}

}  // namespace

TEST_CASE("A single step from rest ends on the Hugoniot", "[eos]") {
  const J2Plastic<MieGrueneisen> fluid{test::aluminium_eos(), 1.0, 0.0};
  for (const double u_p : {10.0, 500.0, 3000.0}) {
    const double U_s = fluid.eos.sound_speed + fluid.eos.slope * u_p;
    Tensor de = Tensor::Zero();
    de(0, 0) = std::log1p(-u_p / U_s);   // mass across the shock
    const MaterialState state = advance(fluid, fluid.initial_state(), {de, Tensor::Zero(), 1e-9});
    CHECK(-state.stress.trace() / 3.0 == Approx(2700.0 * U_s * u_p).epsilon(1e-9));
    CHECK(state.internal_energy == Approx(0.5 * u_p * u_p).epsilon(1e-9));
  }
}

TEST_CASE("Stiffness is the slope of the pressure along the isentrope", "[eos]") {
  for (const bool squared : {true, false}) {
    MieGrueneisen eos = test::aluminium_eos();
    eos.squared_denominator = squared;
    for (const double rho : {2500.0, 2650.0, 2800.0, 3300.0})
      for (const double p : {-1e9, 0.0, 2e10})
        CHECK(eos.isentropic_stiffness(rho, p) == Approx(numerical_stiffness(eos, rho, p)).epsilon(1e-6));
  }
  const LinearEos linear{2700.0, 66.4e9};
  CHECK(linear.isentropic_stiffness(2900.0, 0.0) == Approx(numerical_stiffness(linear, 2900.0, 0.0)).epsilon(1e-6));
}

TEST_CASE("Pressure is continuous where compression turns into tension, and NaN beyond the pole", "[eos]") {
  const MieGrueneisen eos = test::aluminium_eos();
  CHECK(eos.cold_pressure(2700.0) == 0.0);
  CHECK(eos.cold_pressure(2700.0 * (1.0 - 1e-9)) == Approx(-eos.cold_pressure(2700.0 * (1.0 + 1e-9))).epsilon(1e-6));
  CHECK(std::isnan(eos.cold_pressure(2700.0 * (1.0 + 1.01 / 0.34))));
  CHECK(std::isfinite(eos.cold_pressure(2700.0 * (1.0 + 0.99 / 0.34))));
}

TEST_CASE("Eq. 17 as printed is softer in compression and the same in tension", "[eos]") {
  const MieGrueneisen right = test::aluminium_eos();
  MieGrueneisen printed = right;
  printed.squared_denominator = false;
  const double eta = 0.1;
  CHECK(right.cold_pressure(2970.0) / printed.cold_pressure(2970.0) == Approx(1.0 / (1.0 - 0.34 * eta)));
  CHECK(right.cold_pressure(2600.0) == printed.cold_pressure(2600.0));
}
