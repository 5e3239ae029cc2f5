#include <cmath>
#include <numbers>

#include "tests/catch.hpp"
#include "tests/solver/materials/points.hpp"

using namespace furrow;
using test::RandomMotion;

namespace {

constexpr double degree = std::numbers::pi / 180.0;

double in_energy(const DruckerPrager& law, const Tensor& a, const Tensor& b) {   // a : C^-1 : b
  return double_contraction(deviator(a), deviator(b)) / (2.0 * law.shear_modulus) +
         a.trace() * b.trace() / (9.0 * law.bulk_modulus);
}

DruckerPrager associated(double tension_limit) {
  auto law = test::soil();
  law.cone = DruckerPragerCone::plane_strain(5e3, 28.0 * degree, 28.0 * degree);
  law.tension_limit = tension_limit;
  return law;
}

}  // namespace

TEST_CASE("Cones have the tabulated constants", "[drucker_prager]") {
  const double phi = 28.0 * degree, c = 5e3;
  const auto bui = DruckerPragerCone::bui(c, phi, 0.0);
  CHECK(bui.alpha == Approx(0.151041).epsilon(1e-5));
  CHECK(bui.k == Approx(4261.0).epsilon(1e-4));
  CHECK(bui.apex() == Approx(9404.0).epsilon(1e-4));
  CHECK(std::asin(3.0 * bui.alpha) / degree == Approx(26.94).epsilon(1e-3));
  const auto compression = DruckerPragerCone::compression(c, phi, 0.0);
  CHECK(compression.alpha == Approx(0.214224).epsilon(1e-5));
  CHECK(compression.k == Approx(6043.4).epsilon(1e-4));
  CHECK(DruckerPragerCone::extension(c, phi, 0.0).alpha == Approx(0.156248).epsilon(1e-5));
  const auto plane = DruckerPragerCone::plane_strain(c, phi, 0.0);
  CHECK(plane.alpha == Approx(std::sin(phi) / 3.0));
  CHECK(plane.k == Approx(c * std::cos(phi)));
  const auto both = DruckerPragerCone::plane_strain(c, phi, phi);
  CHECK(both.alpha == Approx(bui.alpha));
  CHECK(both.k == Approx(bui.k));
  CHECK(both.beta == Approx(both.alpha));
}

TEST_CASE("Associated return is the nearest admissible stress in the energy of elasticity", "[drucker_prager]") {
  int cone = 0, corner = 0, cut_off = 0;
  for (const double limit : {std::numeric_limits<double>::infinity(), 3e3}) {
    const DruckerPrager law = associated(limit);
    for (unsigned seed = 0; seed < 400; ++seed) {
      RandomMotion motion(seed);
      const double shear = seed % 2 ? 0.02 : 0.001;
      const Tensor de = shear * motion.symmetric() + 0.02 * motion.number() * Tensor::Identity();
      const Tensor trial = 2.0 * law.shear_modulus * deviator(de) + law.bulk_modulus * de.trace() * Tensor::Identity();
      const MaterialState next = advance(law, law.initial_state(), {de, Tensor::Zero(), 1.0});
      const double scale = trial.norm();
      REQUIRE(law.yield_function(next.stress) <= 1e-12 * scale);
      REQUIRE(next.stress.trace() <= law.cut_off() + 1e-12 * scale);
      if (next.plastic_strain == 0.0) continue;
      const bool at_cut_off = next.stress.trace() > law.cut_off() - 1e-9 * scale;
      const bool on_cone = law.yield_function(next.stress) > -1e-9 * scale;
      ++(at_cut_off ? (on_cone ? corner : cut_off) : cone);
      for (int k = 0; k < 50; ++k) {   // any admissible stress
        const double I1 = law.cut_off() - 1e4 * std::abs(motion.number());
        Tensor s = deviator(motion.symmetric());
        s *= (law.cone.k - law.cone.alpha * I1) * (k % 2 ? 1.0 : std::abs(std::sin(motion.number()))) / std::sqrt(j2(s));
        const Tensor other = s + I1 / 3.0 * Tensor::Identity();
        REQUIRE(in_energy(law, trial - next.stress, other - next.stress) <= 1e-12 * in_energy(law, trial, trial));
      }
    }
  }
  CHECK(cone > 50);
  CHECK(corner > 50);
  CHECK(cut_off > 5);
}

TEST_CASE("Non-associated return: what is taken off is along the flow at the stress that is reached", "[drucker_prager]") {
  const DruckerPrager law = test::soil(5.0 * degree);
  int cone = 0, apex = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    RandomMotion motion(seed);
    const Tensor de = 0.01 * motion.symmetric() - 0.005 * Tensor::Identity();
    const MaterialState next = advance(law, law.initial_state(), {de, Tensor::Zero(), 1.0});
    if (next.plastic_strain == 0.0) continue;
    const Tensor elastic_part =
        deviator(next.stress) / (2.0 * law.shear_modulus) + next.stress.trace() / (9.0 * law.bulk_modulus) * Tensor::Identity();
    const Tensor flow = de - elastic_part;
    const Tensor s = deviator(next.stress);
    const double J = std::sqrt(j2(s));
    const double lambda = std::sqrt(2.0) * deviator(flow).norm();   // flow = lambda (s/(2 sqrt J2) + beta I)
    if (J > 1e-9 * law.cone.k) {
      ++cone;
      CHECK((flow - lambda * (s / (2.0 * J) + law.cone.beta * Tensor::Identity())).norm() < 1e-12);
      CHECK(std::abs(law.yield_function(next.stress)) < 1e-9 * law.cone.k);
    } else {   // at the apex any flow whose volume grows at least as on the cone
      ++apex;
      CHECK(flow.trace() >= 3.0 * law.cone.beta * lambda - 1e-12);
      CHECK(next.stress.trace() == Approx(3.0 * law.cone.apex()));
    }
  }
  CHECK(cone > 50);
  CHECK(apex > 20);
}

TEST_CASE("Without friction the cone is a cylinder with no apex", "[drucker_prager]") {
  DruckerPrager law = test::soil();
  law.cone = DruckerPragerCone::plane_strain(5e3, 0.0, 0.0);
  Tensor de = 0.05 * Tensor::Identity();
  de(0, 1) = de(1, 0) = 0.05;
  const MaterialState next = advance(law, law.initial_state(), {de, Tensor::Zero(), 1.0});
  CHECK(next.stress(0, 1) == Approx(5e3));
  CHECK(next.stress.trace() == Approx(9.0 * 0.05 * law.bulk_modulus));
}

TEST_CASE("Without cohesion tension is gone, and compression comes back", "[drucker_prager]") {
  DruckerPrager law = test::soil();
  law.cone = DruckerPragerCone::bui(0.0, 19.8 * degree, 0.0);
  MaterialState state = advance(law, law.initial_state(), {0.01 * Tensor::Identity(), Tensor::Zero(), 1.0});
  CHECK(state.stress.norm() == 0.0);
  state = advance(law, state, {-0.01 * Tensor::Identity(), Tensor::Zero(), 1.0});
  CHECK(state.stress.trace() == Approx(-9.0 * 0.01 * law.bulk_modulus));
}

TEST_CASE("The rate form tends to the return map, Eq. 11 as printed does not", "[drucker_prager]") {
  const auto end = [](DruckerPragerUpdate update, int n) {
    DruckerPrager law = test::soil(5.0 * degree);
    law.update = update;
    MaterialState state = law.initial_state();
    Tensor way = Tensor::Zero();
    way.diagonal() << -0.02, 0.006, 0.0;
    way(0, 1) = way(1, 0) = 0.01;
    for (int k = 0; k < n; ++k) state = advance(law, state, {way / n, Tensor::Zero(), 1.0 / n});
    return state.stress;
  };
  const Tensor limit = end(DruckerPragerUpdate::return_map, 20000);
  const double coarse = (end(DruckerPragerUpdate::rate, 500) - limit).norm() / limit.norm();
  const double fine = (end(DruckerPragerUpdate::rate, 4000) - limit).norm() / limit.norm();
  CHECK(fine < 1e-3);
  CHECK(fine < 0.3 * coarse);
  CHECK((end(DruckerPragerUpdate::rate_printed, 4000) - limit).norm() / limit.norm() > 0.05);
}
