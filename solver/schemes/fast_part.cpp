#include "solver/schemes/fast_part.hpp"

#include <algorithm>

namespace furrow {
namespace {

/// Of a neighbour, or of what it is an image of.
template <int Dim>
std::size_t proper(const Stencil<Dim>& s, std::int32_t j) {
  return static_cast<std::size_t>(j) < s.size() ? static_cast<std::size_t>(j) : s.images->source_of(static_cast<std::size_t>(j));
}

/// Squeezed ones and those that see them.
template <int Dim>
std::vector<std::uint8_t> touched_by(const Stencil<Dim>& s, const std::vector<std::uint8_t>& squeezed) {
  std::vector<std::uint8_t> touched = squeezed;
  for (std::size_t i = 0; i < s.size(); ++i)
    if (squeezed[i])
      for (const std::int32_t j : s.neighbours->row(i)) touched[proper(s, j)] = 1;
  return touched;
}

}  // namespace

template <int Dim>
void FastPart<Dim>::choose(const Stencil<Dim>& whole, const PairWeights& all, std::span<const Matrix<Dim>> B,
                           std::vector<std::uint8_t> chosen) {
  particle.clear();
  squeezed = static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), std::uint8_t{1}));
  if (squeezed == 0) {
    is_squeezed.clear();
    return;
  }
  is_squeezed = std::move(chosen);
  const std::size_t n = whole.size();
  const std::vector<std::uint8_t> touched = touched_by(whole, is_squeezed);
  std::vector<std::int32_t> local(n, -1);
  for (const bool group : {true, false})
    for (std::size_t i = 0; i < n; ++i)
      if (touched[i] && (is_squeezed[i] != 0) == group) {
        local[i] = static_cast<std::int32_t>(particle.size());
        particle.push_back(static_cast<std::int32_t>(i));
      }
  std::vector<std::int32_t> local_image;
  images = whole.images ? whole.images->of_some(local, particle.size(), local_image) : Images<Dim>{};
  const auto local_of = [&](std::int32_t j) {
    const auto k = static_cast<std::size_t>(j);
    return k < n ? local[k] : local_image[k - n];
  };

  position.resize(particle.size() + images.size());
  for (std::size_t l = 0; l < particle.size(); ++l) position[l] = whole.position[static_cast<std::size_t>(particle[l])];
  images.fill_positions(position);

  const auto add_row = [&](std::size_t l, bool whole_row) {
    const auto i = static_cast<std::size_t>(particle[l]);
    const auto first = static_cast<std::size_t>(whole.neighbours->begin[i]);
    pulled.begin.push_back(static_cast<std::int64_t>(pulled.index.size()));
    std::int32_t count = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(whole.neighbours->count[i]); ++k) {
      const std::int32_t j = whole.neighbours->index[first + k];
      if (!whole_row && !is_squeezed[proper(whole, j)]) continue;
      pulled.index.push_back(local_of(j));
      weights.slope.push_back(all.slope[first + k]);
      ++count;
    }
    pulled.count.push_back(count);
    for (; pulled.index.size() % lane_count != 0; weights.slope.push_back(0.0)) pulled.index.push_back(static_cast<std::int32_t>(l));
  };
  pulled = {};
  weights = {};
  for (std::size_t l = 0; l < squeezed; ++l) add_row(l, true);
  strained = pulled;
  strained.begin.push_back(static_cast<std::int64_t>(strained.index.size()));
  for (std::size_t l = squeezed; l < particle.size(); ++l) add_row(l, false);
  pulled.begin.push_back(static_cast<std::int64_t>(pulled.index.size()));

  velocity.assign(position.size(), Vector<Dim>::Zero());
  A.assign(position.size(), Matrix<Dim>::Zero());
  rate.assign(squeezed, Matrix<Dim>::Zero());
  acceleration.assign(particle.size(), Vector<Dim>::Zero());
  path.resize(particle.size());
  correction.clear();
  for (std::size_t l = 0; l < squeezed && !B.empty(); ++l) correction.push_back(B[static_cast<std::size_t>(particle[l])]);
}

template <int Dim>
std::vector<std::uint8_t> worth_short_steps(const Stencil<Dim>& whole, std::span<const double> speed, double ratio) {
  // Cost in steps of one particle, and per length of the shortest step.
  constexpr double of_squeezed = 0.8, of_touched = 0.3, of_sub_step = 20.0;
  const std::size_t n = whole.size();
  const double fastest = *std::max_element(speed.begin(), speed.begin() + static_cast<std::ptrdiff_t>(n));
  double least = 0.8 * static_cast<double>(n);
  std::vector<std::uint8_t> best(n, 0), squeezed(n);
  for (double limit = fastest / std::sqrt(2.0); limit > 0.01 * fastest; limit /= std::sqrt(2.0)) {
    double slow = 0.0, count = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      squeezed[i] = speed[i] > limit;
      count += squeezed[i];
      if (!squeezed[i]) slow = std::max(slow, speed[i]);
    }
    if (count > 0.5 * static_cast<double>(n)) break;
    const std::vector<std::uint8_t> touched = touched_by(whole, squeezed);
    const auto all = static_cast<double>(std::count(touched.begin(), touched.end(), std::uint8_t{1}));
    const double steps = slow / (ratio * fastest);   // of the slow part, for one of the fast
    if (steps >= 1.0) continue;
    const double cost = steps * static_cast<double>(n) + of_squeezed * count + of_touched * all + of_sub_step;
    if (cost < least) {
      least = cost;
      best = squeezed;
    }
  }
  return best;
}

#define FURROW_INSTANTIATE(Dim)                                                                                           \
  template struct FastPart<Dim>;                                                                                          \
  template std::vector<std::uint8_t> worth_short_steps<Dim>(const Stencil<Dim>&, std::span<const double>, double);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
