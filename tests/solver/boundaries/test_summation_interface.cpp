// The paper's interface: sums over the particles of two bodies give both the same momentum, strain neither when they move as one,
// and do not depend on how the particles are stored.
#include "solver/boundaries/summation_interface.hpp"

#include <algorithm>
#include <numeric>
#include <random>

#include "harness/soil_box.hpp"
#include "solver/coupled_simulation.hpp"
#include "tests/catch.hpp"

using namespace furrow;

namespace {

constexpr double dx = 0.01;

/// A block of 6 x 6 particles with its lower left corner at (x, 0), shaken out of its lattice, under a stress that varies.
Particles<2> block(double x, double density, unsigned seed) {
  Particles<2> p;
  const auto centres = rectangle({x, 0.0}, 0.06, 0.06, dx);
  resize(p, centres.size());
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-0.1 * dx, 0.1 * dx);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    p.id[i] = static_cast<std::int32_t>(i);
    p.position[i] = centres[i] + Vector<2>(shake(random), shake(random));
    p.velocity[i] = {30.0 * shake(random), 2.0 + 20.0 * shake(random)};
    p.density[i] = density;
    p.mass[i] = density * dx * dx;
    p.stress[i](0, 0) = 1e8 * shake(random);
    p.stress[i](1, 1) = 1e8 * shake(random);
    p.stress[i](0, 1) = p.stress[i](1, 0) = 1e8 * shake(random);
  }
  return p;
}

SummationInterface sums(bool repulsion) {
  SummationInterface s;
  s.smoothing_length = 1.3 * dx;
  if (repulsion) s.repulsion = LennardJones{.coefficient = 4.0, .cut_off = 1.2};
  s.repulsion_spacing = dx;
  return s;
}

const std::vector<std::uint8_t> everyone(36, 1);

}  // namespace

TEST_CASE("sums over two bodies give them equal and opposite momentum", "[summation]") {
  const bool repulsion = GENERATE(false, true);
  const Particles<2> soft = block(-0.06, 1500.0, 1), stiff = block(0.0, 2800.0, 2);
  SummationInterface s = sums(repulsion);
  s.find_pairs(soft, stiff, everyone);
  REQUIRE(s.candidates() > 50);
  std::vector<Vector<2>> a(36, Vector<2>::Zero()), f(36, Vector<2>::Constant(7.0));
  const auto pull = s.pull(soft, stiff, soft.velocity, a, f);
  Vector<2> on_soft = Vector<2>::Zero(), on_stiff = Vector<2>::Zero();
  double power = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < 36; ++i) {
    on_soft += soft.mass[i] * a[i];
    on_stiff += f[i];
    scale += f[i].norm();
    power += soft.mass[i] * a[i].dot(soft.velocity[i]);
  }
  REQUIRE(scale > 1.0);
  CHECK((on_soft + on_stiff).norm() < 1e-13 * scale);
  CHECK((on_stiff - pull.force).norm() < 1e-13 * scale);
  CHECK(pull.power == Approx(power));
  CHECK((pull.repulsion_power != 0.0) == repulsion);
}

TEST_CASE("the repulsion between two particles of different bodies is that of Lennard and Jones", "[summation]") {
  Particles<2> soft, stiff;
  resize(soft, 1);
  resize(stiff, 1);
  for (Particles<2>* p : {&soft, &stiff}) p->mass[0] = 0.3, p->density[0] = 1500.0;
  stiff.position[0] = {0.8 * dx, 0.0};
  SummationInterface s = sums(true);
  s.find_pairs(soft, stiff, std::vector<std::uint8_t>{1});
  std::vector<Vector<2>> a(1, Vector<2>::Zero()), f(1);
  s.pull(soft, stiff, soft.velocity, a, f);
  const double q = 1.2 / 0.8, expected = 0.3 * 4.0 * (std::pow(q, 12.0) - std::pow(q, 4.0)) / (0.8 * dx);
  CHECK(f[0][0] == Approx(expected));
  CHECK(0.3 * a[0][0] == Approx(-expected));
}

TEST_CASE("bodies that move as one do not strain each other; what differs strains both by the kernel's sum", "[summation]") {
  Particles<2> soft = block(-0.06, 1500.0, 1), stiff = block(0.0, 2800.0, 2);
  for (Particles<2>* p : {&soft, &stiff})
    for (auto& v : p->velocity) v = {3.0, -1.0};
  SummationInterface s = sums(false);
  s.find_pairs(soft, stiff, everyone);
  std::vector<Matrix<2>> L(36, Matrix<2>::Zero());
  s.strain_soft(soft, stiff, L);
  s.strain_stiff(soft, stiff, L);
  for (const auto& l : L) CHECK(l.norm() == 0.0);

  for (auto& v : soft.velocity) v += Vector<2>(2.0, 0.5);
  s.strain_stiff(soft, stiff, L);
  double most = 0.0;
  for (std::size_t j = 0; j < 36; ++j) {
    Matrix<2> expected = Matrix<2>::Zero();
    for (std::size_t i = 0; i < 36; ++i) {
      const Vector<2> x_ji = stiff.position[j] - soft.position[i];
      const Vector<2> grad = derivative<WendlandC2, 2>(x_ji.norm(), 1.3 * dx) / x_ji.norm() * x_ji;
      expected += soft.volume(i) * (soft.velocity[i] - stiff.velocity[j]) * grad.transpose();
    }
    most = std::max(most, expected.norm());
    CHECK((L[j] - expected).norm() < 1e-12 * (1.0 + expected.norm()));
  }
  CHECK(most > 10.0);
}

TEST_CASE("sums over two bodies know no order of particles, and only who takes part and is near", "[summation]") {
  Particles<2> soft = block(-0.06, 1500.0, 1);
  const Particles<2> stiff = block(0.0, 2800.0, 2);
  const auto forces = [&](const Particles<2>& p, const std::vector<std::uint8_t>& part, SummationInterface& s) {
    s.find_pairs(p, stiff, part);
    std::vector<Vector<2>> a(36, Vector<2>::Zero()), f(36);
    s.pull(p, stiff, p.velocity, a, f);
    return f;
  };
  SummationInterface first = sums(true), second = sums(true), third = sums(true), fourth = sums(true);
  const auto f = forces(soft, everyone, first);
  std::vector<std::int32_t> order(36);
  std::iota(order.begin(), order.end(), 0);
  std::reverse(order.begin(), order.end());
  Particles<2> turned = soft;
  permute(turned, order);
  CHECK(forces(turned, everyone, second) == f);
  for (const auto& none : forces(soft, std::vector<std::uint8_t>(36, 0), third)) CHECK(none.norm() == 0.0);

  Particles<2> far = soft;
  for (auto& x : far.position) x[0] -= 1.0;
  for (const auto& none : forces(far, everyone, fourth)) CHECK(none.norm() == 0.0);
  CHECK(forces(soft, everyone, fourth) == f);
}

TEST_CASE("sums over two bodies stay the same when bodies sort their particles after pairs were found", "[summation]") {
  Particles<2> soft = block(-0.06, 1500.0, 1), stiff = block(0.0, 2800.0, 2);
  SummationInterface s = sums(true);
  s.find_pairs(soft, stiff, everyone);
  struct ById {
    std::vector<Vector<2>> on_soft, on_stiff;
    std::vector<Matrix<2>> strain;
  };
  const auto all = [&] {
    std::vector<Vector<2>> a(36, Vector<2>::Zero()), f(36);
    std::vector<Matrix<2>> L(36, Matrix<2>::Zero());
    s.strain_stiff(soft, stiff, L);
    s.pull(soft, stiff, soft.velocity, a, f);
    ById sorted{std::vector<Vector<2>>(36), f, std::vector<Matrix<2>>(36)};
    for (std::size_t i = 0; i < 36; ++i) {
      sorted.on_soft[static_cast<std::size_t>(soft.id[i])] = a[i];
      sorted.strain[static_cast<std::size_t>(stiff.id[i])] = L[i];
    }
    return sorted;
  };
  const ById before = all();
  std::vector<std::int32_t> order(36);
  std::iota(order.rbegin(), order.rend(), 0);
  permute(soft, order);
  permute(stiff, order);
  const ById after = all();
  CHECK(after.on_soft == before.on_soft);
  CHECK(after.on_stiff == before.on_stiff);
  CHECK(after.strain == before.strain);
}

TEST_CASE("sums over two bodies want one step for both and present positions", "[summation]") {
  const auto blocks = [](Frame frame, bool single_rate) {
    auto coupled = std::make_unique<CoupledSimulation>();
    coupled->soft.body.material = LinearElastic::from_young(1500.0, 2e6, 0.25);
    coupled->stiff.body.material = LinearElastic::from_young(3000.0, 2e8, 0.3);
    for (Body<2>* body : {&coupled->soft.body, &coupled->stiff.body}) body->spacing = dx;
    coupled->stiff.body.scheme.frame = frame;
    coupled->soft.body.add(rectangle({-0.06, 0.0}, 0.06, 0.06, dx));
    coupled->stiff.body.add(rectangle({0.0, 0.0}, 0.06, 0.06, dx), {-1.0, 0.0});
    for (const int id : {0, 30, 35, 5}) {   // columns of six, from the lower left corner anticlockwise
      coupled->surface.ids.push_back(id);
      coupled->surface.start.push_back(coupled->stiff.body.particles.position[static_cast<std::size_t>(id)]);
    }
    coupled->surface.radius = 0.5 * dx;
    coupled->single_rate = single_rate;
    coupled->summation = sums(false);
    return coupled;
  };
  CHECK_THROWS_AS(blocks(Frame::current, false)->couple(), std::invalid_argument);
  CHECK_THROWS_AS(blocks(Frame::reference, true)->couple(), std::invalid_argument);

  const auto coupled = blocks(Frame::current, true);
  coupled->soft.watch.largest_imbalance = coupled->stiff.watch.largest_imbalance = 1e30;
  coupled->couple();
  coupled->soft.start();
  const Vector<2> before = coupled->soft.momentum() + coupled->stiff.momentum();
  for (int k = 0; k < 200; ++k) coupled->soft.step(1.0);
  const auto& I = coupled->impulses();
  REQUIRE(I.contact.norm() > 1e-3);
  CHECK((I.soil + I.contact + I.pending).norm() < 1e-12 * I.contact.norm());
  CHECK((coupled->soft.momentum() + coupled->stiff.momentum() + I.pending - before).norm() < 1e-10 * before.norm());
}
