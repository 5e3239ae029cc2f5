// The independent kernels against numbers and closed forms of the literature.
#include "tests/catch.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "reference/exact/kernels.hpp"
#include "reference/exact/quadrature.hpp"

namespace furrow::exact {
namespace {
constexpr double pi = std::numbers::pi;
const std::string all_kernels[] = {"cubic_spline", "quintic_spline", "wendland_c2", "wendland_c4"};

double transform_of(const Kernel& W, double k) {
  return fourier_transform([&](double r) { return W.value(r, 1.0); }, W.support(), W.dimension(), k);
}
}  // namespace

TEST_CASE("normalisations that follow from the polynomials are those in print", "[reference]") {
  CHECK(kernel("cubic_spline", 1).normalisation() == Approx(2.0 / 3.0).epsilon(1e-14));
  CHECK(kernel("cubic_spline", 2).normalisation() == Approx(10.0 / (7.0 * pi)).epsilon(1e-14));
  CHECK(kernel("cubic_spline", 3).normalisation() == Approx(1.0 / pi).epsilon(1e-14));
  CHECK(kernel("quintic_spline", 1).normalisation() == Approx(1.0 / 120.0).epsilon(1e-14));
  CHECK(kernel("quintic_spline", 2).normalisation() == Approx(7.0 / (478.0 * pi)).epsilon(1e-14));
  CHECK(kernel("quintic_spline", 3).normalisation() == Approx(1.0 / (120.0 * pi)).epsilon(1e-13));
  CHECK(kernel("wendland_c2", 1).normalisation() == Approx(5.0 / 8.0).epsilon(1e-14));
  CHECK(kernel("wendland_c2", 2).normalisation() == Approx(7.0 / (4.0 * pi)).epsilon(1e-14));
  CHECK(kernel("wendland_c2", 3).normalisation() == Approx(21.0 / (16.0 * pi)).epsilon(1e-14));
  CHECK(kernel("wendland_c4", 1).normalisation() == Approx(3.0 / 4.0).epsilon(1e-14));
  CHECK(kernel("wendland_c4", 2).normalisation() == Approx(9.0 / (4.0 * pi)).epsilon(1e-13));
  CHECK(kernel("wendland_c4", 3).normalisation() == Approx(495.0 / (256.0 * pi)).epsilon(1e-13));
}

TEST_CASE("second moments are those in print", "[reference]") {
  CHECK(kernel("cubic_spline", 2).second_moment() == Approx(0.31633).margin(5e-6));
  CHECK(kernel("wendland_c2", 2).second_moment() == Approx(0.27778).margin(5e-6));
  CHECK(kernel("quintic_spline", 2).second_moment() == Approx(0.48309).margin(5e-6));
  CHECK(kernel("cubic_spline", 1).second_moment() == Approx(1.0 / 3.0).epsilon(1e-14));   // a B-spline of order n: n/12
  CHECK(kernel("quintic_spline", 1).second_moment() == Approx(0.5).epsilon(1e-14));
}

TEST_CASE("Wendland's polynomials are his integrals of the truncated power", "[reference]") {
  // phi_(l,k) = I^k (1 - r)^l with (I f)(r) = integral of t f(t) from r to 1: C2 is l = 2, 3 and k = 1, C4 is l = 3, 4 and k = 2.
  const auto once = [](const Radial& f) {
    return Radial([f](double r) { return integrate([&](double t) { return t * f(t); }, r, 1.0); });
  };
  const auto power = [](int l) { return Radial([l](double r) { return std::pow(1.0 - r, l); }); };
  const struct { const char* name; int dimension; Radial phi; } rows[] = {
      {"wendland_c2", 1, once(power(2))},
      {"wendland_c2", 3, once(power(3))},
      {"wendland_c4", 1, once(once(power(3)))},
      {"wendland_c4", 3, once(once(power(4)))},
  };
  for (const auto& row : rows) {
    const Kernel W = kernel(row.name, row.dimension);
    for (const double r : {0.1, 0.45, 0.8, 0.97}) {
      CHECK(W.value(2.0 * r, 1.0) / W.value(0.0, 1.0) == Approx(row.phi(r) / row.phi(0.0)).margin(1e-12));
    }
  }
}

TEST_CASE("quadrature over the ball finds the exact moments", "[reference]") {
  const double h = 0.3;
  for (const std::string& name : all_kernels) {
    for (const int dimension : {1, 2, 3}) {
      const Kernel W = kernel(name, dimension);
      const Moments m = moments([&](double r) { return W.value(r, h); }, W.support() * h, dimension);
      CHECK(m.zeroth == Approx(1.0).epsilon(1e-12));
      CHECK(m.first == Approx(0.0).margin(1e-13));
      CHECK(m.second == Approx(W.second_moment() * h * h).epsilon(1e-12));
    }
  }
}

TEST_CASE("the derivative is the slope of the value", "[reference]") {
  for (const std::string& name : all_kernels) {
    for (const int dimension : {1, 2, 3}) {
      const Kernel W = kernel(name, dimension);
      const double h = 0.6, step = 1e-5;
      for (double r = 0.013; r < W.support() * h; r += 0.0171) {
        const double slope = (W.value(r + step, h) - W.value(r - step, h)) / (2.0 * step);
        CHECK(W.derivative(r, h) == Approx(slope).margin(1e-7 * W.value(0.0, h) / h));
      }
    }
  }
}

TEST_CASE("transforms of B-splines by quadrature are their closed forms", "[reference]") {
  for (const int dimension : {1, 3}) {
    for (const double k : {0.01, 0.5, 2.0, 5.0, 7.0, 8.5, 13.0}) {
      CHECK(transform_of(kernel("cubic_spline", dimension), k) == Approx(b_spline_transform(4, dimension, k)).margin(1e-13));
      CHECK(transform_of(kernel("quintic_spline", dimension), k) == Approx(b_spline_transform(6, dimension, k)).margin(1e-13));
    }
  }
  CHECK_THROWS_AS(b_spline_transform(4, 2, 1.0), std::invalid_argument);
}

TEST_CASE("a projection is the integral along lines", "[reference]") {
  for (const std::string& name : all_kernels) {
    const Kernel W = kernel(name, 2);
    for (const double x : {0.0, 0.3, 1.0, 1.7}) {
      const double summed = 2.0 * integrate([&](double y) { return W.value(std::hypot(x, y), 1.0); }, 0.0, W.support());
      CHECK(W.projection(x) == Approx(summed).margin(1e-11));
    }
    CHECK(W.projection(W.support()) == 0.0);
  }
}

TEST_CASE("the Hankel transform is the transform of the projection", "[reference]") {
  for (const std::string& name : all_kernels) {
    const Kernel W = kernel(name, 2);
    const Radial radial = [&](double r) { return W.value(r, 1.0); };
    for (const double k : {0.5, 3.0, 7.5}) {
      const double projected = fourier_transform_by_projection(W, k);
      CHECK(fourier_transform(radial, W.support(), 2, k) == Approx(projected).margin(1e-12));
    }
  }
  CHECK_THROWS_AS(fourier_transform_by_projection(kernel("cubic_spline", 3), 1.0), std::invalid_argument);
}

TEST_CASE("a transform that turns negative is found, one that does not is not", "[reference]") {
  const auto spline = negative_part([](double k) { return b_spline_transform(4, 3, k); }, 20.0, 0.05);
  CHECK(spline.found);
  CHECK(spline.begins == Approx(2.0 * pi).epsilon(1e-4));   // sinc^3(k/2) changes sign
  CHECK(spline.deepest < -1e-4);
  CHECK_FALSE(negative_part([](double k) { return std::exp(-k); }, 20.0, 0.05).found);
}

TEST_CASE("an unknown kernel or dimension is refused", "[reference]") {
  CHECK_THROWS_AS(kernel("gaussian", 2), std::invalid_argument);
  CHECK_THROWS_AS(kernel("cubic_spline", 4), std::invalid_argument);
  CHECK_THROWS_AS(kernel("cubic_spline", 0), std::invalid_argument);
  CHECK_THROWS_AS(moments([](double) { return 1.0; }, 1.0, 4), std::invalid_argument);
}

TEST_CASE("a quadrature without a finite result throws", "[reference]") {
  CHECK_THROWS_AS(integrate([](double x) { return std::exp(800.0 * x * x); }, 0.0, 2.0), std::runtime_error);
}

}  // namespace furrow::exact
