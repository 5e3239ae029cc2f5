// Sums over particles: the same bits for any number of threads, and everything in them once.
#include "tests/catch.hpp"

#include <omp.h>

#include <cmath>

#include "solver/particles/ordered_sum.hpp"

namespace furrow {

TEST_CASE("a sum over particles does not know how many threads there are", "[particles]") {
  const auto run = [](std::size_t n, int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    const auto sums = ordered_sum<2>(n, [](std::size_t i, auto& sum) {
      sum[0] += std::sin(static_cast<double>(i)) * 1e6 / (1.0 + static_cast<double>(i));
      sum[1] += 1.0;
    });
    omp_set_num_threads(before);
    return sums;
  };
  for (const std::size_t n : {0ul, 1ul, 1023ul, 1024ul, 1025ul, 100000ul}) {
    const auto one = run(n, 1);
    CHECK(one[1] == static_cast<double>(n));
    CHECK(run(n, 2) == one);
    CHECK(run(n, 3) == one);
  }
}

TEST_CASE("for_all meets every particle once", "[particles]") {
  std::vector<int> met(5000, 0);
  for_all(met.size(), [&](std::size_t i) { ++met[i]; });
  CHECK(std::all_of(met.begin(), met.end(), [](int m) { return m == 1; }));
}

}  // namespace furrow
