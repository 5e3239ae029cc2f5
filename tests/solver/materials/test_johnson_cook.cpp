#include <cmath>

#include "tests/catch.hpp"
#include "tests/solver/materials/points.hpp"

using namespace furrow;
using test::RandomMotion;

namespace {

JohnsonCook<LinearEos> aluminium(double taylor_quinney = 0.9) {
  return {{2700.0, 66.4e9}, 26e9, test::aluminium_strength(), 875.0, taylor_quinney};
}

JohnsonCookStrength iron_strength() { return {175e6, 380e6, 0.32, 0.060, 0.55, 1.0, 294.0, 1811.0}; }

Increment stretch(double axial, double lateral, double dt) {
  Tensor de = Tensor::Zero();
  de.diagonal() << axial, lateral, lateral;
  return {de, Tensor::Zero(), dt};
}

}  // namespace

TEST_CASE("Flow stress by hand", "[johnson_cook]") {
  const JohnsonCookStrength s = test::aluminium_strength();
  const double T = 0.5 * (294.0 + 925.0);
  CHECK(s.flow_stress(0.0, 1.0, 294.0).value == Approx(324e6));
  CHECK(s.flow_stress(1.0, 1.0, 294.0).value == Approx(438e6));
  CHECK(s.flow_stress(1.0, 1e3, 294.0).value == Approx(438e6 * (1.0 + 0.002 * std::log(1e3))));
  CHECK(s.flow_stress(1.0, 1e3, T).value == Approx(438e6 * (1.0 + 0.002 * std::log(1e3)) * (1.0 - std::pow(0.5, 1.34))));
  SECTION("Slower than the reference rate, colder than the reference temperature, hotter than melting") {
    CHECK(s.flow_stress(0.2, 1e-3, 294.0).value == s.flow_stress(0.2, 1.0, 294.0).value);
    CHECK(s.flow_stress(0.2, 1.0, 77.0).value == s.flow_stress(0.2, 1.0, 294.0).value);
    CHECK(s.flow_stress(0.2, 1.0, 1000.0).value == 0.0);
  }
  SECTION("Derivatives are those of the value") {
    for (const double eps_p : {0.01, 0.4})
      for (const double rate : {3.0, 1e4})
        for (const double temperature : {350.0, 800.0}) {
          const auto at = s.flow_stress(eps_p, rate, temperature);
          const double h = 1e-5;
          const auto by = [&](auto f) { return (f(h) - f(-h)) / (2.0 * h); };
          CHECK(at.by_strain ==
                Approx(by([&](double d) { return s.flow_stress(eps_p + d, rate, temperature).value; })).epsilon(1e-5));
          CHECK(at.by_log_rate ==
                Approx(by([&](double d) { return s.flow_stress(eps_p, rate * std::exp(d), temperature).value; })).epsilon(1e-5));
          CHECK(at.by_temperature ==
                Approx(by([&](double d) { return s.flow_stress(eps_p, rate, temperature + d).value; })).epsilon(1e-4));
        }
  }
}

TEST_CASE("Powers that are moved are those at the other place", "[johnson_cook]") {
  double worst = 0.0;
  const auto compare = [&](double a, double b) { worst = std::max(worst, std::abs(a - b) / std::max(std::abs(b), 1e-300)); };
  for (const JohnsonCookStrength& s : {test::aluminium_strength(), iron_strength()})
    for (const double eps_p : {0.0, 1e-6, 0.03, 1.7})
      for (const double T : {77.0, 294.0, 294.1, 600.0, 924.0, 2000.0})
        for (const double share : {0.0, 1e-9, 1e-3, 0.0199, 0.0201, 0.5, 40.0})
          for (const double rise : {-30.0, -1.0, 0.0, 1e-6, 0.7, 5.0, 300.0}) {
            const double x = share * std::max(eps_p, 1e-4);
            const auto moved = s.moved(s.powers(eps_p, T), x, T + rise), there = s.powers(eps_p + x, T + rise);
            compare(moved.hardened, there.hardened);
            compare(moved.soft, there.soft);
            CHECK(moved.theta == there.theta);
          }
  CHECK(worst < 4e-15);
}

TEST_CASE("The return ends on the yield surface of the end of the step, for any input", "[johnson_cook]") {
  double worst = 0.0;
  int plastic = 0;
  for (unsigned seed = 0; seed < 20000; ++seed) {
    RandomMotion motion(seed);
    const bool iron = seed % 2 == 0;
    const JohnsonCook<LinearEos> law{{iron ? 7890.0 : 2700.0, iron ? 164e9 : 66.4e9},
                                     iron ? 80e9 : 26e9,
                                     iron ? iron_strength() : test::aluminium_strength(),
                                     452.0,
                                     seed % 3 == 0 ? 0.0 : 0.9};
    MaterialState state = law.initial_state();
    state.plastic_strain = seed % 5 == 0 ? 0.0 : std::exp(3.0 * motion.number() - 4.0);
    state.temperature = seed % 7 == 0 ? 294.0 : 294.0 + 400.0 * motion.number();
    state.stress = 1e8 * motion.symmetric();
    const double dt = std::exp(5.0 * motion.number() - 14.0);
    const Increment increment{std::exp(1.5 * motion.number() - 6.0) * motion.symmetric(), Tensor::Zero(), dt};
    const MaterialState next = advance(law, state, increment);
    REQUIRE(next.stress.allFinite());
    const double x = next.plastic_strain - state.plastic_strain;
    if (x <= 0.0) continue;
    if (state.plastic_strain > 0.0 && x < 1e-6 * state.plastic_strain) continue;   // x has lost its digits in the sum
    ++plastic;
    const double q = von_mises(next.stress);
    const double q_trial = std::sqrt(3.0 * j2(elastic_deviator(state.stress, law.shear_modulus, increment)));
    worst =
        std::max(worst, std::abs(q - law.strength.flow_stress(next.plastic_strain, x / dt, next.temperature).value) / q_trial);
  }
  CHECK(plastic > 10000);
  CHECK(worst < 1e-11);   // 1e-12 of the solver; x is known to 1e-10 of itself, of which the flow stress sees C
}

TEST_CASE("Adiabatic flow turns the share beta of the plastic work into heat", "[johnson_cook]") {
  const auto law = aluminium(0.9);
  MaterialState state = law.initial_state();
  for (int k = 0; k < 1000; ++k) state = advance(law, state, stretch(5e-4, -2.5e-4, 5e-7));
  REQUIRE(state.plastic_strain > 0.45);
  CHECK((state.temperature - 294.0) * 875.0 / state.plastic_work == Approx(0.9).epsilon(1e-3));   // density changes elastically
  MaterialState cold = aluminium(0.0).initial_state();
  for (int k = 0; k < 1000; ++k) cold = advance(aluminium(0.0), cold, stretch(5e-4, -2.5e-4, 5e-7));
  CHECK(cold.temperature == 294.0);
  CHECK(von_mises(cold.stress) > von_mises(state.stress));
}

TEST_CASE("Molten material carries no shear", "[johnson_cook]") {
  const auto law = aluminium();
  MaterialState state = law.initial_state();
  state.temperature = 930.0;
  state = advance(law, state, stretch(1e-3, 0.0, 1e-6));
  CHECK(von_mises(state.stress) < 1e-6 * law.eos.bulk_modulus * 1e-3);
  CHECK(state.stress.trace() > 0.0);
}

TEST_CASE("A failed point bears pressure and nothing else", "[johnson_cook]") {
  auto law = aluminium();
  law.damage = test::aluminium_damage();
  MaterialState state = law.initial_state();
  for (int k = 0; k < 1000 && state.damage < 1.0; ++k) state = advance(law, state, stretch(1e-3, -0.45e-3, 1e-6));
  REQUIRE(state.damage == 1.0);
  CHECK(state.fracture_onset == 1.0);
  CHECK(von_mises(state.stress) < 1e-6);
  CHECK(state.stress.trace() <= 0.0);
  const double broken_at = state.plastic_strain;

  state = advance(law, state, stretch(0.05, 0.0, 1e-6));   // pulled apart
  CHECK(state.stress.norm() == 0.0);
  state = advance(law, state, stretch(-0.3, 0.0, 1e-6));   // pressed together again
  CHECK(von_mises(state.stress) < 1e-6);
  CHECK(-state.stress.trace() / 3.0 == Approx(law.eos.cold_pressure(state.density)));
  CHECK(state.stress.trace() < 0.0);
  CHECK(state.plastic_strain == broken_at);

  SECTION("As the paper prints it, tension stays") {
    law.damage->keeps_tension = true;
    MaterialState printed = law.initial_state();
    printed.damage = printed.fracture_onset = 1.0;
    printed = advance(law, printed, stretch(1e-3, 0.0, 1e-6));
    CHECK(printed.stress.trace() > 0.0);
    CHECK(von_mises(printed.stress) == 0.0);
  }
}

TEST_CASE("Fracture strain: the fit, its clip and its floor", "[johnson_cook]") {
  const JohnsonCookDamage d = test::aluminium_damage();
  const auto eps_f = [&](double s) { return d.fracture_strain({s, 1.0, 0.0, 0.1}); };
  CHECK(eps_f(0.0) == Approx(0.680).margin(5e-4));   // 1.45 - 0.77
  CHECK(eps_f(1.0 / 3.0) == Approx(0.470).margin(5e-4));
  CHECK(eps_f(1.0) == Approx(0.136).margin(5e-4));
  CHECK(eps_f(1.3) == eps_f(1.0));
  CHECK(eps_f(-5.0) == Approx(0.926).margin(5e-4));
  JohnsonCookDamage wide = d;
  wide.highest_triaxiality = 3.0;
  CHECK(wide.fracture_strain({2.0, 1.0, 0.0, 0.1}) == 0.05);
  CHECK(d.fracture_strain({0.0, 1.0, 0.5, 0.1}) == Approx(0.68 * 1.8));
}

TEST_CASE("With a softening length the energy of fracture does not depend on the spacing", "[johnson_cook]") {
  const auto energy_per_area = [](double spacing, double length) {
    auto law = aluminium(0.0);
    law.damage = test::aluminium_damage();
    law.damage->softening_length = length;
    law.damage->spacing = spacing;
    MaterialState state = law.initial_state();
    double at_onset = -1.0;
    for (int k = 0; k < 2000000 && state.damage < 1.0; ++k) {
      state = advance(law, state, stretch(1e-5, -0.5e-5, 1e-8));   // simple enough: s* stays 0
      if (at_onset < 0.0 && state.fracture_onset == 1.0) at_onset = state.plastic_work;
    }
    REQUIRE(state.damage == 1.0);
    return (state.plastic_work - at_onset) * state.density * spacing;
  };
  const double coarse = energy_per_area(1e-3, 5e-4), fine = energy_per_area(2.5e-4, 5e-4);
  CHECK(fine == Approx(coarse).epsilon(0.1));   // the metal hardens a little more over the longer fine-grained path
  CHECK(coarse == Approx(0.5 * 420e6 * 0.68 * 5e-4).epsilon(0.1));
}

TEST_CASE("The paper's printed forms differ where they are said to", "[johnson_cook]") {
  const auto end = [](JohnsonCookForm form) {
    auto law = aluminium();
    law.form = form;
    MaterialState state = law.initial_state();
    for (int k = 0; k < 200; ++k) state = advance(law, state, stretch(1e-3, -0.5e-3, 1e-6));
    return state;
  };
  const MaterialState right = end({});
  SECTION("Eq. 9: no stress power, no heat") {
    const MaterialState printed = end({false, true, true});
    CHECK(printed.temperature == 294.0);
    CHECK(std::abs(printed.internal_energy) < 1e-6 * right.internal_energy);
    CHECK(von_mises(printed.stress) > von_mises(right.stress));
  }
  SECTION("Eq. 19: without the root the shear stress vanishes") {
    CHECK(von_mises(end({true, false, true}).stress) < 1e-6 * von_mises(right.stress));
  }
  SECTION("Eq. 21: the total rate differs little from the plastic one in steady flow") {
    const MaterialState printed = end({true, true, false});
    CHECK(von_mises(printed.stress) != von_mises(right.stress));
    CHECK(von_mises(printed.stress) == Approx(von_mises(right.stress)).epsilon(1e-4));
  }
}
