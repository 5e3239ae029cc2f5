// Coupled simulation: both bodies get the same impulses to round-off, the energy of both is kept, threads and restarts change no
// bit, and sub-steps give what a single step for both gives.
#include "solver/coupled_simulation.hpp"

#include <omp.h>

#include <cstring>
#include <memory>

#include "harness/soil_box.hpp"
#include "solver/io/coupled_checkpoint.hpp"
#include "solver/io/simulation_checkpoint.hpp"
#include "tests/catch.hpp"

using namespace furrow;

namespace {

constexpr double speed = 2.0;   // m/s, of the bar

/// A soft block that rests nowhere is struck by a stiff, heavy bar, driven at one end. The bar's outline goes through its
/// outermost particles and two points of the rigid part behind it.
std::unique_ptr<CoupledSimulation> bar_and_block() {
  auto coupled = std::make_unique<CoupledSimulation>();
  Body<2>& soil = coupled->soft.body;
  soil.name = "soil";
  soil.material = LinearElastic::from_young(1500.0, 2e6, 0.25);
  soil.spacing = 0.01;
  soil.scheme.smoothing_ratio = 1.5;
  soil.scheme.viscosity = ArtificialViscosity{0.2, 0.0};
  soil.add(rectangle({0.0, 0.0}, 0.1, 0.1, 0.01));

  Body<2>& bar = coupled->stiff.body;
  bar.name = "bar";
  bar.material = LinearElastic::from_young(3000.0, 2e8, 0.3);
  bar.spacing = 0.005;
  bar.scheme.frame = Frame::reference;
  bar.scheme.smoothing_ratio = 1.3;
  bar.scheme.viscosity.reset();
  bar.scheme.hourglass_damping = 0.1;
  bar.add(rectangle({-0.016, 0.02}, 0.015, 0.1, 0.005), {speed, 0.0});   // 3 columns of 20, column by column
  std::vector<std::int32_t> driven;
  for (const int column : {0, 1, 2})
    for (int row = 15; row < 20; ++row) driven.push_back(20 * column + row);
  bar.loads.motions.push_back({"actuator", driven, [](double) { return Vector<2>(speed, 0.0); }});

  BodySurface& surface = coupled->surface;
  const auto node = [&](int column, int row) {
    surface.ids.push_back(20 * column + row);
    surface.start.push_back(bar.particles.position[static_cast<std::size_t>(20 * column + row)]);
  };
  for (const int column : {0, 1, 2}) node(column, 0);
  for (int row = 1; row < 20; ++row) node(2, row);
  for (const double x : {-0.0035, -0.0135}) surface.ids.push_back(BodySurface::rigid), surface.start.push_back({x, 0.2});
  for (int row = 19; row > 0; --row) node(0, row);
  surface.radius = 0.0025;
  surface.displacement = [](double t) { return Vector<2>(speed * t, 0.0); };
  surface.velocity = [](double) { return Vector<2>(speed, 0.0); };
  coupled->contact.law = {.stiffness = 2e6,
                          .damping = 0.1,
                          .friction = 0.3,
                          .adhesion = 0.0,
                          .sticking_stiffness = 8e5,
                          .reach = 0.5,
                          .lennard_jones = {}};
  coupled->couple();
  return coupled;
}

bool same(const Simulation<2>& a, const Simulation<2>& b) {
  const std::size_t n = a.body.particles.size();
  bool equal = n == b.body.particles.size() && a.time() == b.time() && a.energy().total() == b.energy().total();
  for (std::size_t i = 0; equal && i < n; ++i)
    equal = a.body.particles.position[i] == b.body.particles.position[i] &&
            a.body.particles.velocity[i] == b.body.particles.velocity[i] &&
            a.body.particles.stress[i] == b.body.particles.stress[i];
  return equal;
}

}  // namespace

TEST_CASE("soil and tool are given the same momentum to round-off", "[coupled]") {
  const auto coupled = bar_and_block();
  coupled->soft.start();
  const Vector<2> soil_before = coupled->soft.momentum(), bar_before = coupled->stiff.momentum();
  for (int k = 0; k < 60; ++k) coupled->soft.step(1.0);
  const auto& I = coupled->impulses();
  REQUIRE(coupled->sub_steps() > 300);
  REQUIRE(I.contact.norm() > 0.1);
  CHECK((I.soil + I.contact + I.rigid + I.pending).norm() < 1e-12 * I.contact.norm());
  CHECK((coupled->soft.momentum() - soil_before - I.soil).norm() < 1e-10 * I.contact.norm());
  CHECK((coupled->stiff.momentum() - bar_before - I.contact - I.actuator).norm() < 1e-10 * I.contact.norm());
}

TEST_CASE("energy of soil and tool comes from the actuator", "[coupled]") {
  const auto coupled = bar_and_block();
  coupled->soft.start();
  coupled->soft.run_until(0.01);
  REQUIRE(coupled->actuator_work() > 0.1);
  CHECK(std::abs(coupled->energy_error()) < 0.02 * coupled->actuator_work());
}

TEST_CASE("threads change no bit of a coupled simulation, nor does a restart", "[coupled]") {
  const auto run = [](int threads) {
    omp_set_num_threads(threads);
    auto coupled = bar_and_block();
    coupled->soft.start();
    for (int k = 0; k < 60; ++k) coupled->soft.step(1.0);
    return coupled;
  };
  const int before = omp_get_max_threads();
  const auto one = run(1), three = run(3);
  omp_set_num_threads(before);
  CHECK(same(one->soft, three->soft));
  CHECK(same(one->stiff, three->stiff));

  auto first = bar_and_block();
  first->soft.start();
  for (int k = 0; k < 25; ++k) first->soft.step(1.0);
  auto resumed = bar_and_block();
  Checkpoint checkpoint = checkpoint_of(first->soft);
  save_stiff(*first, checkpoint);
  resume_from(checkpoint, resumed->soft);
  load_stiff(checkpoint, *resumed);
  for (int k = 25; k < 60; ++k) resumed->soft.step(1.0);
  CHECK(same(one->soft, resumed->soft));
  CHECK(same(one->stiff, resumed->stiff));
  CHECK(one->impulses().actuator == resumed->impulses().actuator);
}

TEST_CASE("sub-steps give what a single step for both gives", "[coupled]") {
  const auto many = bar_and_block(), single = bar_and_block();
  single->single_rate = true;
  single->couple();
  many->soft.start();
  single->soft.start();
  many->soft.run_until(0.01);
  single->soft.run_until(0.01);
  CHECK(single->soft.steps() > 3 * many->soft.steps());
  const auto &a = many->impulses(), &b = single->impulses();
  CHECK((a.actuator - b.actuator).norm() < 0.05 * b.actuator.norm());
  CHECK((a.soil - b.soil).norm() < 0.05 * b.soil.norm());
}
