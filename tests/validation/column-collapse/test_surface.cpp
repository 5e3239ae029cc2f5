// The surface of a heap: volume is kept, a slope is found where it is, an extrapolation moves it as its order says.
#include "tests/catch.hpp"
#include "validation/column-collapse/surface.hpp"

#include <cmath>

using namespace furrow::column_collapse_cases;

namespace {

/// Centres of cells of edge dx under the line h = height (1 - x/length).
std::vector<double> wedge(double length, double height, double dx) {
  std::vector<double> centres;
  for (double x = 0.5 * dx; x < length; x += dx)
    for (double y = 0.5 * dx; y < height * (1.0 - x / length); y += dx) centres.push_back(x);
  return centres;
}

}  // namespace

TEST_CASE("a block has its height up to its edge, and half of it in the window about the edge", "[column-collapse]") {
  std::vector<double> centres;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 20; ++j) centres.push_back(0.005 * (i + 0.5));
  const Surface s = surface_of(centres, 25e-6, 0.005, 0.01);
  CHECK(s.h[0] == Approx(0.1));
  CHECK(s.h[10] == Approx(0.1));
  CHECK(s.h[20] == Approx(0.05));
  CHECK(s.h[21] == Approx(0.0).margin(1e-12));
  CHECK(position_at(s, 0.05) == Approx(0.2));
}

TEST_CASE("the volume under the surface is that of the particles, wherever they lie", "[column-collapse]") {
  const std::vector<double> centres{0.001, 0.0137, 0.0151, 0.0329, 0.0999, 0.25};
  const Surface s = surface_of(centres, 3e-6, 0.002, 0.01);
  double volume = 0.5 * 0.01 * s.h[0];
  for (std::size_t k = 1; k < s.h.size(); ++k) volume += 0.01 * s.h[k];
  CHECK(volume == Approx(6 * 3e-6).epsilon(1e-12));
}

TEST_CASE("a slope is found where it is", "[column-collapse]") {
  const double dx = 0.001;
  const Surface s = surface_of(wedge(0.4, 0.1, dx), dx * dx, dx, 0.01);
  CHECK(position_at(s, 0.05) == Approx(0.2).margin(2 * dx));
  CHECK(position_at(s, 0.01) == Approx(0.36).margin(4 * dx));
  CHECK(position_at(s, 0.2) == 0.0);
  CHECK(farthest_at(s, 0.05) == Approx(position_at(s, 0.05)));
}

TEST_CASE("what lies apart from the heap is no part of it", "[column-collapse]") {
  const Surface s{{0.0, 0.1, 0.2, 0.3, 0.4, 0.5}, {0.1, 0.05, 0.0, 0.0, 0.04, 0.0}};
  CHECK(position_at(s, 0.02) == Approx(0.16));
  CHECK(farthest_at(s, 0.02) == Approx(0.45));
}

TEST_CASE("the distance of two surfaces is the root of the mean square of their heights' difference", "[column-collapse]") {
  const Surface flat{{0.0, 0.1, 0.2, 0.3}, {0.1, 0.1, 0.1, 0.1}}, lower{{0.0, 0.1, 0.2, 0.3}, {0.1, 0.08, 0.1, 0.1}};
  CHECK(distance(flat, flat, 0.3) == 0.0);
  CHECK(distance(lower, flat, 0.3) == Approx(0.01));
  CHECK(distance(lower, flat, 0.1) == Approx(0.02 / std::sqrt(2.0)));
  CHECK_THROWS_AS(distance(flat, flat, -1.0), std::invalid_argument);
}

TEST_CASE("extrapolation of the first order doubles the way from the coarse surface to the fine one", "[column-collapse]") {
  Surface fine, coarse;
  for (int k = 0; k <= 40; ++k) {
    fine.x.push_back(0.01 * k);
    coarse.x.push_back(0.0095 * k);
    fine.h.push_back(0.1 * (1.0 - k / 40.0));
    coarse.h.push_back(fine.h.back());
  }
  const Surface limit = extrapolated(fine, coarse, 0.01);
  for (const double h : {0.01, 0.03, 0.05, 0.09}) CHECK(position_at(limit, h) == Approx(2 * position_at(fine, h) - position_at(coarse, h)));
}
