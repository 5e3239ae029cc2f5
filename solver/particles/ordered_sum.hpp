#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace furrow {

/// Sums over particles that are the same to the last bit for any number of threads: f(i, sums) adds what particle i has to give;
/// blocks of particles are summed side by side, and the blocks one after the other. The order of the particles is not changed by
/// threads, so neither is the result.
template <std::size_t N, class F>
std::array<double, N> ordered_sum(std::size_t n, F&& f) {
  constexpr std::size_t block = 1024;
  const auto blocks = static_cast<std::int64_t>((n + block - 1) / block);
  static thread_local std::vector<std::array<double, N>> kept;
  std::vector<std::array<double, N>>& partial = kept;   // of the thread that asks, not of those that help
  partial.assign(static_cast<std::size_t>(blocks), {});
#pragma omp parallel for schedule(static)
  for (std::int64_t b = 0; b < blocks; ++b) {
    std::array<double, N> sums{};
    const std::size_t first = static_cast<std::size_t>(b) * block, last = std::min(n, first + block);
    for (std::size_t i = first; i < last; ++i) f(i, sums);
    partial[static_cast<std::size_t>(b)] = sums;
  }
  std::array<double, N> total{};
  for (const auto& sums : partial)
    for (std::size_t k = 0; k < N; ++k) total[k] += sums[k];
  return total;
}

/// f(i) for every particle, in parallel; f writes what belongs to particle i and nothing else.
template <class F>
void for_all(std::size_t n, F&& f) {
  const auto count = static_cast<std::int64_t>(n);
#pragma omp parallel for schedule(static)
  for (std::int64_t k = 0; k < count; ++k) f(static_cast<std::size_t>(k));
}

}  // namespace furrow
