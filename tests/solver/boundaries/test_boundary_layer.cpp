// Boundary layers: what they borrow is what the soil in front of them has, forces on them are opposite to those on the soil, and a
// column between them stands still.
#include "solver/boundaries/boundary_layer.hpp"

#include "harness/soil_box.hpp"
#include "solver/simulation.hpp"
#include "tests/catch.hpp"

using namespace furrow;

namespace {

constexpr double dx = 0.01, gravity = 9.81;

DruckerPrager clay() {
  return {.reference_density = 1800.0, .bulk_modulus = 1.5e6, .shear_modulus = 0.7e6, .cone = DruckerPragerCone::plane_strain(2e3, 0.5, 0.0)};
}

/// A block of 20 x 10 particles on a floor that is tilted by `angle` together with gravity, rough or smooth.
Simulation<2> block_on_floor(double angle, Slip slip) {
  Simulation<2> simulation;
  Body<2>& body = simulation.body;
  body.material = clay();
  body.scheme.density = DensityEquation::constant;
  body.spacing = dx;
  const Vector<2> along(std::cos(angle), std::sin(angle)), up(-std::sin(angle), std::cos(angle));
  body.loads.gravity = -gravity * up;
  std::vector<Vector<2>> centres;
  for (const Vector<2>& x : rectangle({0.0, 0.0}, 0.2, 0.1, dx)) centres.push_back(x[0] * along + x[1] * up);
  body.add(centres);
  add_flat_layer(body, "floor", -0.1 * along, 0.3 * along, slip);
  return simulation;
}

Vector<2> soil_force(const Simulation<2>& simulation) {
  Vector<2> sum = Vector<2>::Zero();
  const Particles<2>& p = simulation.body.particles;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!simulation.body.is_in_layer(i)) sum += p.mass[i] * (p.acceleration[i] - simulation.body.loads.gravity);
  return sum;
}

}  // namespace

TEST_CASE("the force on a layer is opposite to that on the soil, at any angle", "[boundary]") {
  const double angle = GENERATE(0.0, 0.4, -1.1, 2.5);
  const Slip slip = GENERATE(Slip::none, Slip::free);
  Simulation<2> simulation = block_on_floor(angle, slip);
  Body<2>& body = simulation.body;
  for (std::size_t i = 0; i < 200; ++i) {
    const double depth = 0.1 - body.particles.position[i].dot(Vector<2>(-std::sin(angle), std::cos(angle)));
    body.particles.stress[i] = -1800.0 * gravity * depth * Tensor::Identity();
    body.particles.stress[i](0, 1) = body.particles.stress[i](1, 0) = 100.0;
    body.particles.velocity[i] = Vector<2>(0.3, -0.2) * depth;
  }
  simulation.start();
  const Vector<2> on_soil = soil_force(simulation), on_floor = body.layer_forces()[0];
  CHECK((on_soil + on_floor).norm() < 1e-11 * on_soil.norm());
  // The weight presses on the floor.
  CHECK(on_floor.dot(body.loads.gravity) > 0.0);
}

TEST_CASE("a layer borrows the uniform stress of the soil; of a smooth one the shear is seen in the mirror", "[boundary]") {
  const Slip slip = GENERATE(Slip::none, Slip::free);
  Simulation<2> simulation = block_on_floor(0.0, slip);
  Body<2>& body = simulation.body;
  body.loads.gravity.setZero();
  Tensor stress = -500.0 * Tensor::Identity();
  stress(0, 1) = stress(1, 0) = 70.0;
  for (std::size_t i = 0; i < 200; ++i) body.particles.stress[i] = stress;
  simulation.start();
  int checked = 0;
  for (std::size_t k = 0; k < body.layers[0].ids.size(); ++k) {
    const std::size_t i = body.index_of(body.layers[0].ids[k]);
    if (body.particles.stress[i].isZero(0.0)) continue;
    ++checked;
    CHECK(body.particles.stress[i](1, 1) == Approx(-500.0));
    CHECK(body.particles.stress[i](0, 0) == Approx(-500.0));
    CHECK(body.particles.stress[i](0, 1) == Approx(slip == Slip::none ? 70.0 : -70.0));
  }
  CHECK(checked >= 40);   // two rows under twenty columns: the third has no soil in reach
}

TEST_CASE("a linear profile of velocity goes on behind a rough surface, and mirrors its normal part behind a smooth one", "[boundary]") {
  Simulation<2> simulation = block_on_floor(0.0, Slip::none);
  Body<2>& body = simulation.body;
  for (std::size_t i = 0; i < 200; ++i) body.particles.velocity[i] = {0.5, -0.1};
  simulation.start();
  // Lent velocities are taken back: the layer itself does not move.
  for (const std::int32_t id : body.layers[0].ids) CHECK(body.particles.velocity[body.index_of(id)].isZero(0.0));

  const std::vector<Vector<2>> position = body.particles.position;
  std::vector<double> soil(position.size(), dx * dx);
  std::vector<std::int32_t> index(position.size());
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (body.is_in_layer(i)) soil[i] = 0.0;
    index[static_cast<std::size_t>(body.particles.id[i])] = static_cast<std::int32_t>(i);
  }
  const LayerSurroundings<2> around{body.scheme.kernel, body.smoothing_length(), body.box, &body.neighbours(), position, soil, index};
  std::vector<Vector<2>> v = body.particles.velocity;
  extrapolate_velocity<2>(around, body.layers[0], Slip::none, {0.2, 0.0}, v);
  std::vector<Vector<2>> w = body.particles.velocity;
  extrapolate_velocity<2>(around, body.layers[0], Slip::free, {0.2, 0.0}, w);
  for (std::size_t k = 0; k < body.layers[0].ids.size(); ++k) {
    const std::size_t i = body.index_of(body.layers[0].ids[k]);
    const double x = position[i][0];
    if (x < 0.04 || x > 0.16 || body.layers[0].depth[k] > 2.0 * dx) continue;   // the third row has no soil in reach
    if (body.layers[0].depth[k] < dx) {   // the mean height of the soil in reach is more than half a spacing
      CHECK(v[i][0] < 0.2);
      CHECK(v[i][0] > 0.2 - 0.3);
    } else if (body.layers[0].depth[k] < 2.0 * dx) {   // only the first row is in reach: mirrored
      CHECK(v[i][0] == Approx(0.2 - 0.3));
      CHECK(v[i][1] == Approx(0.1));
    }
    CHECK(w[i][0] == Approx(0.5));
    CHECK(w[i][1] > 0.0);
  }
}

TEST_CASE("soil that artificial viscosity carries over a rough floor pays friction for it, at any angle", "[boundary]") {
  const double angle = GENERATE(0.0, 0.4, 2.5), sliding = GENERATE(-0.5, 0.0, 0.5);
  const Slip slip = GENERATE(Slip::none, Slip::free);
  Simulation<2> simulation = block_on_floor(angle, slip);
  Body<2>& body = simulation.body;
  body.scheme.viscosity = ArtificialViscosity{0.2, 0.0};
  const Vector<2> along(std::cos(angle), std::sin(angle)), up(-std::sin(angle), std::cos(angle));
  for (std::size_t i = 0; i < 200; ++i) body.particles.velocity[i] = sliding * along - 0.2 * up;
  simulation.start();
  // No stress yet: viscosity alone carries the block.
  const Vector<2> on_floor = body.layer_forces()[0];
  const double carried = -on_floor.dot(up);
  CHECK(carried > 0.0);
  const double direction = slip == Slip::free || sliding == 0.0 ? 0.0 : std::copysign(1.0, sliding);
  CHECK(on_floor.dot(along) == Approx(direction * std::tan(0.5) * carried).margin(1e-9 * carried));
  CHECK((soil_force(simulation) + on_floor).norm() < 1e-11 * on_floor.norm());
  CHECK(body.friction_power() == Approx(std::abs(direction * sliding) * std::tan(0.5) * carried).margin(1e-9 * carried));
}

TEST_CASE("energy that a rough floor takes and gives is in the balance", "[boundary]") {
  Simulation<2> simulation = block_on_floor(0.0, Slip::none);
  Body<2>& body = simulation.body;
  body.scheme.viscosity = ArtificialViscosity{0.2, 0.0};
  for (std::size_t i = 0; i < 200; ++i) body.particles.velocity[i] = {0.5, -0.2};
  simulation.start();
  const double kinetic = simulation.energy().kinetic;
  simulation.run_until(0.05);
  CHECK(simulation.energy().kinetic < 0.5 * kinetic);
  CHECK(std::abs(simulation.energy_imbalance()) < 2e-3);
}

TEST_CASE("a wall that moves pushes soil out of its way, and its work is the energy that comes in", "[boundary]") {
  Simulation<2> simulation;
  Body<2>& body = simulation.body;
  body.material = clay();
  body.scheme.density = DensityEquation::constant;
  body.spacing = dx;
  body.add(rectangle({0.0, 0.0}, 0.2, 0.1, dx));
  add_flat_layer(body, "blade", {0.0, 0.15}, {0.0, -0.05}, Slip::free, [](double) { return Vector<2>(0.3, 0.0); });
  REQUIRE(body.layers[0].normal[0].isApprox(Vector<2>(1.0, 0.0)));
  simulation.start();
  simulation.run_until(0.1);
  CHECK(body.particles.position[body.index_of(body.layers[0].ids[0])][0] == Approx(-0.005 + 0.03));
  double least = 1.0;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    if (!body.is_in_layer(i)) least = std::min(least, body.particles.position[i][0]);
  CHECK(least > 0.03);
  CHECK(simulation.energy().external > 0.0);
  CHECK(std::abs(simulation.energy_imbalance()) < 2e-3);
  CHECK(simulation.momentum()[0] == Approx(0.3 * 0.2 * 0.1 * 1800.0).epsilon(0.1));
}

TEST_CASE("soil that overlaps a wall is named", "[boundary]") {
  Simulation<2> simulation = block_on_floor(0.0, Slip::none);
  CHECK_NOTHROW(check_clear(simulation.body));
  simulation.body.particles.position[7][1] -= 0.004;
  simulation.body.particles.position[0][1] -= 0.004;
  std::string message;
  try {
    check_clear(simulation.body);
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  CHECK(message.find("overlaps floor") != std::string::npos);
}
