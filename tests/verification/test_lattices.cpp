// Arrangements of particles: the neighbours and the volume that each lattice is known for.
#include "tests/catch.hpp"

#include <algorithm>
#include <stdexcept>

#include "verification/lattices.hpp"

namespace furrow {
namespace {

template <int Dim>
bool every_particle_has(const Arrangement<Dim>& a, int neighbours) {
  return std::all_of(a.neighbours.count.begin(), a.neighbours.count.end(), [=](int n) { return n == neighbours; });
}

}  // namespace

TEST_CASE("periodic lattices give every particle its neighbours and fill the box", "[verification][lattices]") {
  constexpr double dx = 0.01;
  CHECK(every_particle_has(arranged(square_lattice<1>({8}, dx, true), 1.0, 1.01 * dx), 2));
  CHECK(every_particle_has(arranged(square_lattice<2>({8, 7}, dx, true), 1.0, 1.01 * dx), 4));
  CHECK(every_particle_has(arranged(hexagonal_lattice({8, 5}, dx, true), 1.0, 1.01 * dx), 6));
  CHECK(every_particle_has(arranged(square_lattice<3>({5, 6, 7}, dx, true), 1.0, 1.01 * dx), 6));
  CHECK(every_particle_has(arranged(fcc_lattice({3, 4, 3}, dx, true), 1.0, 1.01 * dx), 12));
  const Points<3> fcc = fcc_lattice({3, 4, 3}, dx, true);
  CHECK(fcc.volume * static_cast<double>(fcc.position.size()) == Approx(fcc.box.length.prod()));
  const Points<2> hexagonal = hexagonal_lattice({8, 5}, dx, true);
  CHECK(hexagonal.volume * static_cast<double>(hexagonal.position.size()) == Approx(hexagonal.box.length.prod()));
  CHECK_THROWS_AS(square_lattice<2>({0, 4}, dx, true), std::invalid_argument);
}

TEST_CASE("jitter moves points by no more than asked, repeats, and stays in the box", "[verification][lattices]") {
  const Points<2> regular = square_lattice<2>({20, 20}, 0.1, true);
  const Points<2> points = jittered(regular, 0.2, 7), again = jittered(regular, 0.2, 7), other = jittered(regular, 0.2, 8);
  double largest = 0.0;
  for (std::size_t i = 0; i < points.position.size(); ++i) {
    largest = std::max(largest, points.box.displacement(points.position[i], regular.position[i]).cwiseAbs().maxCoeff());
    CHECK((points.position[i].array() >= 0.0).all());
    CHECK((points.position[i].array() < 2.0).all());
  }
  CHECK(largest <= 0.02);
  CHECK(largest > 0.0195);   // the largest of 800 even numbers
  CHECK(points.position == again.position);
  CHECK(points.position != other.position);
}

TEST_CASE("an arrangement refuses a kernel that reaches further than its neighbours", "[verification][lattices]") {
  const Arrangement<2> a = arranged(square_lattice<2>({8, 8}, 1.0, true), 1000.0, 2.4);
  CHECK_NOTHROW(a.stencil(CubicSpline{}, 1.2));
  CHECK_THROWS_AS(a.stencil(CubicSpline{}, 1.21), std::logic_error);
  CHECK(a.volume()[5] == Approx(1.0));
}

}  // namespace furrow
