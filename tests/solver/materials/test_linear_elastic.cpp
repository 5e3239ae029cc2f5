// Linear elasticity in rate form against Hooke's law, closed paths and closed forms.
#include "tests/catch.hpp"

#include <numbers>

#include "solver/materials/materials.hpp"
#include "tests/solver/cloud.hpp"

namespace furrow {
namespace {

const LinearElastic steel = LinearElastic::from_young(7850.0, 210e9, 0.3);

/// `steps` equal steps of a constant velocity gradient that lasts one second in all.
MaterialState deform(MaterialState state, const Tensor& L, int steps) {
  const double dt = 1.0 / steps;
  for (int k = 0; k < steps; ++k) state = advance(steel, state, {symmetric_part(L) * dt, skew_part(L) * dt, dt});
  return state;
}

}  // namespace

TEST_CASE("moduli from Young's modulus and Poisson's ratio", "[materials]") {
  CHECK(steel.bulk_modulus == Approx(175e9));
  CHECK(steel.shear_modulus == Approx(80.769230769e9));
  const MaterialState rest = steel.initial_state();
  CHECK(rest.stress.norm() == 0.0);
  CHECK(rest.density == 7850.0);
  // Longitudinal speed from E and nu: c^2 = E (1 - nu)/(rho (1 + nu)(1 - 2 nu)).
  CHECK(steel.sound_speed(rest) == Approx(std::sqrt(210e9 * 0.7 / (7850.0 * 1.3 * 0.4))));
}

TEST_CASE("small uniaxial stress is Hooke's law", "[materials]") {
  const double e = 1e-7;
  Tensor strain = Tensor::Zero();
  strain.diagonal() << e, -0.3 * e, -0.3 * e;
  const MaterialState state = deform(steel.initial_state(), strain, 1);
  CHECK(state.stress(0, 0) == Approx(210e9 * e).epsilon(2e-7));   // density, not strain, makes the pressure: second order in e
  CHECK(std::abs(state.stress(1, 1)) < 2e-7 * state.stress(0, 0));
  CHECK(state.internal_energy == Approx(0.5 * 210e9 * e * e / 7850.0).epsilon(1e-6));
  CHECK(steel.stored_energy(state) == Approx(state.internal_energy).epsilon(1e-6));
}

TEST_CASE("compression follows the equation of state, and the work is what is stored", "[materials]") {
  const MaterialState state = deform(steel.initial_state(), -0.02 * Tensor::Identity(), 400);
  CHECK(state.density == Approx(7850.0 * std::exp(0.06)));
  CHECK(state.stress(1, 1) == Approx(-175e9 * (std::exp(0.06) - 1.0)));
  CHECK(von_mises(state.stress) < 1.0);
  CHECK(state.internal_energy == Approx(steel.stored_energy(state)).epsilon(1e-5));   // trapezoidal in 400 steps
}

TEST_CASE("simple shear under the Jaumann rate: s12 = G sin(gamma), s11 = G (1 - cos gamma)", "[materials]") {
  const auto error = [](int steps) {
    double worst = 0.0;
    for (const double gamma : {0.1, 1.0, std::numbers::pi / 2.0, 3.0}) {
      Tensor L = Tensor::Zero();
      L(0, 1) = gamma;
      const Tensor s = deform(steel.initial_state(), L, steps).stress / steel.shear_modulus;
      worst = std::max({worst, std::abs(s(0, 1) - std::sin(gamma)), std::abs(s(0, 0) - (1.0 - std::cos(gamma))),
                        std::abs(s(1, 1) + 1.0 - std::cos(gamma)), std::abs(s(2, 2)), std::abs(s(0, 2))});
    }
    return worst;
  };
  CHECK(error(100) < 1e-3);
  CHECK(error(100) / error(200) == Approx(4.0).epsilon(0.02));   // second order in dt
}

TEST_CASE("stress turns with the body and neither grows nor shrinks", "[materials]") {
  MaterialState state = steel.initial_state();
  state.stress << 1e8, 2e7, -3e7, 2e7, -5e7, 1e7, -3e7, 1e7, 4e7;
  const Tensor before = state.stress, spin = cross(1.0, -2.0, 0.5);
  state = deform(state, spin, 50);
  const Tensor R = rotation(spin);
  // The law keeps the deviator and sets the pressure by density, here zero.
  CHECK((state.stress - rotated(deviator(before), R)).norm() < 1e-12 * before.norm());
  CHECK(state.density == 7850.0);
}

TEST_CASE("there and back again", "[materials]") {
  Tensor L;
  L << 0.02, 0.05, -0.01, 0.00, -0.03, 0.02, 0.04, 0.01, 0.01;
  const MaterialState out = deform(steel.initial_state(), L, 200), back = deform(out, -L, 200);
  CHECK(back.stress.norm() < 1e-12 * out.stress.norm());
  CHECK(back.density == Approx(7850.0).epsilon(1e-13));
}

}  // namespace furrow
