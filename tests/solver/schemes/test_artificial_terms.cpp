// Artificial viscosity and artificial stress: what they are for, by sign and by direction.
#include "tests/catch.hpp"

#include "solver/schemes/momentum.hpp"
#include "tests/solver/cloud.hpp"

namespace furrow {

TEST_CASE("viscosity resists approach and lets particles part", "[schemes]") {
  const ArtificialViscosity model{.alpha = 1.5, .beta = 2.5};
  const Lanes v_dot_x = {-2.0, -0.1, 0.0, 0.1, 2.0, -1e-12, -1e6, 1e6};
  const Lanes Pi = artificial_viscosity(model, v_dot_x, broadcast(0.7), 1.2, broadcast(3.0), broadcast(2.0));
  for (int l = 0; l < lane_count; ++l) {
    if (v_dot_x[l] < 0.0)
      CHECK(Pi[l] > 0.0);
    else
      CHECK(Pi[l] == 0.0);
  }
  const double mu = 1.2 * -2.0 / (0.49 + 0.0144);
  CHECK(Pi[0] == Approx((-1.5 * 3.0 * mu + 2.5 * mu * mu) / 2.0));
}

TEST_CASE("viscosity turns motion into heat for every particle, whatever the velocities", "[schemes]") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Arrangement<2> a = cloud<2>({15, 15}, true, 2.6, seed);
    for (Tensor& stress : a.particles.stress) stress.setZero();
    std::vector<Vector<2>> acceleration(a.particles.size());
    std::vector<MomentumPower> power(a.particles.size());
    MomentumWorkspace<2> workspace;
    momentum<2>(a.stencil(WendlandC2{}, 1.3), a.particles, a.particles.velocity, {}, {ArtificialViscosity{}, {}, 1.0}, workspace,
                acceleration, power);
    double motion = 0.0;
    for (std::size_t i = 0; i < power.size(); ++i) {
      CHECK(power[i].viscous >= 0.0);
      CHECK(power[i].stress == 0.0);
      CHECK(power[i].artificial == 0.0);
      motion += a.particles.mass[i] * acceleration[i].dot(a.particles.velocity[i]);
    }
    CHECK(motion < 0.0);
  }
}

TEST_CASE("artificial stress acts along the axes in tension, and only there", "[schemes]") {
  const ArtificialStress model{.eps = 0.3, .n = 4.0};
  const double rho = 2.0;
  const Tensor Q = rotation(cross(0.4, -0.7, 0.2));
  const auto of = [&](double a, double b, double c) {
    return artificial_stress<3>(model, rotated(Vector<3>(a, b, c).asDiagonal(), Q), rho);
  };
  const auto expected = [&](double a, double b, double c) {
    return Tensor(-0.3 / (rho * rho) * rotated(Vector<3>(a, b, c).asDiagonal(), Q));
  };
  CHECK((of(7.0, -3.0, 2.0) - expected(7.0, 0.0, 2.0)).norm() < 1e-14);
  CHECK((of(-7.0, -3.0, 0.5) - expected(0.0, 0.0, 0.5)).norm() < 1e-14);
  CHECK((of(4.0, 4.0, 4.0) - expected(4.0, 4.0, 4.0)).norm() < 1e-14);
  CHECK(of(-7.0, -3.0, -2.0).norm() == 0.0);
  CHECK(artificial_stress<3>(model, Tensor::Zero(), rho).norm() == 0.0);

  // Pure shear in the plane: tension along the diagonal.
  Matrix<2> shear, diagonal;
  shear << 0.0, 5.0, 5.0, 0.0;
  diagonal << 0.5, 0.5, 0.5, 0.5;
  CHECK((artificial_stress<2>(model, shear, rho) + 0.3 * 5.0 / 4.0 * diagonal).norm() < 1e-15);
}

TEST_CASE("artificial stress pushes a stretched pair apart", "[schemes]") {
  // Under tension alone two particles attract; the artificial term takes part eps f^n of that away, f = 1 at r = dx.
  Arrangement<2> a = arranged(Points<2>{{{0.0, 0.0}, {1.0, 0.0}}, 1.0, 1.0, {}}, 1.0, 2.6);
  for (Tensor& stress : a.particles.stress) stress = Tensor::Identity();
  std::vector<Vector<2>> plain(2), with(2);
  std::vector<MomentumPower> power(2);
  MomentumWorkspace<2> workspace;
  const Stencil<2> stencil = a.stencil(CubicSpline{}, 1.3);
  momentum<2>(stencil, a.particles, a.particles.velocity, {}, {{}, {}, 1.0}, workspace, plain, power);
  momentum<2>(stencil, a.particles, a.particles.velocity, {}, {{}, ArtificialStress{}, 1.0}, workspace, with, power);
  const auto left = static_cast<std::size_t>(a.particles.position[0][0] > 0.5);
  CHECK(plain[left][0] > 0.0);
  CHECK(with[left][0] == Approx(0.7 * plain[left][0]));
  CHECK((with[0] + with[1]).norm() == 0.0);
}

TEST_CASE("artificial stress takes its share of a uniform tension; the neutral form takes nothing", "[schemes]") {
  Points<2> lattice{{}, 1.0, 1.0, {}};
  for (int i = -4; i <= 4; ++i)
    for (int j = -4; j <= 4; ++j) lattice.position.emplace_back(i, j);
  Arrangement<2> a = arranged(lattice, 1.0, 3.2);
  const std::size_t n = a.particles.size();
  std::size_t centre = n;
  for (std::size_t i = 0; i < n; ++i) {
    a.particles.stress[i] = 5.0 * Tensor::Identity();
    a.particles.velocity[i] = a.particles.position[i];   // uniform expansion: all that carries stress does work
    if (a.particles.position[i].norm() < 0.1) centre = i;
  }
  REQUIRE(centre < n);
  std::vector<Vector<2>> acceleration(n);
  std::vector<MomentumPower> power(n);
  MomentumWorkspace<2> workspace;
  for (const double h : {1.2, 1.5}) {
    const Stencil<2> stencil = a.stencil(WendlandC2{}, h);
    const double share = artificial_share<WendlandC2, 2>(4.0, 1.0, h);
    momentum<2>(stencil, a.particles, a.particles.velocity, {}, {{}, ArtificialStress{0.3, 4.0}, 1.0}, workspace, acceleration, power);
    CHECK(power[centre].artificial == Approx(-0.3 * share * power[centre].stress));
    CHECK(share == Approx(h == 1.2 ? 0.55677 : 0.34549).epsilon(1e-4));   // the sums written out elsewhere
    momentum<2>(stencil, a.particles, a.particles.velocity, {}, {{}, ArtificialStress{0.3, 4.0, true}, 1.0}, workspace, acceleration, power);
    CHECK(std::abs(power[centre].artificial) < 1e-14 * std::abs(power[centre].stress));
  }
  // In three dimensions the nearest six carry all of it where no other is in reach.
  CHECK(artificial_share<CubicSpline, 3>(4.0, 1.0, 0.6) == Approx(1.0));
}

}  // namespace furrow
