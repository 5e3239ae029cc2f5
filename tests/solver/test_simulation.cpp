// The time loop: restarts and threads change no bit, free bodies keep their momenta, and a run that goes wrong says where.
#include <omp.h>

#include <array>
#include <cstring>
#include <numbers>

#include "harness/soil_box.hpp"
#include "solver/io/simulation_checkpoint.hpp"
#include "solver/simulation.hpp"
#include "tests/catch.hpp"

using namespace furrow;

namespace {

/// A rubber block that is struck, between a symmetry plane and a wall, with every optional term switched on.
Simulation<2> struck_block() {
  Simulation<2> simulation;
  Body<2>& body = simulation.body;
  body.material = LinearElastic::from_young(1000.0, 2e6, 0.4);
  body.spacing = 0.01;
  body.scheme.smoothing_ratio = 1.3;
  body.scheme.artificial_stress = ArtificialStress{};
  body.scheme.hourglass = 0.1;
  body.scheme.xsph = 0.2;
  body.scheme.shepard_every = 7;
  std::vector<Vector<2>> centres;
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 9; ++j) centres.push_back(0.01 * Vector<2>(i + 0.5, j + 0.5));
  body.add(centres, {3.0, -1.0});
  for (std::size_t i = 0; i < body.particles.size(); ++i) body.particles.velocity[i][0] += 20.0 * body.particles.position[i][1];
  body.images = Images<2>({SymmetryPlane<2>{{0.0, 0.0}, {0.0, 1.0}}});
  body.walls.push_back({{0.125, 0.0}, {-1.0, 0.0}, 8e6});
  return simulation;
}

/// The same block with sums over its undeformed shape, and with what goes with them.
Simulation<2> struck_block_in_reference() {
  Simulation<2> simulation = struck_block();
  Scheme& scheme = simulation.body.scheme;
  scheme.frame = Frame::reference;
  scheme.correction = Correction::quadratic;
  scheme.viscosity.reset();
  scheme.artificial_stress.reset();
  scheme.bulk_viscosity = BulkViscosity{};
  scheme.hourglass_damping = 0.05;
  scheme.xsph = 0.0;
  scheme.shepard_every = 0;
  return simulation;
}

/// The same with a linear correction, and steps by its largest frequency.
Simulation<2> struck_block_by_frequency() {
  Simulation<2> simulation = struck_block_in_reference();
  simulation.body.scheme.correction = Correction::linear;
  simulation.control.stability = 0.8;
  return simulation;
}

/// The same block on a rough boundary layer, with gravity, in place of the symmetry plane.
Simulation<2> struck_block_on_a_layer() {
  Simulation<2> simulation = struck_block();
  simulation.body.images = {};
  simulation.body.scheme.xsph = 0.0;
  simulation.body.loads.gravity = {0.0, -9.81};
  simulation.body.walls.front().friction = 0.3;
  add_flat_layer(simulation.body, "floor", {-0.05, 0.0}, {0.3, 0.0}, Slip::none);
  return simulation;
}

/// The same block run into by a rough plate that moves.
Simulation<2> block_and_plate() {
  Simulation<2> simulation = struck_block();
  RigidBody<2> plate;
  plate.contact.law = {.stiffness = 8e6, .damping = 0.1, .friction = 0.3, .adhesion = 50.0, .sticking_stiffness = 3e6, .reach = 0.5, .lennard_jones = {}};
  plate.start = {{0.03, -0.05}, {0.09, -0.05}, {0.1, -0.001}, {0.02, -0.001}};
  plate.outline = Outline<2>::through(plate.start, 0.0);
  plate.displacement = [](double t) { return Vector<2>(0.5 * t, 1.5 * t); };
  plate.velocity = [](double) { return Vector<2>(0.5, 1.5); };
  simulation.body.rigid_bodies.push_back(plate);
  return simulation;
}

constexpr std::array blocks{struck_block, struck_block_in_reference, struck_block_by_frequency, struck_block_on_a_layer, block_and_plate};

/// Every field of the table, bit for bit.
bool same(const Simulation<2>& a, const Simulation<2>& b) {
  const std::size_t n = a.body.particles.size();
  bool equal = n == b.body.particles.size() && a.time() == b.time() && a.energy().total() == b.energy().total();
  std::vector<std::vector<std::byte>> bytes;
  for_each_field(a.body.particles, [&](const Field&, const auto& array) {
    const auto* data = reinterpret_cast<const std::byte*>(array.data());
    bytes.emplace_back(data, data + n * sizeof(array[0]));
  });
  std::size_t k = 0;
  for_each_field(b.body.particles, [&](const Field&, const auto& array) {
    equal = equal && std::memcmp(array.data(), bytes[k++].data(), n * sizeof(array[0])) == 0;
  });
  return equal;
}

/// What the Divergence says that `run` ends in; empty when it does not.
template <class F>
std::string message_of(F&& run) {
  try {
    run();
  } catch (const Divergence& divergence) {
    return divergence.what();
  }
  return {};
}

}  // namespace

TEST_CASE("what sets prescribed particles in motion does work on them", "[simulation]") {
  // The lower row of a block is pushed up from rest, ever faster: nothing that the block has comes from nowhere.
  Simulation<2> simulation;
  Body<2>& body = simulation.body;
  body.material = LinearElastic::from_young(1000.0, 2e6, 0.3);
  body.spacing = 0.01;
  body.scheme.viscosity.reset();
  body.add(rectangle({0.0, 0.0}, 0.08, 0.06, 0.01));
  PrescribedMotion<2> push{"push", {}, [](double t) { return Vector<2>(0.0, 20.0 * t); }};
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    if (body.particles.position[i][1] < 0.01) push.ids.push_back(body.particles.id[i]);
  body.loads.motions.push_back(push);
  simulation.control.courant = 0.1;
  simulation.start();
  simulation.run_until(0.01);
  REQUIRE(body.prescribed_kinetic_energy(0.01) > 0.1 * simulation.energy().kinetic);
  CHECK(std::abs(simulation.energy_imbalance()) < 1e-4);
}

TEST_CASE("layers far from soil cost nothing and change nothing", "[simulation]") {
  // The same block over a floor that ends where it ends, and over one that goes on and on.
  const auto over_floor = [](double length) {
    Simulation<2> simulation = struck_block();
    Body<2>& body = simulation.body;
    body.images = {};
    body.walls.clear();
    body.scheme.xsph = 0.0;
    body.scheme.shepard_every = 0;
    body.loads.gravity = {0.0, -9.81};
    add_flat_layer(body, "floor", {-0.15, 0.0}, {length, 0.0}, Slip::none);
    simulation.start();
    for (int k = 0; k < 100; ++k) simulation.step(1.0);
    return simulation;
  };
  const Simulation<2> near = over_floor(0.35), far = over_floor(1.35);
  std::size_t idle = 0;
  for (const std::int32_t id : far.body.layers.front().ids)
    if (far.body.neighbours().row(far.body.index_of(id)).empty()) ++idle;
  CHECK(idle > far.body.layers.front().ids.size() / 2);
  CHECK(far.energy().total() == Approx(near.energy().total()).epsilon(1e-12));
  CHECK(far.body.layer_forces()[0][1] == Approx(near.body.layer_forces()[0][1]).epsilon(1e-9));
  for (std::int32_t id = 0; id < 108; ++id) {
    const auto a = near.body.index_of(id), b = far.body.index_of(id);
    CHECK((near.body.particles.position[a] - far.body.particles.position[b]).norm() < 1e-12);
  }
}

TEST_CASE("a restart from a checkpoint is bit for bit the run that was never stopped", "[simulation]") {
  const auto block = blocks[GENERATE(0u, 1u, 2u, 3u, 4u)];
  Simulation<2> whole = block();
  whole.start();
  for (int k = 0; k < 150; ++k) whole.step(1.0);
  const auto builds = whole.body.builds();
  const Checkpoint checkpoint = checkpoint_of(whole);
  for (int k = 0; k < 150; ++k) whole.step(1.0);
  // Where neighbours change at all, they were found anew after the checkpoint as well.
  REQUIRE((whole.body.builds() > builds || whole.body.scheme.frame == Frame::reference));

  Simulation<2> resumed = block();
  resume_from(checkpoint, resumed);
  for (int k = 0; k < 150; ++k) resumed.step(1.0);
  CHECK(same(whole, resumed));
}

TEST_CASE("one and several threads give the same bits", "[simulation]") {
  const auto block = blocks[GENERATE(0u, 1u, 2u, 3u, 4u)];
  const auto run = [block](int threads) {
    omp_set_num_threads(threads);
    Simulation<2> simulation = block();
    simulation.start();
    for (int k = 0; k < 120; ++k) simulation.step(1.0);
    return simulation;
  };
  const int before = omp_get_max_threads();
  const Simulation<2> one = run(1), two = run(2), three = run(3);
  omp_set_num_threads(before);
  CHECK(same(one, two));
  CHECK(same(one, three));
}

TEST_CASE("a free body keeps momentum, angular momentum and energy", "[simulation]") {
  Simulation<2> simulation = struck_block();
  simulation.body.walls.clear();
  simulation.body.images = {};
  simulation.body.scheme.xsph = 0.0;
  simulation.body.scheme.shepard_every = 0;
  simulation.body.scheme.artificial_stress.reset();
  simulation.start();
  const Vector<2> p = simulation.momentum();
  const double L = simulation.angular_momentum();
  for (int k = 0; k < 300; ++k) simulation.step(1.0);
  CHECK((simulation.momentum() - p).norm() < 1e-12 * p.norm());
  CHECK(std::abs(simulation.angular_momentum() - L) < 1e-10 * std::abs(L));
  CHECK(std::abs(simulation.energy_imbalance()) < 1e-3);
}

TEST_CASE("a wall gives back what a bar brings, and only while they touch", "[simulation]") {
  Simulation<2> simulation = struck_block();
  simulation.start();
  double largest = 0.0;
  for (int k = 0; k < 60; ++k) {
    simulation.step(1.0);
    largest = std::max(largest, simulation.body.wall_forces()[0]);
    CHECK(simulation.body.wall_forces()[0] >= 0.0);
  }
  CHECK(largest > 0.0);
}

TEST_CASE("damping takes energy until it ends, and none from then on", "[simulation]") {
  Simulation<2> simulation = struck_block();
  simulation.body.loads.damping = 50.0;
  simulation.body.loads.damping_end = 2e-3;
  simulation.start();
  simulation.run_until(2e-3);
  CHECK(simulation.energy().damping > 0.0);
  simulation.step(1.0);
  const double taken = simulation.energy().damping;
  simulation.run_until(3e-3);
  CHECK(simulation.energy().damping == taken);
}

TEST_CASE("hourglass control holds together what began as one piece, and leaves alone what met later", "[simulation]") {
  Body<2> body = struck_block().body;
  body.walls.clear();
  body.images = {};
  body.scheme.viscosity.reset();
  const std::size_t n = body.particles.size();
  std::vector<Vector<2>> apart(body.particles.position);
  for (Vector<2>& x : apart) x[0] += 1.0;
  body.add(apart);
  // The second block is put beside the first one without strain: no stress, no deformation, but new neighbours.
  for (std::size_t i = n; i < 2 * n; ++i) body.particles.position[i][0] -= 0.88;
  body.refresh_neighbours(true);
  const auto first = static_cast<std::size_t>(body.index_of(0));
  body.accelerate(0.0, body.particles.velocity);
  for (const Vector<2>& a : body.particles.acceleration) CHECK(a.norm() < 1e-6);
  // A zigzag within one block is met by a force.
  body.particles.position[first][0] += 1e-4;
  body.accelerate(0.0, body.particles.velocity);
  CHECK(body.particles.acceleration[first][0] < -1.0);
}

TEST_CASE("a held face does not move and no work is done on it", "[simulation]") {
  Simulation<2> simulation = struck_block();
  Body<2>& body = simulation.body;
  body.walls.clear();
  body.images = {};
  body.scheme.xsph = 0.0;
  body.scheme.shepard_every = 0;
  body.scheme.artificial_stress.reset();
  body.scheme.viscosity.reset();
  // The block is 12 columns of 9; its left face is held, and everything right of it moves.
  std::vector<std::vector<std::int32_t>> rows;
  for (int j = 0; j < 9; ++j) rows.push_back({j, 9 + j, 18 + j, 27 + j});
  body.hold_face("left", rows);
  for (std::size_t i = 0; i < body.particles.size(); ++i) body.particles.velocity[i] = {0.0, 2.0 * body.particles.position[i][0]};
  simulation.start();
  for (int k = 0; k < 200; ++k) simulation.step(1.0);
  double at_face = 0.0, beyond = 0.0;
  for (const HeldFace::Column& column : body.loads.faces[0].columns) {
    Vector<2> v = Vector<2>::Zero();
    double sum = 0.0, moment = 0.0;
    for (std::size_t k = 0; k < column.ids.size(); ++k) {
      v += column.weights[k] * body.particles.velocity[body.index_of(column.ids[k])];
      sum += column.weights[k];
      moment += column.weights[k] * (static_cast<double>(k) + 0.5);
    }
    CHECK(std::abs(sum - 1.0) < 1e-12);
    CHECK(std::abs(moment) < 1e-12);
    at_face = std::max(at_face, v.norm());
    beyond = std::max(beyond, body.particles.velocity[body.index_of(column.ids[1])].norm());
  }
  CHECK(at_face < 1e-12);
  CHECK(beyond > 1e-3);
  CHECK(std::abs(simulation.energy_imbalance()) < 1e-3);
}

TEST_CASE("a body that flies without deforming keeps its neighbours", "[simulation]") {
  Simulation<2> simulation = struck_block();
  Body<2>& body = simulation.body;
  body.walls.clear();
  body.images = {};
  for (auto& v : body.particles.velocity) v = {30.0, -20.0};
  simulation.start();
  const Vector<2> before = body.particles.position[0];
  for (int k = 0; k < 100; ++k) simulation.step(1.0);
  CHECK((body.particles.position[0] - before).norm() > 0.02);   // far beyond the skin
  CHECK(body.builds() == 1);
}

TEST_CASE("a run that goes wrong says when, where and in which field", "[simulation]") {
  SECTION("a particle leaves the domain") {
    Simulation<2> simulation = struck_block();
    simulation.watch.high = {0.12, 1.0};
    simulation.start();
    const std::string message = message_of([&] { simulation.run_until(1.0); });
    CHECK(message.starts_with("t = "));
    CHECK(message.find("particle") != std::string::npos);
    CHECK(message.find("position has left the domain") != std::string::npos);
  }
  SECTION("a Courant number of 3") {
    Simulation<2> simulation = struck_block();
    simulation.control.courant = 3.0;
    simulation.control.force = 1e9;
    simulation.start();
    CHECK_THROWS_AS(simulation.run_until(1.0), Divergence);
  }
  SECTION("a number that is none") {
    Simulation<2> simulation = struck_block();
    simulation.start();
    simulation.step(1.0);
    simulation.body.particles.stress[5](0, 0) = std::nan("");
    CHECK(message_of([&] { simulation.step(1.0); }).find("is not finite") != std::string::npos);
  }
}

TEST_CASE("a checkpoint of other particles is refused", "[simulation]") {
  Simulation<2> simulation = struck_block();
  simulation.start();
  const Checkpoint checkpoint = checkpoint_of(simulation);
  Simulation<2> other = struck_block();
  other.body.add({{1.0, 1.0}});
  CHECK_THROWS_AS(resume_from(checkpoint, other), std::out_of_range);
}

TEST_CASE("The first step and the growth of steps can be held back", "[simulation]") {
  Simulation<2> free = struck_block(), held = struck_block();
  held.control.first = 0.1;
  held.control.growth = 1.05;
  free.start();
  held.start();
  free.step(1.0);
  held.step(1.0);
  CHECK(held.dt() == Approx(0.1 * free.dt()).epsilon(1e-12));
  CHECK(held.limiter() == StepLimiter::growth);
  for (int k = 0; k < 3; ++k) {
    const double before = held.dt();
    held.step(1.0);
    CHECK(held.dt() == Approx(1.05 * before).epsilon(1e-12));
  }
  for (int k = 0; k < 100; ++k) held.step(1.0);
  CHECK(held.limiter() != StepLimiter::growth);   // what the conditions allow is reached, and kept
}

TEST_CASE("Courant's condition follows what is squeezed most in the reference frame", "[simulation]") {
  const auto step_of = [](double squeeze) {
    Simulation<2> block = struck_block_in_reference();
    block.control.force = 1e6;
    block.start();
    for (auto& F : block.body.particles.deformation_gradient) F = Vector<2>(squeeze, 1.0).asDiagonal();
    return step_length(block.body, 0.0, block.control).dt;
  };
  CHECK(step_of(0.25) == Approx(0.25 * step_of(1.0)));
}

TEST_CASE("The largest frequency of a lattice between planes of symmetry is that of a standing wave", "[simulation]") {
  constexpr int cells = 16, between = cells / 2;   // waves that are mirrored at both ends come back after twice the width
  constexpr double dx = 0.01, h = 1.3 * dx, pi = std::numbers::pi;
  const Vector<2> stretch(GENERATE(1.0, 0.4), 1.1);
  Simulation<2> simulation;
  Body<2>& body = simulation.body;
  body.material = LinearElastic::from_young(1000.0, 2e6, 0.3);
  body.spacing = dx;
  body.scheme.frame = Frame::reference;
  body.scheme.kernel = WendlandC2{};
  body.scheme.correction = Correction::none;
  body.scheme.smoothing_ratio = h / dx;
  body.scheme.viscosity.reset();
  const Vector<2> far = Vector<2>::Constant(between * dx), zero = Vector<2>::Zero(), x(1.0, 0.0), y(0.0, 1.0);
  body.images = Images<2>({{zero, x}, {zero, y}, {far, -x}, {far, -y}});
  std::vector<Vector<2>> centres;
  for (int i = 0; i < between; ++i)
    for (int j = 0; j < between; ++j) centres.push_back(dx * Vector<2>(i + 0.5, j + 0.5));
  body.add(centres);
  simulation.start();
  for (auto& F : body.particles.deformation_gradient) F = stretch.asDiagonal();

  // u = sin(k.X): the sums see the wave vector g(k) = sum_j V_j sin(k.X_ij) grad W, the deformed body F^-T g.
  double largest = 0.0;
  for (int a = 0; a < cells; ++a)
    for (int b = 0; b < cells; ++b) {
      Vector<2> g = Vector<2>::Zero();
      for (int i = -3; i <= 3; ++i)
        for (int j = -3; j <= 3; ++j) {
          const double q = dx * std::hypot(i, j) / h;
          if (q == 0.0 || q >= 2.0) continue;
          const double slope_over_q = -5.0 * std::pow(1.0 - 0.5 * q, 3) * 7.0 / (4.0 * pi * h * h);   // (dW/dq)/q
          g += dx * dx * std::sin(2.0 * pi * (a * i + b * j) / cells) * slope_over_q / (h * h) * dx * Vector<2>(i, j);
        }
      largest = std::max(largest, g.cwiseQuotient(stretch).norm());
    }
  const double kappa = largest * h * std::min(1.0, stretch.minCoeff());   // c_s = c / the least stretch
  const double found = body.largest_wave_number();
  CHECK(found < (1.0 + 1e-9) * kappa);
  CHECK(found > 0.95 * kappa);   // the power method comes from below
  simulation.control.stability = 0.8;
  simulation.control.force = 1e6;
  simulation.step(1.0);
  CHECK(simulation.dt() == Approx(0.8 * 2.0 / (found / kappa * largest * body.particles.sound_speed[0])));
}
