// Sums over the reference configuration: a body that turns is free of stress, momenta and energy are kept, tension does not break
// it up, restarts change no bit.
#include "solver/io/simulation_checkpoint.hpp"
#include "solver/schemes/reference_frame.hpp"
#include "solver/simulation.hpp"
#include "tests/catch.hpp"

using namespace furrow;

namespace {

Scheme reference_scheme() {
  Scheme scheme;
  scheme.frame = Frame::reference;
  scheme.smoothing_ratio = 1.3;
  scheme.viscosity.reset();
  return scheme;
}

template <int Dim>
Simulation<Dim> block(const Scheme& scheme, int cells) {
  Simulation<Dim> simulation;
  Body<Dim>& body = simulation.body;
  body.material = LinearElastic::from_young(1000.0, 2e6, 0.3);
  body.spacing = 0.01;
  body.scheme = scheme;
  std::vector<Vector<Dim>> centres;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      for (int k = 0; k < (Dim == 3 ? cells : 1); ++k) {
        Vector<Dim> x;
        x[0] = 0.01 * (i + 0.5), x[1] = 0.01 * (j + 0.5);
        if constexpr (Dim == 3) x[2] = 0.01 * (k + 0.5);
        centres.push_back(x);
      }
  body.add(centres);
  return simulation;
}

}  // namespace

TEST_CASE("the first Piola-Kirchhoff stress has the power of the Cauchy stress", "[reference]") {
  const Matrix<3> F = (Matrix<3>() << 1.1, 0.2, 0.0, -0.1, 0.9, 0.3, 0.05, 0.0, 1.2).finished();
  const Matrix<3> sigma = (Matrix<3>() << 3, 1, 0, 1, -2, 0.5, 0, 0.5, 1).finished();
  const Matrix<3> rate = (Matrix<3>() << 0.3, -1, 0.2, 0.1, 0.7, 0, 2, 0.4, -0.6).finished();
  const Matrix<3> P = first_piola<3>(sigma, F, F.determinant());
  const Matrix<3> L = rate * F.inverse();
  CHECK(P.cwiseProduct(rate).sum() == Approx(F.determinant() * sigma.cwiseProduct(L).sum()).epsilon(1e-12));
}

TEST_CASE("waves seen from the reference configuration are faster where a body is squeezed", "[reference]") {
  CHECK(reference_speed<3>(Matrix<3>::Identity(), 5.0) == Approx(5.0));
  const Matrix<3> squeezed = Vector<3>(0.25, 1.5, 2.0).asDiagonal();
  CHECK(reference_speed<3>(squeezed, 5.0) == Approx(20.0));
}

TEST_CASE("bulk viscosity acts in compression alone", "[reference]") {
  const BulkViscosity model{0.1, 2.0};
  CHECK(bulk_viscosity(model, 3.0, 1000.0, 50.0, 0.01) == 0.0);
  CHECK(bulk_viscosity(model, -3.0, 1000.0, 50.0, 0.01) == Approx(1000.0 * 0.01 * 3.0 * (0.1 * 50.0 + 2.0 * 0.01 * 3.0)));
}

TEST_CASE("a body that spins in the reference frame stays free of stress and keeps its momenta", "[reference]") {
  Scheme scheme = reference_scheme();
  scheme.bulk_viscosity = BulkViscosity{};
  scheme.hourglass_damping = 0.1;
  Simulation<2> simulation = block<2>(scheme, 12);
  Particles<2>& p = simulation.body.particles;
  const double omega = 20.0;   // slow: centrifugal stress is rho (omega L)^2 = 6 Pa
  for (std::size_t i = 0; i < p.size(); ++i)
    p.velocity[i] = omega * Vector<2>(-(p.position[i][1] - 0.06), p.position[i][0] - 0.06);
  simulation.start();
  const double spin = simulation.angular_momentum();
  simulation.run_until(0.08);   // 1.6 rad
  CHECK(simulation.angular_momentum() == Approx(spin).epsilon(1e-10));
  CHECK(simulation.momentum().norm() < 1e-10 * omega * 0.12);
  double stress = 0.0;
  for (const Tensor& s : p.stress) stress = std::max(stress, s.norm());
  CHECK(stress < 30.0 * 1000.0 * omega * omega * 0.06 * 0.06);
  CHECK(std::abs(simulation.energy_imbalance()) < 1e-3);
}

TEST_CASE("what a quadratic motion does is nothing to hourglass control in the reference frame", "[reference]") {
  Simulation<2> simulation = block<2>(reference_scheme(), 10);
  Body<2>& body = simulation.body;
  simulation.start();
  Particles<2>& p = body.particles;
  const auto bent = [](const Vector<2>& X) {
    return Vector<2>(X[0] + 0.7 * X[0] * X[1], X[1] - 0.4 * X[0] * X[0] + 0.2 * X[1] * X[1]);
  };
  std::vector<Matrix<2>> rate;
  std::vector<Vector<2>> velocity;
  std::vector<double> volume;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector<2> X = p.reference_position[i];
    p.position[i] = bent(X);
    p.deformation_gradient[i] << 1.0 + 0.7 * X[1], 0.7 * X[0], -0.8 * X[0], 1.0 + 0.4 * X[1];
    velocity.push_back(3.0 * (bent(X) - X));
    rate.push_back(3.0 * (p.deformation_gradient[i] - Matrix<2>::Identity()));
    volume.push_back(1e-4);
  }
  std::vector<Vector<2>> a(p.size(), Vector<2>::Zero());
  std::vector<MomentumPower> power(p.size(), MomentumPower{});
  reference_hourglass<2>(body.stencil(), p, volume, velocity, rate, 1.0, 1.0, a, power);
  double largest = 0.0;
  for (const Vector<2>& x : a) largest = std::max(largest, x.norm());
  CHECK(largest < 1e-6);
  // A zigzag of a hundredth of the spacing is not nothing.
  for (std::size_t i = 0; i < p.size(); ++i)
    p.position[i][0] += 1e-4 * (std::lround(p.reference_position[i][0] / 0.01 - 0.5) % 2 ? 1.0 : -1.0);
  reference_hourglass<2>(body.stencil(), p, volume, velocity, rate, 1.0, 1.0, a, power);
  for (const Vector<2>& x : a) largest = std::max(largest, x.norm());
  CHECK(largest > 1e3);
}

TEST_CASE("a run in the reference frame goes on from a checkpoint bit for bit", "[reference]") {
  Scheme scheme = reference_scheme();
  scheme.bulk_viscosity = BulkViscosity{};
  scheme.hourglass = 0.05;
  scheme.hourglass_damping = 0.1;
  const auto struck = [&] {
    Simulation<3> simulation = block<3>(scheme, 6);
    for (Vector<3>& v : simulation.body.particles.velocity) v = {-3.0, 0.5, 0.0};
    simulation.body.images = Images<3>({SymmetryPlane<3>{Vector<3>::Zero(), Vector<3>::UnitX()}});
    return simulation;
  };
  Simulation<3> whole = struck(), first = struck(), second = struck();
  whole.start();
  first.start();
  for (int k = 0; k < 40; ++k) whole.step(1.0);
  for (int k = 0; k < 15; ++k) first.step(1.0);
  resume_from(checkpoint_of(first), second);
  for (int k = 0; k < 25; ++k) second.step(1.0);
  bool same = whole.time() == second.time() && whole.energy().total() == second.energy().total();
  for (std::size_t i = 0; i < whole.body.particles.size(); ++i)
    same = same && whole.body.particles.position[i] == second.body.particles.position[i] &&
           whole.body.particles.stress[i] == second.body.particles.stress[i];
  CHECK(same);
}

TEST_CASE("bulk viscosity of a body squeezed flat is no stiffer than its material", "[reference]") {
  // Over the first distance of its particles it would be fifty times as stiff, and blow up in a step that elastic waves allow.
  Scheme scheme = reference_scheme();
  scheme.correction = Correction::linear;
  scheme.bulk_viscosity = BulkViscosity{};
  scheme.hourglass_damping = 0.1;
  Simulation<2> simulation = block<2>(scheme, 12);
  simulation.control.stability = 0.85;
  simulation.control.force = 1e6;
  const Matrix<2> F = Vector<2>(0.02, 50.0).asDiagonal();
  Particles<2>& p = simulation.body.particles;
  double kinetic = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.deformation_gradient[i] = F;
    p.position[i] = F * p.reference_position[i];
    p.velocity[i] = 1e-3 * Vector<2>(std::sin(17.0 * p.id[i]), std::sin(31.0 * p.id[i]));
    kinetic += 0.5 * p.mass[i] * p.velocity[i].squaredNorm();
  }
  simulation.start();
  for (int step = 0; step < 400; ++step) simulation.step(1.0);
  simulation.take_stock();
  CHECK(simulation.energy().kinetic < kinetic);
}
