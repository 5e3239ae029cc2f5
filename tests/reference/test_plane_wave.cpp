// Plane-wave factors against the wave speeds and the Fourier transform; levels of disorder against random arrangements.
#include "tests/catch.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "reference/exact/plane_wave.hpp"

namespace furrow::exact {

TEST_CASE("the gradient's factor along an axis is the wave speed of the lattice", "[reference]") {
  const Kernel W2 = kernel("cubic_spline", 2), W3 = kernel("wendland_c4", 3);
  for (const double wavelength : {40.0, 8.0, 4.0}) {
    const Point k{2.0 * std::numbers::pi / wavelength, 0.0, 0.0};
    CHECK(plane_wave_factors("hexagonal", W2, 1.3, k).gradient == Approx(lattice_wave_speed("hexagonal", W2, 1.3, wavelength)));
    CHECK(plane_wave_factors("fcc", W3, 1.3, k).gradient == Approx(lattice_wave_speed("fcc", W3, 1.3, wavelength)));
  }
  // A wave as long as the world: what the lattice makes of a constant and of a linear field.
  const PlaneWaveFactors longest = plane_wave_factors("square", W2, 1.2, {1e-5, 2e-5, 0.0});
  CHECK(longest.value == Approx(lattice_norms("square", W2, 1.2).unity).epsilon(1e-9));
  CHECK(longest.gradient == Approx(lattice_norms("square", W2, 1.2).gradient).epsilon(1e-9));
}

TEST_CASE("for h far above dx both factors are the Fourier transform", "[reference]") {
  const Kernel W = kernel("wendland_c4", 2);
  const double h = 8.0, k = 0.15;
  const double F = fourier_transform([&](double r) { return W.value(r, h); }, 2.0 * h, 2, k);
  for (const char* name : {"square", "hexagonal"}) {
    const PlaneWaveFactors factors = plane_wave_factors(name, W, h, {0.6 * k, 0.8 * k, 0.0});
    CHECK(factors.value == Approx(F).epsilon(1e-6));
    CHECK(factors.gradient == Approx(F).epsilon(1e-5));
  }
}

TEST_CASE("levels of disorder are those of random points", "[reference]") {
  constexpr int n = 32;
  const Kernel W = kernel("cubic_spline", 2);
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  for (const double fraction : {0.02, 0.1}) {
    std::vector<Point> x;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) x.push_back({i + fraction * even(generator), j + fraction * even(generator), 0.0});
    const PairSums sums = pair_sums(x, std::vector<double>(x.size(), 1.0), W, 1.5, {n, n, 0.0});
    double value = 0.0, gradient = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      value += std::pow(sums.unity[i] - 1.0, 2) / n / n;
      for (std::size_t a = 0; a < 2; ++a)
        for (std::size_t b = 0; b < 2; ++b) gradient += 0.5 * std::pow(sums.first[i][a][b] - (a == b ? 1.0 : 0.0), 2) / n / n;
    }
    const DisorderLevels levels = disorder_levels("square", W, 1.5, fraction);
    // 1024 points, correlated within a support of 28: a standard error of about 1/sqrt(2 * 1024/10).
    const double error = 0.07 + 10.0 * fraction * fraction;
    CHECK(std::sqrt(value) == Approx(levels.value).epsilon(error));
    CHECK(std::sqrt(gradient) == Approx(levels.gradient).epsilon(error));
  }
}

}  // namespace furrow::exact
