// Eight at a time must be eight times one.
#include "tests/catch.hpp"

#include <vector>

#include "solver/tensor/lanes.hpp"

namespace furrow {

TEST_CASE("rows are turned into lanes", "[tensor][lanes]") {
  constexpr int quads = 3;
  std::vector<Quad> rows(50 * quads);
  for (std::size_t i = 0; i < 50; ++i)
    for (std::size_t k = 0; k < 4 * quads; ++k) rows[i * quads + k / 4][static_cast<int>(k % 4)] = static_cast<double>(100 * i + k);
  const std::int32_t j[lane_count] = {49, 0, 7, 7, 31, 2, 48, 16};
  const auto lanes = load_rows<quads>(rows.data(), j);
  for (std::size_t k = 0; k < 4 * quads; ++k)
    for (int l = 0; l < lane_count; ++l) CHECK(lanes[k][l] == static_cast<double>(100 * j[l]) + static_cast<double>(k));
}

TEST_CASE("numbers of the lanes that are near are written without gaps", "[tensor][lanes]") {
  const Lanes r2 = {0.5, 2.0, 0.1, 1.0, 0.9, 0.99, 3.0, 0.0};
  std::int32_t out[2 * lane_count] = {};
  CHECK(write_where_less(r2, 1.0, 0xffu, 40, out) == 5);
  CHECK(std::vector<std::int32_t>(out, out + 5) == std::vector<std::int32_t>{40, 42, 44, 45, 47});
  CHECK(write_where_less(r2, 1.0, 0x07u & ~0x01u, 40, out) == 1);
  CHECK(out[0] == 42);
}

TEST_CASE("products and sums over lanes are those of Eigen", "[tensor][lanes]") {
  Matrix<3> A;
  A << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  const Vector<3> u(0.5, -1.0, 2.0), v(3.0, 0.25, -2.0);
  const LaneMatrix<3> a = broadcast<3>(A);
  const LaneVector<3> lanes_u = broadcast<3>(u), lanes_v = broadcast<3>(v);
  CHECK(sum(a * lanes_u) == 8.0 * (A * u));
  CHECK(sum(dot(lanes_u, lanes_v)) == 8.0 * u.dot(v));
  LaneMatrix<3> outer;
  outer.add_outer(lanes_u, lanes_v);
  CHECK(sum(outer) == 8.0 * (u * v.transpose()));
  CHECK(sum(lanes_u - lanes_v) == 8.0 * (u - v));
  CHECK(sum(a + a) == 16.0 * A);
}

TEST_CASE("roots and positive parts, lane by lane", "[tensor][lanes]") {
  const Lanes a = {0.0, 1.0, 4.0, 9.0, 2.0, 1e-300, 1e300, 0.25}, b = {-1.0, 0.0, 2.0, -0.0, 3.0, -5.0, 1e-9, -1e-9};
  const Lanes root = square_root(a), positive = positive_part(b);
  for (int l = 0; l < lane_count; ++l) {
    CHECK(root[l] == std::sqrt(a[l]));
    CHECK(positive[l] == std::max(0.0, b[l]));
  }
}

}  // namespace furrow
