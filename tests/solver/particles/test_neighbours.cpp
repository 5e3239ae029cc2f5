// Cells and neighbours against trying every pair.
#include "tests/catch.hpp"

#include <omp.h>

#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "tests/solver/cloud.hpp"

namespace furrow {
namespace {

/// The list of an arrangement against a search over all pairs; also what the header promises of the rows.
template <int Dim>
void check_list(const Arrangement<Dim>& a) {
  const NeighbourList& list = a.neighbours;
  const auto& x = a.particles.position;
  REQUIRE(list.size() == x.size());
  std::size_t wrong = 0, unpadded = 0, unordered = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::set<std::int32_t> expected;
    for (std::size_t j = 0; j < x.size(); ++j)
      if (j != i && shortest<Dim>(a.box, x[i], x[j]).norm() < list.reach) expected.insert(static_cast<std::int32_t>(j));
    const auto row = list.row(i);
    if (row.size() != expected.size() || std::set<std::int32_t>(row.begin(), row.end()) != expected) ++wrong;
    if ((list.begin[i + 1] - list.begin[i]) % lane_count != 0 || list.begin[i + 1] - list.begin[i] < list.count[i]) ++unpadded;
    for (auto k = list.begin[i] + list.count[i]; k < list.begin[i + 1]; ++k)
      if (list.index[static_cast<std::size_t>(k)] != static_cast<std::int32_t>(i)) ++unpadded;
    if (!std::is_sorted(row.begin(), row.end())) ++unordered;
  }
  CHECK(wrong == 0);
  CHECK(unpadded == 0);
  CHECK(unordered == 0);
}

}  // namespace

TEST_CASE("neighbours are those found by trying every pair", "[particles]") {
  for (const bool periodic : {false, true}) {
    INFO("periodic " << periodic);
    check_list(cloud<1>({60}, periodic, 2.6, 1));
    check_list(cloud<2>({23, 17}, periodic, 2.6, 2));
    check_list(cloud<3>({9, 8, 11}, periodic, 2.3, 3));
  }
}

TEST_CASE("boxes of one, two and three cells along an axis", "[particles]") {
  // Twice the reach is the least that a periodic box may be; then each neighbour cell is met from both sides.
  for (const int cells : {6, 7, 8, 9, 10, 12}) {
    INFO("cells " << cells);
    check_list(cloud<1>({cells}, true, 3.0, 4));
    check_list(cloud<2>({cells, 6}, true, 3.0, 5));
    check_list(cloud<3>({6, cells, 6}, true, 3.0, 6));
  }
  CHECK_THROWS_AS(cloud<2>({5, 20}, true, 3.0, 7), std::invalid_argument);
}

TEST_CASE("a block periodic in one direction only", "[particles]") {
  Points<2> points = jittered(square_lattice<2>({14, 12}, 1.0, true), 0.3, 8);
  points.box.length[1] = 0.0;
  check_list(arranged(points, 1.0, 2.5));
}

TEST_CASE("few particles, and one that has flown away", "[particles]") {
  Points<3> points{{{0.0, 0.0, 0.0}}, 1.0, 1.0, {}};
  check_list(arranged(points, 1.0, 2.0));
  points.position.push_back({1.0, 0.5, 0.0});
  check_list(arranged(points, 1.0, 2.0));
  points.position.push_back({1e12, -1e12, 1e12});
  check_list(arranged(points, 1.0, 2.0));
  points.position.push_back({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0});
  CHECK_THROWS_AS(arranged(points, 1.0, 2.0), std::runtime_error);
}

TEST_CASE("rows that are dropped are empty, and the others what they were", "[particles]") {
  const NeighbourList all = cloud<2>({13, 11}, false, 2.6, 9).neighbours;
  std::vector<std::uint8_t> keep(all.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = i % 3 == 1;
  NeighbourList some = all;
  drop_rows(some, keep);
  for (std::size_t i = 0; i < keep.size(); ++i) {
    const auto before = all.row(i), after = some.row(i);
    if (keep[i])
      CHECK(std::equal(before.begin(), before.end(), after.begin(), after.end()));
    else
      CHECK(after.empty());
    CHECK(some.begin[i + 1] - some.begin[i] == (keep[i] ? all.begin[i + 1] - all.begin[i] : 0));
  }
  CHECK(some.index.size() == static_cast<std::size_t>(some.begin.back()));
}

TEST_CASE("no particles at all", "[particles]") { CHECK(arranged(Points<2>{{}, 1.0, 1.0, {}}, 1.0, 2.0).neighbours.size() == 0); }

TEST_CASE("one thread and two give the same list", "[particles]") {
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Arrangement<3> one = cloud<3>({10, 9, 11}, true, 2.3, 9);
  for (const int threads : {2, 3}) {
    omp_set_num_threads(threads);
    const Arrangement<3> several = cloud<3>({10, 9, 11}, true, 2.3, 9);
    CHECK(several.neighbours.begin == one.neighbours.begin);
    CHECK(several.neighbours.index == one.neighbours.index);
    CHECK(several.neighbours.count == one.neighbours.count);
  }
  omp_set_num_threads(before);
}

TEST_CASE("sorting by cell keeps every particle with all that it carries", "[particles]") {
  const Points<2> points = jittered(square_lattice<2>({13, 9}, 1.0, false), 0.4, 10);
  const CellGrid<2> grid(points.position, 2.5, points.box);
  const CellOrder sorted = order_by_cell<2>(grid, points.position);
  REQUIRE(sorted.begin.size() == static_cast<std::size_t>(grid.total()) + 1);
  for (std::size_t c = 0; c + 1 < sorted.begin.size(); ++c)
    for (std::int32_t k = sorted.begin[c]; k < sorted.begin[c + 1]; ++k) {
      CHECK(grid.cell_of(points.position[static_cast<std::size_t>(sorted.order[static_cast<std::size_t>(k)])]) == static_cast<std::int32_t>(c));
      if (k > sorted.begin[c]) CHECK(sorted.order[static_cast<std::size_t>(k)] > sorted.order[static_cast<std::size_t>(k) - 1]);
    }

  Particles<2> p;
  resize(p, points.position.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.id[i] = static_cast<std::int32_t>(i);
    p.position[i] = points.position[i];
    p.mass[i] = static_cast<double>(i);
    p.stress[i].setConstant(static_cast<double>(i));
    p.damage[i] = static_cast<double>(i);
  }
  permute(p, sorted.order);
  std::set<std::int32_t> ids;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const auto id = static_cast<std::size_t>(p.id[k]);
    ids.insert(p.id[k]);
    CHECK(p.position[k] == points.position[id]);
    CHECK(p.mass[k] == static_cast<double>(id));
    CHECK(p.stress[k](2, 1) == static_cast<double>(id));
    CHECK(p.damage[k] == static_cast<double>(id));
  }
  CHECK(ids.size() == p.size());
}

TEST_CASE("the nearest image, one pair or eight", "[particles]") {
  Box<2> box;
  box.origin = {-1.0, 2.0};
  box.length = {4.0, 0.0};   // open in y
  CHECK((box.displacement({2.9, 5.0}, {-0.9, 2.0}) - Vector<2>(-0.2, 3.0)).norm() < 1e-15);
  CHECK((box.wrapped({3.5, 9.0}) - Vector<2>(-0.5, 9.0)).norm() < 1e-15);
  CHECK((box.wrapped({-9.5, 9.0}) - Vector<2>(2.5, 9.0)).norm() < 1e-15);
  LaneVector<2> d;
  for (int l = 0; l < lane_count; ++l) d[0][l] = -3.9 + l, d[1][l] = 10.0 * l;
  const LaneVector<2> nearest = nearest_image(d, box);
  for (int l = 0; l < lane_count; ++l) {
    CHECK(nearest[0][l] == Approx(box.displacement({d[0][l], 0.0}, {0.0, 0.0})[0]));
    CHECK(nearest[1][l] == d[1][l]);
  }
}

}  // namespace furrow
