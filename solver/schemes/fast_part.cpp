#include "solver/schemes/fast_part.hpp"

#include <algorithm>

namespace furrow {
namespace {

/// Of a neighbour, or of what it is an image of.
template <int Dim>
std::size_t proper(const Stencil<Dim>& s, std::int32_t j) {
  return static_cast<std::size_t>(j) < s.size() ? static_cast<std::size_t>(j) : s.images->source_of(static_cast<std::size_t>(j));
}

/// Those from a rung on and those that see them.
template <int Dim, class Chosen>
std::vector<std::uint8_t> touched_by(const Stencil<Dim>& s, Chosen&& chosen) {
  std::vector<std::uint8_t> touched(s.size(), 0);
  for (std::size_t i = 0; i < s.size(); ++i)
    if (chosen(i)) {
      touched[i] = 1;
      for (const std::int32_t j : s.neighbours->row(i)) touched[proper(s, j)] = 1;
    }
  return touched;
}

/// What a choice of rungs costs, in steps of one particle per shortest step, and the best choice. A limit is one of a ladder of
/// speeds; a rung holds what is faster than its limit and not faster than the one before it.
class Costs {
 public:
  template <int Dim>
  Costs(const Stencil<Dim>& whole, std::span<const double> speed, double ratio) : particles_(static_cast<double>(whole.size())) {
    const double fastest = *std::max_element(speed.begin(), speed.begin() + static_cast<std::ptrdiff_t>(whole.size()));
    limits_.push_back({fastest, 1.0, 0.0, 0.0});
    for (double speed_limit = fastest / std::sqrt(2.0); speed_limit > 0.01 * fastest; speed_limit /= std::sqrt(2.0)) {
      Limit limit{speed_limit, 0.0, 0.0, 0.0};
      for (std::size_t i = 0; i < whole.size(); ++i) {
        limit.faster += speed[i] > speed_limit;
        if (speed[i] <= speed_limit) limit.rate = std::max(limit.rate, speed[i] / (ratio * fastest));
      }
      if (limit.faster > most_squeezed * particles_) break;
      if (limit.rate >= 1.0) continue;
      const auto touched = touched_by(whole, [&](std::size_t i) { return speed[i] > speed_limit; });
      limit.touched = static_cast<double>(std::count(touched.begin(), touched.end(), std::uint8_t{1}));
      limits_.push_back(limit);
    }
  }

  /// Speeds that part the rungs, the slowest first; none where that is not worth it.
  std::vector<double> best() {
    least_ = 0.8 * particles_;
    for (std::size_t k = 1; k < limits_.size(); ++k) {
      chain_.assign(1, k);
      look_further(limits_[k].rate, limits_[k].rate * particles_);
    }
    std::vector<double> speeds;
    for (const std::size_t k : best_) speeds.push_back(limits_[k].speed);
    return speeds;
  }

 private:
  // Of a particle of the rung and of one that moves with it, in steps of a particle of rung 0. A step itself costs so many of all
  // particles: a body and its quarter behind two planes of symmetry choose alike.
  static constexpr double of_own = 0.8, of_other = 0.15, of_step = 0.002;
  static constexpr double most_squeezed = 0.75;   ///< of the particles
  struct Limit {
    double speed;
    double rate;      ///< steps of what is not faster
    double faster, touched;   ///< particles faster than the limit, and with those that see them
  };

  /// With the rungs of `chain_` chosen, the last of them open: closes it, and tries each further one.
  void look_further(double outer_rate, double cost) {
    const Limit& slow = limits_[chain_.back()];
    for (std::size_t k = 0; k < chain_.back(); ++k) {
      if (k > 0 && chain_.size() == most_fast_parts) break;
      const double rate = outer_rate * std::ceil(limits_[k].rate / outer_rate);
      const double with = cost + rate * (of_own * (slow.faster - limits_[k].faster) + of_other * slow.touched + of_step * particles_);
      if (with >= least_) continue;
      if (k > 0) {
        chain_.push_back(k);
        look_further(rate, with);
        chain_.pop_back();
      } else {
        least_ = with;
        best_ = chain_;
      }
    }
  }

  double particles_, least_ = 0.0;
  std::vector<Limit> limits_;
  std::vector<std::size_t> chain_, best_;
};

}  // namespace

template <int Dim>
FastPart<Dim>::FastPart(const Stencil<Dim>& whole, const PairWeights& all, std::span<const Matrix<Dim>> B,
                        std::span<const std::uint8_t> rung, int number, const FastPart* before) {
  const std::size_t n = whole.size();
  const std::vector<std::uint8_t> touched = touched_by(whole, [&](std::size_t i) { return rung[i] >= number; });
  std::vector<std::int32_t> local(n, -1);
  for (const bool group : {true, false}) {
    for (std::size_t i = 0; i < n; ++i)
      if (touched[i] && (rung[i] == number) == group) {
        local[i] = static_cast<std::int32_t>(particle.size());
        particle.push_back(static_cast<std::int32_t>(i));
      }
    if (group) own = particle.size();
  }
  outer = particle;
  if (before) {
    std::vector<std::int32_t> there(n, -1);
    for (std::size_t l = 0; l < before->size(); ++l) there[static_cast<std::size_t>(before->particle[l])] = static_cast<std::int32_t>(l);
    for (std::int32_t& i : outer) i = there[static_cast<std::size_t>(i)];
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
      if (!whole_row && rung[proper(whole, j)] != number) continue;
      pulled.index.push_back(local_of(j));
      weights.slope.push_back(all.slope[first + k]);
      ++count;
    }
    pulled.count.push_back(count);
    for (; pulled.index.size() % lane_count != 0; weights.slope.push_back(0.0)) pulled.index.push_back(static_cast<std::int32_t>(l));
  };
  for (std::size_t l = 0; l < own; ++l) add_row(l, true);
  strained = pulled;
  strained.begin.push_back(static_cast<std::int64_t>(strained.index.size()));
  for (std::size_t l = own; l < particle.size(); ++l) add_row(l, false);
  pulled.begin.push_back(static_cast<std::int64_t>(pulled.index.size()));

  velocity.assign(position.size(), Vector<Dim>::Zero());
  mean_velocity = velocity;
  A.assign(position.size(), Matrix<Dim>::Zero());
  rate.assign(own, Matrix<Dim>::Zero());
  acceleration.assign(particle.size(), Vector<Dim>::Zero());
  path.resize(particle.size());
  for (std::size_t l = 0; l < own && !B.empty(); ++l) correction.push_back(B[static_cast<std::size_t>(particle[l])]);
}

template <int Dim>
std::vector<std::uint8_t> worth_short_steps(const Stencil<Dim>& whole, std::span<const double> speed, double ratio) {
  const std::vector<double> limits = Costs(whole, speed, ratio).best();
  std::vector<std::uint8_t> rung;
  if (limits.empty()) return rung;
  for (std::size_t i = 0; i < whole.size(); ++i)
    rung.push_back(static_cast<std::uint8_t>(std::count_if(limits.begin(), limits.end(), [&](double limit) { return speed[i] > limit; })));
  return rung;
}

#define FURROW_INSTANTIATE(Dim)                                                                                           \
  template struct FastPart<Dim>;                                                                                          \
  template std::vector<std::uint8_t> worth_short_steps<Dim>(const Stencil<Dim>&, std::span<const double>, double);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
