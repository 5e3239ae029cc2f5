// The norms that every error in a report goes through, of a field whose norms are integrals, on cells of two sizes.
#include <cmath>
#include <vector>

#include "harness/norms.hpp"
#include "verification/operators/problems.hpp"

namespace furrow::operator_cases {

Problem uneven_norms(const Parameters& input) {
  const double L = input.quantity("length", dimension::length, range::positive);
  const long pairs = input.integer("pairs", 2, 1000000);
  const double share = input.number("share", {0.0, 1.0, false, false});
  return [=](Run& run) {
    // e = x/L on pairs of cells of which the first takes this share.
    std::vector<double> field, length;
    const double pair = L / static_cast<double>(pairs);
    for (long k = 0; k < pairs; ++k) {
      const double begin = static_cast<double>(k) * pair;
      field.push_back((begin + 0.5 * share * pair) / L);
      length.push_back(share * pair);
      field.push_back((begin + 0.5 * (1.0 + share) * pair) / L);
      length.push_back((1.0 - share) * pair);
    }
    const FieldNorms found = norms(field, length);
    run.measure("l1", found.l1, "1", {0.5, 0.0});
    run.measure("l2", found.l2, "1", {1.0 / std::sqrt(3.0), 0.0});
    run.measure("linf", found.linf, "1", {1.0, 0.0});
  };
}

}  // namespace furrow::operator_cases
