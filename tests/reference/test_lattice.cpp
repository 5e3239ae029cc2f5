// Lattice sums against the table of numerical wave speeds (to its printed digits) and against each other.
#include "tests/catch.hpp"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include "reference/exact/lattice.hpp"

namespace furrow::exact {

TEST_CASE("wave speeds and gradient norms of the square lattice are those tabulated", "[reference]") {
  const double wavelengths[] = {40, 20, 10, 8, 6, 4, 2};
  const struct { const char* kernel; double h_over_dx, speed[7], gradient; } rows[] = {
      {"cubic_spline", 1.0, {1.0089, .9965, .9477, .9121, .8378, .6450, 0}, 1.01310},
      {"cubic_spline", 1.2, {.9853, .9691, .9065, .8619, .7722, .5581, 0}, 0.99079},
      {"cubic_spline", 1.3, {1.0037, .9834, .9062, .8520, .7450, .5037, 0}, 1.01054},
      {"cubic_spline", 1.5, {.9980, .9722, .8748, .8076, .6776, .4024, 0}, 1.00672},
      {"cubic_spline", 2.0, {.9835, .9380, .7743, .6688, .4834, .1785, 0}, 0.99910},
      {"wendland_c2", 1.2, {.9592, .9453, .8916, .8528, .7737, .5776, 0}, 0.96385},
      {"wendland_c2", 1.5, {.9895, .9661, .8777, .8162, .6967, .4376, 0}, 0.99740},
      {"wendland_c2", 2.0, {.9855, .9454, .7995, .7040, .5325, .2315, 0}, 0.99920},
      {"quintic_spline", 1.0, {.9948, .9772, .9094, .8614, .7656, .5415, 0}, 1.00080},
      {"quintic_spline", 1.3, {.9906, .9610, .8508, .7761, .6349, .3522, 0}, 1.00061},
  };
  for (const auto& row : rows) {
    const Kernel W = kernel(row.kernel, 2);
    INFO(row.kernel << " " << row.h_over_dx);
    CHECK(lattice_norms("square", W, row.h_over_dx).gradient == Approx(row.gradient).margin(5.1e-6));
    for (std::size_t i = 0; i < 7; ++i) {
      CHECK(lattice_wave_speed("square", W, row.h_over_dx, wavelengths[i]) == Approx(row.speed[i]).margin(5.1e-5));
    }
  }
}

TEST_CASE("lattices have the volume and the neighbours that they are known for", "[reference]") {
  const struct { const char* name; std::size_t within_1, within_2; } rows[] = {
      {"line", 3, 5}, {"square", 5, 13}, {"hexagonal", 7, 19}, {"cubic", 7, 33}, {"fcc", 13, 55}};
  for (const auto& row : rows) {
    CHECK(lattice(row.name, 1.001).points.size() == row.within_1);
    CHECK(lattice(row.name, 2.001).points.size() == row.within_2);
  }
  // The volume a point stands for, counted in a large ball.
  CHECK(static_cast<double>(lattice("hexagonal", 60.0).points.size()) * lattice("hexagonal", 1.0).volume ==
        Approx(3.14159265 * 60.0 * 60.0).epsilon(2e-3));
  CHECK(static_cast<double>(lattice("fcc", 25.0).points.size()) * lattice("fcc", 1.0).volume ==
        Approx(4.18879020 * 25.0 * 25.0 * 25.0).epsilon(5e-3));
  CHECK_THROWS_AS(lattice("diamond", 1.0), std::invalid_argument);
  CHECK_THROWS_AS(lattice_norms("fcc", kernel("cubic_spline", 2), 1.0), std::invalid_argument);
}

TEST_CASE("a lattice resolved ever better is the continuum", "[reference]") {
  for (const char* name : {"square", "hexagonal"}) {
    const LatticeNorms norms = lattice_norms(name, kernel("wendland_c4", 2), 8.0);
    CHECK(norms.unity == Approx(1.0).epsilon(1e-6));
    CHECK(norms.gradient == Approx(1.0).epsilon(1e-6));
  }
  for (const char* name : {"cubic", "fcc"}) {
    const LatticeNorms norms = lattice_norms(name, kernel("wendland_c4", 3), 6.0);
    CHECK(norms.unity == Approx(1.0).epsilon(1e-6));
    CHECK(norms.gradient == Approx(1.0).epsilon(1e-6));
  }
}

TEST_CASE("sums over all pairs of a periodic block are the lattice's", "[reference]") {
  constexpr int n = 8;
  constexpr double dx = 0.01, h = 1.3 * dx;
  std::vector<Point> x;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) x.push_back({i * dx, j * dx, 0.0});
  }
  const std::vector<double> volume(x.size(), dx * dx);
  const Kernel W = kernel("cubic_spline", 2);
  const PairSums sums = pair_sums(x, volume, W, h, {n * dx, n * dx, 0.0});
  const LatticeNorms norms = lattice_norms("square", W, 1.3);
  for (std::size_t i = 0; i < x.size(); ++i) {
    CHECK(sums.unity[i] == Approx(norms.unity).epsilon(1e-12));
    CHECK(sums.first[i][0][0] == Approx(norms.gradient).epsilon(1e-12));
    CHECK(sums.first[i][1][1] == Approx(norms.gradient).epsilon(1e-12));
    CHECK(sums.first[i][0][1] == Approx(0.0).margin(1e-12));
    CHECK(sums.gradient[i][0] * dx == Approx(0.0).margin(1e-12));
  }
  CHECK_THROWS_AS(pair_sums(x, volume, W, 4.0 * h, {n * dx, n * dx, 0.0}), std::invalid_argument);
  CHECK_THROWS_AS(pair_sums(x, {}, W, h, {0.0, 0.0, 0.0}), std::invalid_argument);
}

TEST_CASE("at a free edge the sums see what is missing", "[reference]") {
  // Three points on a line, the cubic spline with h = dx: W(0) = 2/3, W(1) = 1/6, dW/dr(1) = -1/2.
  const std::vector<Point> x{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}};
  const PairSums sums = pair_sums(x, {1.0, 1.0, 1.0}, kernel("cubic_spline", 1), 1.0, {});
  CHECK(sums.unity[0] == Approx(5.0 / 6.0));
  CHECK(sums.unity[1] == Approx(1.0));
  CHECK(sums.gradient[0][0] == Approx(0.5));
  CHECK(sums.gradient[1][0] == Approx(0.0).margin(1e-15));
  CHECK(sums.first[0][0][0] == Approx(0.5));
  CHECK(sums.first[1][0][0] == Approx(1.0));
}

}  // namespace furrow::exact
