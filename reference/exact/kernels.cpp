#include "reference/exact/kernels.hpp"

#include <gsl/gsl_sf_bessel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "reference/exact/quadrature.hpp"

namespace furrow::exact {
namespace {

constexpr double pi = std::numbers::pi;

/// Surface of the unit sphere in d dimensions: both ends of a line, circle, sphere.
double unit_sphere(int dimension) {
  if (dimension < 1 || dimension > 3) throw std::invalid_argument("dimension " + std::to_string(dimension) + " is not 1, 2 or 3");
  return dimension == 1 ? 2.0 : dimension == 2 ? 2.0 * pi : 4.0 * pi;
}

double sinc(double x) { return std::abs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x; }

/// d sinc/dx.
double sinc_slope(double x) {
  return std::abs(x) < 1e-2 ? x * (-1.0 / 3.0 + x * x / 30.0 - x * x * x * x / 840.0) : (std::cos(x) - sinc(x)) / x;
}

double power(double h, int n) {
  double p = 1.0;
  for (int k = 0; k < n; ++k) p *= h;
  return p;
}

/// Polynomials of r = q/2 as polynomials of q.
std::vector<long double> of_half(std::vector<long double> c) {
  long double factor = 1.0L;
  for (long double& coefficient : c) {
    coefficient *= factor;
    factor *= 0.5L;
  }
  return c;
}

}  // namespace

Kernel::Kernel(int dimension, std::vector<Piece> pieces) : dimension_(dimension), pieces_(std::move(pieces)) {
  if (pieces_.empty()) throw std::invalid_argument("a kernel needs a piece");
  normalisation_ = 1.0 / (unit_sphere(dimension_) * radial_moment(dimension_ - 1));
}

double Kernel::radial_moment(int power) const {
  long double sum = 0.0L, from = 0.0L;
  for (const Piece& piece : pieces_) {
    const long double to = piece.to;
    for (std::size_t n = 0; n < piece.coefficients.size(); ++n) {
      const int exponent = static_cast<int>(n) + power + 1;
      sum += piece.coefficients[n] * (std::pow(to, exponent) - std::pow(from, exponent)) / exponent;
    }
    from = to;
  }
  return static_cast<double>(sum);
}

double Kernel::value(double r, double h) const {
  const double q = r / h;
  for (const Piece& piece : pieces_) {
    if (q >= piece.to) continue;
    long double p = 0.0L;   // the terms cancel near the edge of the support
    for (auto c = piece.coefficients.rbegin(); c != piece.coefficients.rend(); ++c) p = p * q + *c;
    return normalisation_ * static_cast<double>(p) / power(h, dimension_);
  }
  return 0.0;
}

double Kernel::derivative(double r, double h) const {
  const double q = r / h;
  for (const Piece& piece : pieces_) {
    if (q >= piece.to) continue;
    long double p = 0.0L;
    for (std::size_t n = piece.coefficients.size() - 1; n > 0; --n) p = p * q + static_cast<double>(n) * piece.coefficients[n];
    return normalisation_ * static_cast<double>(p) / power(h, dimension_ + 1);
  }
  return 0.0;
}

double Kernel::second_moment() const {
  return normalisation_ * unit_sphere(dimension_) * radial_moment(dimension_ + 1) / dimension_;
}

double Kernel::projection(double x) const {
  // A_n = integral of (x^2 + y^2)^(n/2) from y = 0 to Y, where R^2 = x^2 + Y^2: (n + 1) A_n = Y R^n + n x^2 A_(n-2).
  const auto polynomial_up_to = [x](double R, const std::vector<long double>& c) {
    if (x >= R) return 0.0;
    const double Y = std::sqrt((R - x) * (R + x));
    std::vector<double> A(c.size() + 1);
    A[0] = Y;
    A[1] = 0.5 * (Y * R + (x > 0.0 ? x * x * std::log((R + Y) / x) : 0.0));
    for (std::size_t n = 2; n < c.size(); ++n) {
      const double order = static_cast<double>(n);
      A[n] = (Y * std::pow(R, order) + order * x * x * A[n - 2]) / (order + 1.0);
    }
    long double sum = 0.0L;
    for (std::size_t n = 0; n < c.size(); ++n) sum += c[n] * A[n];
    return static_cast<double>(sum);
  };
  double half = 0.0, from = 0.0;
  for (const Piece& piece : pieces_) {
    half += polynomial_up_to(piece.to, piece.coefficients) - polynomial_up_to(from, piece.coefficients);
    from = piece.to;
  }
  return 2.0 * normalisation_ * half;
}

Kernel kernel(std::string_view name, int dimension) {
  using Terms = std::vector<long double>;
  const bool line = dimension == 1;
  if (name == "cubic_spline") return {dimension, {{1.0, {1.0, 0.0, -1.5, 0.75}}, {2.0, {2.0, -3.0, 1.5, -0.25}}}};
  if (name == "quintic_spline") {
    return {dimension,
            {{1.0, {66.0, 0.0, -60.0, 0.0, 30.0, -10.0}},
             {2.0, {51.0, 75.0, -210.0, 150.0, -45.0, 5.0}},
             {3.0, {243.0, -405.0, 270.0, -90.0, 15.0, -1.0}}}};
  }
  if (name == "wendland_c2") {
    return {dimension,
            {{2.0, of_half(line ? Terms{1.0L, 0.0L, -6.0L, 8.0L, -3.0L}
                                : Terms{1.0L, 0.0L, -10.0L, 20.0L, -15.0L, 4.0L})}}};
  }
  if (name == "wendland_c4") {
    return {dimension,
            {{2.0, of_half(line ? Terms{1.0L, 0.0L, -7.0L, 0.0L, 35.0L, -56.0L, 35.0L, -8.0L}
                                : Terms{1.0L, 0.0L, -28.0L / 3.0L, 0.0L, 70.0L, -448.0L / 3.0L, 140.0L, -64.0L, 35.0L / 3.0L})}}};
  }
  throw std::invalid_argument("no kernel is called \"" + std::string(name) + "\"");
}

Moments moments(const Radial& W, double radius, int dimension) {
  // x = r cos(angle); on the line the "angle" is one of two directions.
  const auto over_directions = [&](const std::function<double(double)>& of_cosine, double absolute) {
    if (dimension == 1) return of_cosine(-1.0) + of_cosine(1.0);
    if (dimension == 2) return integrate([&](double t) { return of_cosine(std::cos(t)); }, 0.0, 2.0 * pi, absolute);
    return 2.0 * pi * integrate(of_cosine, -1.0, 1.0, absolute);
  };
  const auto moment = [&](int order) {
    const std::function<double(double)> along_ray = [&](double cosine) {
      const auto shell = [&](double r) { return power(r * cosine, order) * power(r, dimension - 1) * W(r); };
      return integrate(shell, 0.0, radius, 0.0);
    };
    return over_directions(along_ray, 1e-14 * power(radius, order));   // the first moment is zero: no relative error
  };
  unit_sphere(dimension);
  return {moment(0), moment(1), moment(2)};
}

double fourier_transform(const Radial& W, double radius, int dimension, double k) {
  const auto wave = [&](double r) {
    return dimension == 1 ? std::cos(k * r) : dimension == 2 ? r * gsl_sf_bessel_J0(k * r) : r * r * sinc(k * r);
  };
  return unit_sphere(dimension) * integrate([&](double r) { return W(r) * wave(r); }, 0.0, radius);
}

double fourier_transform_by_projection(const Kernel& kernel, double k) {
  if (kernel.dimension() != 2) throw std::invalid_argument("the transform by projection is written for the plane");
  const auto wave = [&](double x) { return std::cos(k * x) * kernel.projection(x); };
  return 2.0 * integrate(wave, 0.0, kernel.support(), 1e-12);   // the pieces cancel near the edge to about that
}

double b_spline_transform(int order, int dimension, double k) {
  const double x = 0.5 * k;
  if (dimension == 1) return std::pow(sinc(x), order);
  if (dimension != 3) throw std::invalid_argument("the transform of a B-spline has this closed form in 1 and 3 dimensions only");
  // F1' = order/2 sinc^(order-1) sinc', and -F1'/k tends to order/12 as k -> 0.
  return -12.0 / k * 0.5 * std::pow(sinc(x), order - 1) * sinc_slope(x);
}

NegativePart negative_part(const std::function<double(double)>& F, double k_max, double k_step) {
  NegativePart part;
  double before = 0.0;
  for (int i = 1; i * k_step <= k_max; ++i) {
    const double k = i * k_step, f = F(k);
    part.deepest = std::min(part.deepest, f);
    if (!part.found && f < 0.0) {
      double low = before, high = k;
      while (high - low > 1e-10) {
        const double middle = 0.5 * (low + high);
        (F(middle) < 0.0 ? high : low) = middle;
      }
      part.found = true;
      part.begins = 0.5 * (low + high);
    }
    before = k;
  }
  return part;
}

}  // namespace furrow::exact
