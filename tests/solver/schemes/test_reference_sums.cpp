// Sums that keep their pairs are the general ones; fast parts change neither momentum nor energy, and little else.
#include <omp.h>

#include "solver/io/simulation_checkpoint.hpp"
#include "solver/schemes/reference_frame.hpp"
#include "solver/schemes/velocity_gradient.hpp"
#include "solver/simulation.hpp"
#include "tests/catch.hpp"

using namespace furrow;

namespace {

/// A block of rubber that swings, its first column squeezed to three hundredths, the next two to three tenths; between two planes of
/// symmetry where `mirrored`. Nothing damps it: short steps are chosen that meet no resonance with it.
Simulation<2> squeezed_block(bool sub_cycling, bool mirrored = false) {
  Simulation<2> simulation;
  Body<2>& body = simulation.body;
  body.material = LinearElastic::from_young(1000.0, 2e6, 0.3);
  body.spacing = 0.01;
  body.scheme.frame = Frame::reference;
  body.scheme.smoothing_ratio = 1.3;
  body.scheme.viscosity.reset();
  body.scheme.bulk_viscosity = BulkViscosity{};
  body.scheme.hourglass_damping = 0.1;
  body.scheme.sub_cycling = sub_cycling;
  simulation.control.stability = 0.85;
  simulation.control.slow_stability = 0.35;
  simulation.control.force = 1e6;
  std::vector<Vector<2>> centres;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) centres.push_back(0.01 * Vector<2>(i + 0.5, j + 0.5));
  body.add(centres);
  if (mirrored) body.images = Images<2>({{{0.0, 0.0}, {1.0, 0.0}}, {{0.0, 0.0}, {0.0, 1.0}}});
  Particles<2>& p = body.particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vector<2> X = p.reference_position[i];
    if (X[0] < 0.03) p.deformation_gradient[i] = Vector<2>(X[0] < 0.01 ? 0.03 : 0.3, 1.0).asDiagonal();
    p.velocity[i] = Vector<2>(0.05 * std::sin(12.0 * X[0] + 3.0 * X[1]), 0.05 * std::cos(9.0 * X[1]));
  }
  return simulation;
}

Vector<2> where(const Simulation<2>& s, std::int32_t id) { return s.body.particles.position[s.body.index_of(id)]; }

}  // namespace

TEST_CASE("sums that keep their pairs are those that do not", "[reference]") {
  Simulation<2> simulation = squeezed_block(false, true);
  simulation.start();
  for (int k = 0; k < 20; ++k) simulation.step(1.0);
  Body<2>& body = simulation.body;
  Particles<2>& p = body.particles;
  const std::size_t n = p.size(), extended = p.position.size();
  body.images.fill_positions(p.position);
  body.images.fill_velocities(p.velocity);
  body.images.fill(p.density);
  body.images.fill(p.sound_speed);
  std::vector<double> volume(extended, 1e-4);
  PairWeights weights;
  weigh_pairs<2>(body.stencil(), volume, weights);

  std::vector<Matrix<2>> plain(n), kept(extended), B(n), A(extended);
  velocity_gradient<2>(body.stencil(), volume, p.velocity, {}, plain);
  reference_gradient<2>(body.stencil(), weights, p.velocity, {}, kept);
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < n; ++i) error = std::max(error, (plain[i] - kept[i]).norm()), size = std::max(size, plain[i].norm());
  CHECK(error < 1e-12 * size);

  Particles<2> undeformed = p;
  for (std::size_t i = 0; i < n; ++i) {
    B[i] << 1.0, 0.1, -0.2, 1.1;
    undeformed.density[i] = 1000.0;
    undeformed.mass[i] = 0.1;
    const Matrix<2> P = p.stress[i].topLeftCorner<2, 2>();
    A[i] = P * B[i].transpose();
  }
  body.images.fill_tensors(std::span(A));
  body.images.fill_tensors(std::span(kept));
  std::vector<Vector<2>> general(n), lean(n), damped(n);
  std::vector<MomentumPower> power(n);
  std::vector<double> taken(n);
  MomentumWorkspace<2> workspace;
  momentum<2>(body.stencil(), undeformed, p.velocity, std::span<const Matrix<2>>(B), {}, workspace, general, power);
  reference_divergence<2>(body.stencil(), weights, A, 1000.0, lean);
  error = size = 0.0;
  for (std::size_t i = 0; i < n; ++i) error = std::max(error, (general[i] - lean[i]).norm()), size = std::max(size, lean[i].norm());
  CHECK(error < 1e-11 * size);

  for (MomentumPower& w : power) w = {};
  reference_hourglass<2>(body.stencil(), p, volume, p.velocity, kept, 0.0, 0.1, general, power);
  damped_reference_divergence<2>(body.stencil(), weights, A, p, p.velocity, kept, 0.1, 1000.0, damped, taken);
  double most = 0.0, heat_error = 0.0, heat = 0.0;
  error = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    error = std::max(error, (general[i] - damped[i]).norm());
    most = std::max(most, (damped[i] - lean[i]).norm());
    heat_error = std::max(heat_error, std::abs(power[i].viscous - taken[i]));
    heat = std::max(heat, std::abs(taken[i]));
  }
  CHECK(most > 1e-3 * size);
  CHECK(error < 1e-11 * size);
  CHECK(heat_error < 1e-11 * heat);
}

TEST_CASE("quadratic sums that keep their pairs are those that do not", "[reference]") {
  Simulation<2> simulation = squeezed_block(false, true);
  simulation.start();
  for (int k = 0; k < 20; ++k) simulation.step(1.0);
  Body<2>& body = simulation.body;
  Particles<2>& p = body.particles;
  const std::size_t n = p.size(), extended = p.position.size();
  body.images.fill_velocities(p.velocity);
  const std::vector<double> volume(extended, 1e-4);
  std::vector<QuadraticGradient<2>> C(n);
  quadratic_correction<2>(body.stencil(), volume, C);
  PairGradients pairs;
  weigh_quadratic_pairs(body.stencil(), volume, C, pairs);

  std::vector<Matrix<2>> general(n), kept(n), P(extended);
  quadratic_velocity_gradient<2>(body.stencil(), volume, p.velocity, C, general);
  quadratic_reference_gradient(body.stencil(), pairs, p.velocity, kept);
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    error = std::max(error, (general[i] - kept[i]).norm()), size = std::max(size, general[i].norm());
  CHECK(size > 0.0);
  CHECK(error < 1e-11 * size);

  Particles<2> undeformed = p;
  for (std::size_t i = 0; i < n; ++i) {
    undeformed.density[i] = 1000.0;
    undeformed.mass[i] = 0.1;
    P[i] = p.stress[i].topLeftCorner<2, 2>();
  }
  body.images.fill_tensors(std::span(P));
  std::vector<Vector<2>> whole(n), lean(n);
  std::vector<MomentumPower> power(n);
  MomentumWorkspace<2> workspace;
  momentum<2>(body.stencil(), undeformed, p.velocity, std::span<const QuadraticGradient<2>>(C), {}, workspace, whole, power);
  quadratic_reference_divergence(body.stencil(), pairs, P, 1000.0, lean);
  error = size = 0.0;
  for (std::size_t i = 0; i < n; ++i) error = std::max(error, (whole[i] - lean[i]).norm()), size = std::max(size, lean[i].norm());
  CHECK(size > 0.0);
  CHECK(error < 1e-11 * size);
}

TEST_CASE("short steps of squeezed particles keep momentum and energy, and change little", "[reference]") {
  Simulation<2> together = squeezed_block(false), apart = squeezed_block(true);
  together.start();
  apart.start();
  const Vector<2> momentum = apart.momentum();
  double scale = 0.0;
  for (std::size_t i = 0; i < apart.body.particles.size(); ++i)
    scale += apart.body.particles.mass[i] * apart.body.particles.velocity[i].norm();
  constexpr double end = 5e-3;
  together.run_until(end);
  apart.run_until(end);
  REQUIRE(apart.body.fast_parts().size() == 2);
  CHECK(apart.body.fast_parts()[0].own == 40);
  CHECK(apart.body.fast_parts()[1].own == 20);
  CHECK(apart.steps() < together.steps() / 2);
  CHECK(apart.sub_steps() > 3 * apart.steps() / 2);
  CHECK((apart.momentum() - momentum).norm() < 1e-12 * scale);
  CHECK(std::abs(together.energy_imbalance()) < 5e-3);
  CHECK(std::abs(apart.energy_imbalance()) < 1.25 * std::abs(together.energy_imbalance()));
  CHECK(apart.energy().kinetic + apart.energy().elastic ==
        Approx(together.energy().kinetic + together.energy().elastic).epsilon(0.01));
  const Simulation<2> start = squeezed_block(false);
  double difference = 0.0, moved = 0.0;
  for (std::int32_t id = 0; id < 400; ++id) {
    difference = std::max(difference, (where(apart, id) - where(together, id)).norm());
    moved = std::max(moved, (where(together, id) - start.body.particles.position[static_cast<std::size_t>(id)]).norm());
  }
  CHECK(difference < 0.02 * moved);
}

TEST_CASE("a run with fast parts goes on from a checkpoint, and with any number of threads, bit for bit", "[reference]") {
  const auto same = [](const Simulation<2>& a, const Simulation<2>& b) {
    bool equal = a.time() == b.time() && a.energy().total() == b.energy().total() && a.sub_steps() == b.sub_steps();
    for (std::int32_t id = 0; id < 400; ++id) {
      const auto i = a.body.index_of(id), j = b.body.index_of(id);
      equal = equal && where(a, id) == where(b, id) && a.body.particles.stress[i] == b.body.particles.stress[j] &&
              a.body.particles.internal_energy[i] == b.body.particles.internal_energy[j];
    }
    return equal;
  };
  const auto stepped = [](int steps) {
    Simulation<2> simulation = squeezed_block(true, true);
    simulation.start();
    for (int k = 0; k < steps; ++k) simulation.step(1.0);
    return simulation;
  };
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Simulation<2> whole = stepped(160);
  REQUIRE(whole.body.fast_parts().size() == 2);
  omp_set_num_threads(3);
  CHECK(same(whole, stepped(160)));
  omp_set_num_threads(threads);
  const Simulation<2> first = stepped(75);
  Simulation<2> second = squeezed_block(true, true);
  resume_from(checkpoint_of(first), second);
  for (int k = 75; k < 160; ++k) second.step(1.0);
  CHECK(same(whole, second));
}

TEST_CASE("a body in which something is held cannot be sub-cycled", "[reference]") {
  Simulation<2> simulation = squeezed_block(true);
  simulation.body.loads.motions.push_back({"hold", {0}, [](double) { return Vector<2>(0.0, 0.0); }});
  simulation.start();
  CHECK_THROWS_AS(simulation.run_until(1.0), std::invalid_argument);
}
