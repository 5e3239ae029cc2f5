// What must hold for every law of the list.
#include "tests/catch.hpp"
#include "tests/solver/materials/points.hpp"

using namespace furrow;
using test::RandomMotion;

namespace {

// Strain of a step that carries each law well into its plastic range within some steps.
double step_size(const LinearElastic&) { return 1e-3; }
double step_size(const DruckerPrager&) { return 3e-3; }
template <class M>
double step_size(const M&) {
  return 2e-3;
}

}  // namespace

TEST_CASE("A law does not see from where it is looked at", "[materials]") {
  for (const AnyMaterial& any : test::laws())
    std::visit(
        [](const auto& law) {
          INFO(law.name);
          RandomMotion motion(3);
          const Tensor R = motion.turn();
          MaterialState state = law.initial_state(), turned = state;
          const double size = step_size(law);
          for (int k = 0; k < 40; ++k) {
            const Tensor de = size * motion.symmetric(), dw = size * skew_part(motion.tensor());
            state = advance(law, state, {de, dw, 1e-6});
            turned = advance(law, turned, {rotated(de, R), rotated(dw, R), 1e-6});
          }
          const double scale = state.stress.norm() + law.sound_speed(state) * law.sound_speed(state) * state.density * 1e-3;
          CHECK((rotated(state.stress, R) - turned.stress).norm() / scale < 1e-11);
          CHECK(turned.plastic_strain == Approx(state.plastic_strain).epsilon(1e-10));
          CHECK(turned.internal_energy == Approx(state.internal_energy).epsilon(1e-10));
          CHECK(turned.temperature == Approx(state.temperature).epsilon(1e-12));
          CHECK(turned.damage == Approx(state.damage).epsilon(1e-10));
        },
        any);
}

TEST_CASE("A point that only spins keeps its stress in its own frame, and its energy", "[materials]") {
  for (const AnyMaterial& any : test::laws())
    std::visit(
        [](const auto& law) {
          INFO(law.name);
          RandomMotion motion(5);
          Tensor load = 1e-5 * motion.symmetric();
          load -= 2e-4 * Tensor::Identity();   // inside every cone
          MaterialState state = advance(law, law.initial_state(), {load, Tensor::Zero(), 1e-6});
          const MaterialState before = state;
          const Tensor spin = 0.1 * skew_part(motion.tensor());
          Tensor R = Tensor::Identity();
          for (int k = 0; k < 100; ++k) {
            state = advance(law, state, {Tensor::Zero(), spin, 1e-6});
            R = rotation(spin) * R;
          }
          CHECK((state.stress - rotated(before.stress, R)).norm() < 1e-12 * before.stress.norm());
          CHECK(state.internal_energy == Approx(before.internal_energy).epsilon(1e-12));
          CHECK(state.density == before.density);
          CHECK(state.plastic_strain == before.plastic_strain);
        },
        any);
}

TEST_CASE("Plastic strain and plastic work never fall, and temperature never does", "[materials]") {
  for (const AnyMaterial& any : test::laws())
    std::visit(
        [](const auto& law) {
          INFO(law.name);
          double most = 0.0;
          for (unsigned seed = 0; seed < 200; ++seed) {
            RandomMotion motion(seed);
            MaterialState state = law.initial_state();
            for (int k = 0; k < 30; ++k) {
              const MaterialState next = advance(law, state, {step_size(law) * motion.symmetric(), Tensor::Zero(), 1e-6});
              REQUIRE(next.stress.allFinite());
              REQUIRE(next.plastic_strain >= state.plastic_strain);
              // Soil at its apex for c = 0 dissipates nothing, up to round-off of what it has stored.
              REQUIRE(next.plastic_work >= state.plastic_work - 1e-15 * (1.0 + state.plastic_work));
              REQUIRE(next.temperature >= state.temperature);
              REQUIRE(next.damage >= state.damage);
              REQUIRE(next.damage <= 1.0);
              state = next;
            }
            most = std::max(most, state.plastic_strain);
          }
          const bool flows = !std::is_same_v<std::decay_t<decltype(law)>, LinearElastic>;
          CHECK((most > 0.0) == flows);   // or nothing was tested
        },
        any);
}

TEST_CASE("Below yield every law is Hooke's", "[materials]") {
  for (const AnyMaterial& any : test::laws())
    std::visit(
        [](const auto& law) {
          INFO(law.name);
          const MaterialState start = law.initial_state();
          // Its own moduli, from its speed of sound and a small shear.
          Tensor shear = Tensor::Zero();
          shear(0, 1) = shear(1, 0) = 1e-8;
          const double G = advance(law, start, {shear, Tensor::Zero(), 1e-6}).stress(0, 1) / 2e-8;
          const double c = law.sound_speed(start);
          const LinearElastic hooke{start.density, start.density * c * c - 4.0 / 3.0 * G, G};
          RandomMotion motion(11);
          MaterialState state = start, linear = start;
          for (int k = 0; k < 10; ++k) {
            const Tensor de = 1e-8 * motion.symmetric();
            state = advance(law, state, {de, Tensor::Zero(), 1e-3});
            linear = advance(hooke, linear, {de, Tensor::Zero(), 1e-3});
          }
          CHECK((state.stress - linear.stress).norm() <
                1e-6 * linear.stress.norm());   // laws differ by terms of the square of 1e-8
          CHECK(state.plastic_strain == 0.0);
          CHECK(state.internal_energy == Approx(linear.internal_energy).epsilon(1e-5));
          CHECK(law.stored_energy(state) == Approx(hooke.stored_energy(linear)).epsilon(1e-5));
        },
        any);
}

TEST_CASE("At constant volume energy is what is stored and what is dissipated, ever more so with smaller steps", "[materials]") {
  for (const AnyMaterial& any : test::laws())
    std::visit(
        [](const auto& law) {
          INFO(law.name);
          const auto gap = [&](int n) {
            MaterialState state = law.initial_state();
            Tensor way = Tensor::Zero();
            way.diagonal() << -0.02, 0.012, 0.008;
            way(0, 1) = way(1, 0) = 0.01;
            for (int k = 0; k < n; ++k) state = advance(law, state, {way / n, Tensor::Zero(), 1e-2 / n});
            return std::abs(state.internal_energy - law.stored_energy(state) - state.plastic_work) / state.internal_energy;
          };
          const double coarse = gap(400), fine = gap(1600);
          CHECK(fine < 1e-3);
          CHECK((fine < 0.3 * coarse || fine < 1e-12));
        },
        any);
}

TEST_CASE("Slow compression and release store the cold energy, and give it back", "[materials]") {
  for (const AnyMaterial& any : test::laws())
    std::visit(
        [](const auto& law) {
          if constexpr (requires { law.eos; }) {
            INFO(law.name);
            const auto squeezed = [&](double logarithmic_strain, int n) {
              MaterialState state = law.initial_state();
              const Tensor de = logarithmic_strain / (3.0 * n) * Tensor::Identity();
              for (int k = 0; k < n; ++k) state = advance(law, state, {de, Tensor::Zero(), 1e-6});
              return state;
            };
            for (const double strain : {-0.15, 0.02}) {
              const MaterialState coarse = squeezed(strain, 50), fine = squeezed(strain, 200);
              const double e = law.eos.cold_energy(fine.density);
              CHECK(fine.internal_energy == Approx(e).epsilon(1e-5));
              CHECK(std::abs(fine.internal_energy - e) < std::abs(coarse.internal_energy - e) / 12.0);   // second order: 1/16
              MaterialState back = fine;
              for (int k = 0; k < 200; ++k)
                back = advance(law, back, {-strain / 600.0 * Tensor::Identity(), Tensor::Zero(), 1e-6});
              CHECK(std::abs(back.internal_energy) < 1e-12 * e);
              CHECK(back.stress.norm() < 1e-12 * fine.stress.norm());
            }
          }
        },
        any);
}

TEST_CASE("The speed of sound is that of a small longitudinal strain", "[materials]") {
  for (const AnyMaterial& any : test::laws())
    std::visit(
        [](const auto& law) {
          INFO(law.name);
          MaterialState state = law.initial_state();
          Tensor de = Tensor::Zero();
          de(0, 0) = -1e-6;
          const MaterialState next = advance(law, state, {de, Tensor::Zero(), 1e-3});
          CHECK(std::sqrt(next.stress(0, 0) / de(0, 0) / state.density) == Approx(law.sound_speed(state)).epsilon(1e-4));
        },
        any);
}
