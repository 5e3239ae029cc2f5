#include "solver/materials/straight_path.hpp"

#include "tests/catch.hpp"
#include "tests/solver/materials/points.hpp"

using namespace furrow;
using test::RandomMotion;

namespace {

/// The same by a hundred thousand small radial returns at constant radius: deviator, and what was taken off in sqrt(3 J2).
Tensor by_small_steps(Tensor s, const Tensor& way, double q_yield) {
  constexpr int n = 100000;
  for (int k = 0; k < n; ++k) {
    s += way / n;
    const double q = std::sqrt(3.0 * j2(s));
    if (q > q_yield) s *= q_yield / q;
  }
  return s;
}

}  // namespace

TEST_CASE("A straight strain turns the stress as ever smaller radial returns do", "[j2]") {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomMotion motion(seed);
    Tensor s = deviator(motion.symmetric());
    s *= (seed % 2 ? 1.0 : 0.4) / std::sqrt(3.0 * j2(s));   // on the surface and inside
    const Tensor way = std::abs(motion.number()) * deviator(motion.symmetric());
    if (double_contraction(s, way) < 0.0 && seed % 2) s = -s;
    const StraightPath path = straight_path(s, way, 1.0);
    if (path.q_trial <= 1.0) continue;
    CHECK(std::sqrt(3.0 * j2(path.direction)) == Approx(1.0).epsilon(1e-12));
    CHECK((path.direction - by_small_steps(s, way, 1.0)).norm() < 1e-4);
  }
}

TEST_CASE("Along the stress, forwards and backwards, a straight path is the radial return", "[j2]") {
  Tensor s = Tensor::Zero();
  s.diagonal() << 2.0, -1.0, -1.0;   // q = 3
  for (const double factor : {0.7, 5.0, -3.0, -20.0}) {
    const StraightPath path = straight_path(s, factor * s, 3.0);
    CHECK(path.q_trial == Approx(3.0 * std::abs(1.0 + factor)));
    CHECK((path.direction - (1.0 + factor > 0.0 ? 1.0 : -1.0) * s / 3.0).norm() < 1e-12);
  }
}

TEST_CASE("What is taken off in a straight path is the work that is not stored", "[j2]") {
  // At constant radius: int s : de' = q d_eps_p + what the deviator stores, with 3 G d_eps_p = q_trial - q.
  RandomMotion motion(4);
  Tensor s = deviator(motion.symmetric());
  s /= std::sqrt(3.0 * j2(s));
  Tensor way = deviator(motion.symmetric());
  if (double_contraction(s, way) < 0.0) way = -way;
  constexpr int n = 100000;
  double work = 0.0;   // times 2 G
  Tensor at = s;
  for (int k = 0; k < n; ++k) {
    const Tensor before = at;
    at += way / n;
    const double q = std::sqrt(3.0 * j2(at));
    if (q > 1.0) at /= q;
    work += 0.5 * double_contraction(before + at, way) / n;
  }
  const StraightPath path = straight_path(s, way, 1.0);
  CHECK(2.0 / 3.0 * (path.q_trial - 1.0) == Approx(work).epsilon(1e-4));
}

TEST_CASE("A path from outside the surface inwards is elastic, and steps of any length stay finite", "[j2]") {
  Tensor s = Tensor::Zero();
  s.diagonal() << 2.2, -1.1, -1.1;
  const StraightPath inwards = straight_path(s, -0.05 * s, 3.0);
  CHECK(inwards.q_trial == Approx(0.95 * 3.3));
  CHECK((inwards.direction - s / 3.3).norm() < 1e-12);
  RandomMotion motion(9);
  const StraightPath huge = straight_path(s, 1e6 * deviator(motion.symmetric()), 3.0);
  CHECK(huge.direction.allFinite());
  CHECK(std::isfinite(huge.q_trial));
  CHECK(straight_path(Tensor::Zero(), Tensor::Zero(), 3.0).q_trial == 0.0);
}
