#include "harness/norms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace furrow {

FieldNorms norms(std::span<const double> field, std::span<const double> volume) {
  if (field.size() != volume.size() || field.empty())
    throw std::invalid_argument("a norm needs one volume for each value, and at least one value");
  double total = 0.0;
  FieldNorms result;
  bool finite = true;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const double e = std::abs(field[i]);
    finite = finite && std::isfinite(e);
    total += volume[i];
    result.l1 += volume[i] * e;
    result.l2 += volume[i] * e * e;
    result.linf = std::max(result.linf, e);
  }
  if (!(total > 0.0)) throw std::invalid_argument("the volumes of a norm must sum to a positive number");
  if (!finite) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan};
  }
  result.l1 /= total;
  result.l2 = std::sqrt(result.l2 / total);
  return result;
}

FieldNorms error_norms(std::span<const double> computed, std::span<const double> exact, std::span<const double> volume) {
  if (computed.size() != exact.size()) throw std::invalid_argument("an error norm needs one exact value for each computed one");
  std::vector<double> error(computed.size());
  std::transform(computed.begin(), computed.end(), exact.begin(), error.begin(), [](double c, double e) { return c - e; });
  return norms(error, volume);
}

FieldNorms relative_error_norms(std::span<const double> computed, std::span<const double> exact, std::span<const double> volume) {
  const FieldNorms error = error_norms(computed, exact, volume);
  const FieldNorms scale = norms(exact, volume);
  const auto ratio = [](double e, double s) { return s > 0.0 ? e / s : std::numeric_limits<double>::quiet_NaN(); };
  return {ratio(error.l1, scale.l1), ratio(error.l2, scale.l2), ratio(error.linf, scale.linf)};
}

}  // namespace furrow
