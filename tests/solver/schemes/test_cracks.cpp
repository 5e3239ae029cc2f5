// Cracks: a facet separates what its plane lies between, a list is cut there and nowhere else, and a strip whose section has failed
// does not pull any more.
#include "solver/schemes/cracks.hpp"

#include <algorithm>

#include "harness/soil_box.hpp"
#include "solver/io/simulation_checkpoint.hpp"
#include "solver/simulation.hpp"
#include "tests/catch.hpp"

using namespace furrow;

namespace {

constexpr double dx = 0.01;

/// A strip of 30 by 4 particles under tension at its right end, whose left end is held. Lattice columns of four, left to right.
std::unique_ptr<Simulation<2>> strip(bool cracks) {
  auto s = std::make_unique<Simulation<2>>();
  Body<2>& body = s->body;
  body.material = LinearElastic::from_young(2000.0, 2e8, 0.3);
  body.spacing = dx;
  body.scheme.frame = Frame::reference;
  body.scheme.viscosity.reset();
  body.scheme.correction = Correction::quadratic;
  body.scheme.hourglass_damping = 0.1;
  body.scheme.smoothing_ratio = 1.3;
  body.scheme.cracks = cracks;
  body.add(rectangle({0.0, 0.0}, 0.3, 0.04, dx));
  s->control.courant = 0.3;
  return s;
}

std::int32_t id_at(const Body<2>& body, int column, int row) {
  const Vector<2> x((column + 0.5) * dx, (row + 0.5) * dx);
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    if ((body.particles.reference_position[i] - x).norm() < 0.1 * dx) return body.particles.id[i];
  FAIL("no such particle");
  return -1;
}

}  // namespace

TEST_CASE("a facet separates what lies on its two sides, and only where it is", "[cracks]") {
  const CrackFacet<2> facet{{0.5, 0.0}, {1.0, 0.0}, 0.3};
  CHECK(facet.separates({0.0, 0.0}, {1.0, 0.0}));
  CHECK(facet.separates({1.0, 0.2}, {0.0, 0.2}));
  CHECK(facet.separates({0.4, 0.1}, {0.6, 0.4}));         // crosses at 0.25
  CHECK_FALSE(facet.separates({0.0, 0.4}, {1.0, 0.4}));   // passes beyond its end
  CHECK_FALSE(facet.separates({0.0, 0.0}, {0.4, 0.0}));   // both before it
  CHECK_FALSE(facet.separates({0.6, -0.1}, {1.0, 0.1}));
}

TEST_CASE("the most stretched fibre of a deformation, seen in the undeformed body", "[cracks]") {
  const double angle = 0.4;
  Matrix<2> R, Q;
  R << std::cos(1.1), -std::sin(1.1), std::sin(1.1), std::cos(1.1);
  Q << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  const Matrix<2> U = Q * Vector<2>(1.3, 0.9).asDiagonal() * Q.transpose();
  CHECK((most_stretched<2>(R * U) - Vector<2>(std::cos(angle), std::sin(angle))).norm() < 1e-12);
}

TEST_CASE("a list is cut at the facets and keeps its other pairs in their order", "[cracks]") {
  const auto simulation = strip(true);
  Body<2>& body = simulation->body;
  body.refresh_neighbours(true);
  NeighbourList list = body.neighbours();
  const auto& X = body.particles.reference_position;
  const std::vector<CrackFacet<2>> facets{{{0.15, 0.02}, {1.0, 0.0}, 0.012}};
  cut_pairs<2>(list, X, facets);
  std::size_t gone = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    std::vector<std::int32_t> expected;
    for (const std::int32_t j : body.neighbours().row(i))
      if (!facets[0].separates(X[i], X[static_cast<std::size_t>(j)])) expected.push_back(j);
    const auto row = list.row(i);
    CHECK(std::vector<std::int32_t>(row.begin(), row.end()) == expected);
    CHECK((list.begin[i + 1] - list.begin[i]) % 8 == 0);
    for (std::int64_t k = list.begin[i] + list.count[i]; k < list.begin[i + 1]; ++k)
      CHECK(list.index[static_cast<std::size_t>(k)] == static_cast<std::int32_t>(i));
    gone += body.neighbours().row(i).size() - row.size();
  }
  CHECK(gone > 10);
}

TEST_CASE("failed particles that see none but failed ones are debris", "[cracks]") {
  const auto simulation = strip(true);
  Body<2>& body = simulation->body;
  body.refresh_neighbours(true);
  Particles<2>& p = body.particles;
  // Columns 14 and 15 fail: cracks before and behind column 15 leave it on its own.
  for (const int column : {14, 15})
    for (int row = 0; row < 4; ++row) p.crack_normal[body.index_of(id_at(body, column, row))] = {1.0, 0.0};
  NeighbourList list = body.neighbours();
  cut_pairs<2>(list, p.reference_position, crack_facets(p, dx));
  const std::size_t alone = body.index_of(id_at(body, 15, 1)), behind = body.index_of(id_at(body, 14, 1));
  REQUIRE(list.count[alone] == 3);   // the rest of its column
  drop_debris<2>(list, p);
  CHECK(list.count[alone] == 0);
  CHECK(list.count[behind] > 5);
  for (std::size_t i = 0; i < list.size(); ++i)
    for (const std::int32_t j : list.row(i)) CHECK(static_cast<std::size_t>(j) != alone);
}

TEST_CASE("a strip whose section has failed parts, and does not without cracks", "[cracks]") {
  const bool cracks = GENERATE(false, true);
  const auto s = strip(cracks);
  Body<2>& body = s->body;
  // The right half flies off; the left stands.
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    if (body.particles.position[i][0] > 0.15) body.particles.velocity[i] = {1.0, 0.0};
  for (int row = 0; row < 4; ++row) {
    auto& p = body.particles;
    const std::int32_t id = id_at(body, 14, row);
    const auto i = static_cast<std::size_t>(std::find(p.id.begin(), p.id.end(), id) - p.id.begin());
    p.damage[i] = 1.0;
    p.deformation_gradient[i] = Vector<2>(1.05, 1.0).asDiagonal();
  }
  s->start();
  s->run_until(2e-4);
  double left = 0.0;
  for (std::size_t i = 0; i < body.particles.size(); ++i)
    if (body.particles.reference_position[i][0] < 0.15) left += body.particles.mass[i] * body.particles.velocity[i][0];
  const double whole = 120 * 0.5 * 2000.0 * dx * dx;   // momentum of the half that flies
  if (cracks)
    CHECK(std::abs(left) < 1e-3 * whole);   // one step of the whole strip, until the crack opens
  else
    CHECK(left > 0.1 * whole);

  // What a restart finds is cut as well.
  if (!cracks) return;
  const auto resumed = strip(true);
  resume_from(checkpoint_of(*s), *resumed);
  CHECK(resumed->body.neighbours().index == body.neighbours().index);
}
