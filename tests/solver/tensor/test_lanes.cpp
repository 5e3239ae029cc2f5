// Eight at a time must be eight times one.
#include "tests/catch.hpp"

#include <vector>

#include "solver/tensor/lanes.hpp"

namespace furrow {

TEST_CASE("gathers fetch the components of the particles asked for", "[tensor][lanes]") {
  std::vector<double> number(50);
  std::vector<Vector<3>> vector(50);
  std::vector<Matrix<2>> matrix(50);
  for (int i = 0; i < 50; ++i) {
    const auto k = static_cast<std::size_t>(i);
    number[k] = i;
    vector[k] = {i + 0.1, i + 0.2, i + 0.3};
    matrix[k] << i + 0.11, i + 0.12, i + 0.21, i + 0.22;
  }
  const std::int32_t indices[lane_count] = {49, 0, 7, 7, 31, 2, 48, 16};
  const LaneIndex j = load_index(indices);
  const Lanes n = gather(number.data(), j);
  const LaneVector<3> v = gather<3>(vector.data(), j);
  const LaneMatrix<2> m = gather<2>(matrix.data(), j);
  for (int l = 0; l < lane_count; ++l) {
    const auto k = static_cast<std::size_t>(indices[l]);
    CHECK(n[l] == number[k]);
    for (int a = 0; a < 3; ++a) CHECK(v[a][l] == vector[k][a]);
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b) CHECK(m(a, b)[l] == matrix[k](a, b));
  }
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
