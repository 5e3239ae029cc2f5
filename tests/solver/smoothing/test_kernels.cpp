// Every kernel of the list has the properties that make it a kernel; a new one is tested by being listed.
#include "tests/catch.hpp"

#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <variant>

#include "solver/smoothing/kernels.hpp"

namespace furrow {
namespace {

template <class Variant>
struct ListOf;
template <class... K>
struct ListOf<std::variant<K...>> {
  template <template <class...> class List>
  using as = List<K...>;
};
template <class... T>
struct TypeList {};
using Kernels = ListOf<AnyKernel>::as<TypeList>;

constexpr double h = 0.7;   // any length; not one, so that wrong powers of h show

/// Integral of W over the ball of the support: Gauss-Legendre with three points on fine intervals that end at the knots.
template <class K, int Dim>
double integral() {
  constexpr double pi = std::numbers::pi;
  constexpr int intervals = 600;
  const double width = K::support * h / intervals, offset = std::sqrt(0.6) / 2.0;
  double sum = 0.0;
  for (int i = 0; i < intervals; ++i) {
    for (const auto& [x, weight] : {std::pair{-offset, 5.0 / 18.0}, {0.0, 8.0 / 18.0}, {offset, 5.0 / 18.0}}) {
      const double r = (i + 0.5 + x) * width;
      const double shell = Dim == 1 ? 2.0 : Dim == 2 ? 2.0 * pi * r : 4.0 * pi * r * r;
      sum += weight * width * shell * value<K, Dim>(r, h);
    }
  }
  return sum;
}

template <class K, int Dim>
void check_derivative() {
  const double scale_of_slope = value<K, Dim>(0.0, h) / h, step = 1e-5 * h;
  for (int i = 1; i < 1000; ++i) {
    const double r = (i + 0.37) * K::support * h / 1000.0;
    const double difference = (value<K, Dim>(r + step, h) - value<K, Dim>(r - step, h)) / (2.0 * step);
    CHECK(derivative<K, Dim>(r, h) == Approx(difference).margin(1e-8 * scale_of_slope));
  }
  CHECK(derivative<K, Dim>(0.0, h) == 0.0);
}

template <class K, int Dim>
void check_shape() {
  const double radius = K::support * h;
  for (int i = 1; i < 2000; ++i) {
    const double r = i * radius / 2000.0;
    CHECK(value<K, Dim>(r, h) > 0.0);
    CHECK(derivative<K, Dim>(r, h) < 0.0);
  }
  CHECK(Shape<K, Dim>::w(K::support) == 0.0);
  CHECK(Shape<K, Dim>::dw(K::support) == 0.0);
  for (const double q : {1.0 + 1e-12, 1.5, 100.0}) {
    CHECK(value<K, Dim>(q * radius, h) == 0.0);
    CHECK(derivative<K, Dim>(q * radius, h) == 0.0);
  }
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a kernel integrates to one", "[smoothing]", Kernels) {
  CHECK(integral<TestType, 1>() == Approx(1.0).epsilon(1e-12));
  CHECK(integral<TestType, 2>() == Approx(1.0).epsilon(1e-12));
  CHECK(integral<TestType, 3>() == Approx(1.0).epsilon(1e-12));
}

TEMPLATE_LIST_TEST_CASE("a kernel's derivative is the slope of its value", "[smoothing]", Kernels) {
  check_derivative<TestType, 1>();
  check_derivative<TestType, 2>();
  check_derivative<TestType, 3>();
}

TEMPLATE_LIST_TEST_CASE("a kernel is positive, falls, and ends at its support", "[smoothing]", Kernels) {
  check_shape<TestType, 1>();
  check_shape<TestType, 2>();
  check_shape<TestType, 3>();
}

TEMPLATE_LIST_TEST_CASE("a kernel is found by its name", "[smoothing]", Kernels) {
  const auto found = kernel_by_name(TestType::name);
  REQUIRE(found);
  CHECK(std::holds_alternative<TestType>(*found));
  CHECK(support(*found) == TestType::support);
}

TEST_CASE("kernel names are listed once each, and others are not found", "[smoothing]") {
  const auto names = kernel_names();
  CHECK(std::set<std::string>(names.begin(), names.end()).size() == std::variant_size_v<AnyKernel>);
  CHECK_FALSE(kernel_by_name("gaussian"));
  CHECK_FALSE(kernel_by_name(""));
}

}  // namespace furrow
