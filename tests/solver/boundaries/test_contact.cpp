// Contact: what is near an outline, forces that are equal and opposite, a spring that gives back what it took, and a block that
// sticks on a slope up to the angle of friction and slides beyond it.
#include "solver/boundaries/contact.hpp"

#include <numbers>

#include "tests/catch.hpp"

using namespace furrow;

namespace {

constexpr double dx = 0.01;

const std::vector<Vector<2>> square{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};

/// One particle of 2 kg.
Particles<2> particle(const Vector<2>& x, const Vector<2>& v) {
  Particles<2> p;
  resize(p, 1);
  p.position[0] = x;
  p.velocity[0] = v;
  p.mass[0] = 2.0;
  return p;
}

/// Steps of kick, drift, kick with the contact and a field of gravity.
struct Flight {
  Particles<2> p;
  Contact<2> contact;
  Outline<2> outline;
  Vector<2> g = Vector<2>::Zero();
  double time = 0.0, dt = 1e-5;
  double contact_energy = 0.0, power = 0.0;

  Contact<2>::Touch look() {
    p.acceleration[0] = g;
    return contact.touch(p, dx, time, p.velocity, p.acceleration, outline, [](std::size_t) { return true; });
  }
  void step() {
    p.velocity[0] += 0.5 * dt * p.acceleration[0];
    p.position[0] += dt * p.velocity[0];
    time += dt;
    const Vector<2> middle = p.velocity[0];
    p.velocity[0] += 0.5 * dt * p.acceleration[0];   // predicted, as the time loop does
    const auto touch = look();
    p.velocity[0] = middle + 0.5 * dt * p.acceleration[0];
    contact_energy += 0.5 * dt * (power + touch.power);
    power = touch.power;
  }
};

}  // namespace

TEST_CASE("the nearest point of a rounded polygon", "[contact]") {
  const Outline<2> outline = Outline<2>::through(square, 0.1);
  const auto side = nearest_point(outline, Vector<2>(1.3, 0.25));
  CHECK(side.distance == Approx(0.2));
  CHECK((side.normal - Vector<2>(1.0, 0.0)).norm() < 1e-14);
  CHECK(side.first == 1);
  CHECK(side.second == 2);
  CHECK(side.share == Approx(0.25));
  const auto corner = nearest_point(outline, Vector<2>(1.3, 1.4));
  CHECK(corner.distance == Approx(0.4));
  CHECK((corner.normal - Vector<2>(0.6, 0.8)).norm() < 1e-14);
  const auto inside = nearest_point(outline, Vector<2>(0.5, 0.2));
  CHECK(inside.distance == Approx(-0.3));
  CHECK((inside.normal - Vector<2>(0.0, -1.0)).norm() < 1e-14);
  const auto on_edge = nearest_point(outline, Vector<2>(0.5, 0.0));
  CHECK(on_edge.distance == Approx(-0.1));
  CHECK((on_edge.normal - Vector<2>(0.0, -1.0)).norm() < 1e-14);
}

TEST_CASE("a single node is a disc", "[contact]") {
  const Outline<2> disc = Outline<2>::through({{1.0, 1.0}}, 0.5);
  const auto near = nearest_point(disc, Vector<2>(1.0, 3.0));
  CHECK(near.distance == Approx(1.5));
  CHECK((near.normal - Vector<2>(0.0, 1.0)).norm() < 1e-14);
}

TEST_CASE("outlines that are none are refused", "[contact]") {
  CHECK_THROWS_AS(Outline<2>::through({}, 1.0), std::invalid_argument);
  CHECK_THROWS_AS(Outline<2>::through({{0.0, 0.0}, {1.0, 0.0}}, 1.0), std::invalid_argument);
  CHECK_THROWS_AS(Outline<2>::through({{0.0, 0.0}}, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(Outline<2>::through({square.rbegin(), square.rend()}, 0.0), std::invalid_argument);
  CHECK_THROWS_AS(Outline<3>::through({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, 0.0), std::invalid_argument);
}

TEST_CASE("forces on particles and on nodes are equal and opposite, and have no moment", "[contact]") {
  Outline<2> outline = Outline<2>::through(square, 0.0);
  outline.velocity.assign(4, {0.3, -0.2});
  Contact<2> contact;
  contact.law = {.stiffness = 1e5,
                 .damping = 0.1,
                 .friction = 0.0,
                 .adhesion = 0.0,
                 .sticking_stiffness = 1e5,
                 .reach = 0.5,
                 .lennard_jones = {}};
  const bool rough = GENERATE(false, true);
  if (rough) contact.law.friction = 0.4, contact.law.adhesion = 20.0;
  if (GENERATE(false, true)) contact.law.lennard_jones = LennardJones{.coefficient = 3.0, .cut_off = 0.5};
  Particles<2> p;
  resize(p, 40);
  for (std::size_t i = 0; i < 40; ++i) {
    const double s = 0.02 + 0.024 * static_cast<double>(i);
    p.id[i] = static_cast<std::int32_t>(i);
    p.position[i] = i % 2 ? Vector<2>(s, 1.0 + 0.003 + 1e-5 * static_cast<double>(i)) : Vector<2>(-0.002, s);
    p.velocity[i] = {0.1 * s, -0.3};
    p.mass[i] = 1.0 + s;
  }
  contact.touch(p, dx, 0.0, p.velocity, p.acceleration, outline, [](std::size_t) { return true; });
  p.acceleration.assign(40, Vector<2>::Zero());
  const auto touch = contact.touch(p, dx, 1e-3, p.velocity, p.acceleration, outline, [](std::size_t) { return true; });
  REQUIRE(touch.touching == 40);
  Vector<2> on_particles = Vector<2>::Zero(), on_nodes = Vector<2>::Zero();
  double moment = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < 40; ++i) {
    const Vector<2> f = p.mass[i] * p.acceleration[i];
    on_particles += f;
    scale += f.norm();
    moment += p.position[i][0] * f[1] - p.position[i][1] * f[0];
  }
  for (std::size_t k = 0; k < 4; ++k) {
    on_nodes += outline.force[k];
    moment += outline.position[k][0] * outline.force[k][1] - outline.position[k][1] * outline.force[k][0];
  }
  CHECK(scale > 1.0);
  CHECK((on_particles + on_nodes).norm() < 1e-13 * scale);
  CHECK((on_nodes - touch.force).norm() < 1e-13 * scale);
  if (!rough) CHECK(std::abs(moment) < 1e-12 * scale);   // friction acts at the particle's centre, half a spacing off the surface
}

TEST_CASE("friction has nothing to hold on to at a sharp corner, and does where it is rounded", "[contact]") {
  const double radius = GENERATE(0.0, 1e-3);
  const Vector<2> out = Vector<2>(1.0, 1.0).normalized(), along(out[1], -out[0]);
  Outline<2> outline = Outline<2>::through(square, radius);
  Contact<2> contact;
  contact.law.stiffness = contact.law.sticking_stiffness = 1e6;
  contact.law.friction = 0.5;
  Particles<2> p = particle(Vector<2>(1.0, 1.0) + (radius + 0.4 * dx) * out, 0.2 * along);
  contact.touch(p, dx, 0.0, p.velocity, p.acceleration, outline, [](std::size_t) { return true; });
  p.acceleration[0].setZero();
  contact.touch(p, dx, 1e-3, p.velocity, p.acceleration, outline, [](std::size_t) { return true; });
  const double normal = p.acceleration[0].dot(out), held = -p.acceleration[0].dot(along);
  CHECK(normal == Approx(1e6 * 0.1 * dx / 2.0));
  if (radius == 0.0) CHECK(std::abs(held) < 1e-12 * normal);
  else CHECK(held == Approx(1e6 * 0.2 * 1e-3 / 2.0));   // the stretch of a millisecond, less than half of what pressing allows
}

TEST_CASE("a contact without damping gives back what it took", "[contact]") {
  Flight flight{.p = particle({0.5, 1.02}, {0.0, -2.0}), .contact = {}, .outline = Outline<2>::through(square, 0.0)};
  flight.contact.law.stiffness = 2e6;
  const bool steep = GENERATE(false, true);
  if (steep) flight.contact.law.lennard_jones = LennardJones{.coefficient = 40.0, .cut_off = 1.0};
  flight.look();
  double largest_stored = 0.0;
  for (int k = 0; k < 4000; ++k) {
    flight.step();
    const double kinetic = flight.p.velocity[0].squaredNorm();   // m/2 = 1
    CHECK(kinetic + flight.contact.last().stored == Approx(4.0).epsilon(steep ? 2e-2 : 1e-3));
    largest_stored = std::max(largest_stored, flight.contact.last().stored);
  }
  CHECK(largest_stored > 3.5);
  CHECK(flight.p.velocity[0][1] == Approx(2.0).epsilon(1e-3));
  CHECK(flight.contact.last().touching == 0);
  CHECK(std::abs(flight.contact_energy) < 4e-3);
  CHECK(flight.contact.impulse()[1] == Approx(-8.0).epsilon(1e-3));
}

TEST_CASE("a damped contact takes energy and never pulls", "[contact]") {
  Flight flight{.p = particle({0.5, 1.006}, {0.0, -1.0}), .contact = {}, .outline = Outline<2>::through(square, 0.0)};
  flight.contact.law.stiffness = 2e6;
  flight.contact.law.damping = 0.5;
  flight.look();
  for (int k = 0; k < 2000; ++k) {
    flight.step();
    CHECK(flight.contact.last().force[1] <= 0.0);
  }
  CHECK(flight.p.velocity[0][1] > 0.0);
  CHECK(flight.p.velocity[0][1] < 0.5);
  CHECK(flight.contact_energy == Approx(1.0 - flight.p.velocity[0].squaredNorm()).epsilon(1e-3));
}

TEST_CASE("a block sticks on a slope up to the angle of friction and slides beyond it", "[contact]") {
  const double friction = 0.5, angle = GENERATE(0.3, 0.4, 0.48, 0.6);   // atan 0.5 = 0.4636
  Flight flight{.p = particle({0.5, 1.00495}, {0.0, 0.0}), .contact = {}, .outline = Outline<2>::through(square, 0.0)};
  flight.g = 9.81 * Vector<2>(std::sin(angle), -std::cos(angle));
  flight.contact.law = {.stiffness = 4e5,
                        .damping = 0.5,
                        .friction = friction,
                        .adhesion = 0.0,
                        .sticking_stiffness = 4e5,
                        .reach = 0.5,
                        .lennard_jones = {}};
  flight.look();
  for (int k = 0; k < 20000; ++k) flight.step();   // 0.2 s
  const double slide = flight.p.position[0][0] - 0.5;
  if (std::tan(angle) < friction) {
    CHECK(slide < 2e-4);
    CHECK(flight.p.velocity[0].norm() < 5e-2);
  } else {
    const double a = 9.81 * (std::sin(angle) - friction * std::cos(angle));
    CHECK(flight.p.velocity[0][0] == Approx(a * flight.time).margin(0.02));   // landing takes a little
    CHECK(flight.contact.slipped() == Approx(friction * 2.0 * 9.81 * std::cos(angle) * slide).epsilon(0.05));
  }
}

TEST_CASE("adhesion holds a block without pressure", "[contact]") {
  const double pull = GENERATE(0.4, 1.2);   // of the adhesion
  Flight flight{.p = particle({0.5, 1.004999}, {0.0, 0.0}), .contact = {}, .outline = Outline<2>::through(square, 0.0)};
  flight.contact.law = {.stiffness = 1.0,
                        .damping = 0.0,
                        .friction = 0.0,
                        .adhesion = 500.0,
                        .sticking_stiffness = 4e5,
                        .reach = 0.5,
                        .lennard_jones = {}};
  flight.g = {pull * 500.0 * dx / 2.0, 0.0};
  flight.look();
  for (int k = 0; k < 5000; ++k) flight.step();
  const double slide = flight.p.position[0][0] - 0.5;
  if (pull < 1.0) CHECK(slide < 2.0 * pull * 500.0 * dx / 4e5 * 1.05);   // the stretch of a load that comes suddenly
  else CHECK(slide > 2e-4);
}

TEST_CASE("a rigid body moves as prescribed", "[contact]") {
  RigidBody<2> body{.contact = {},
                    .outline = Outline<2>::through(square, 0.0),
                    .start = square,
                    .displacement = [](double t) { return Vector<2>(2.0 * t, 0.0); },
                    .velocity = [](double) { return Vector<2>(2.0, 0.0); }};
  body.move(0.5);
  CHECK((body.outline.position[2] - Vector<2>(2.0, 1.0)).norm() < 1e-15);
  CHECK((body.outline.velocity[0] - Vector<2>(2.0, 0.0)).norm() < 1e-15);
}
