#include "solver/boundaries/summation_interface.hpp"

#include <algorithm>
#include <cmath>

#include "solver/modules.hpp"

namespace furrow {
namespace {

/// Of h: by so much more than the reach pairs are looked for; they are kept until half of it is used up.
constexpr double skin = 0.5;

void index_by_id(const Particles<2>& p, std::vector<std::int32_t>& index) {
  index.resize(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) index[static_cast<std::size_t>(p.id[i])] = static_cast<std::int32_t>(i);
}

void positions_by_id(const Particles<2>& p, std::vector<Vector<2>>& position) {
  position.resize(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) position[static_cast<std::size_t>(p.id[i])] = p.position[i];
}

bool has_moved(const Particles<2>& p, const std::vector<Vector<2>>& from, double distance) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!((p.position[i] - from[static_cast<std::size_t>(p.id[i])]).squaredNorm() < distance * distance)) return true;
  return false;
}

Matrix<2> plane(const Tensor& stress) { return stress.topLeftCorner<2, 2>(); }

}  // namespace

double SummationInterface::reach() const {
  const double kernel_reach = support(kernel) * smoothing_length;
  return repulsion ? std::max(kernel_reach, repulsion->cut_off * repulsion_spacing) : kernel_reach;
}

bool SummationInterface::stale(const Particles<2>& soft, const Particles<2>& stiff) const {
  if (soft_at_build_.size() != soft.size() || stiff_at_build_.size() != stiff.size()) return true;
  const double quarter = 0.25 * skin * smoothing_length;   // half of the skin, and both bodies may move
  return has_moved(soft, soft_at_build_, quarter) || has_moved(stiff, stiff_at_build_, quarter);
}

void SummationInterface::find_pairs(const Particles<2>& soft, const Particles<2>& stiff,
                                    std::span<const std::uint8_t> takes_part) {
  has_run(Module::summation_interface);
  if (!stale(soft, stiff)) return;
  index_by_id(soft, soft_index_);
  positions_by_id(soft, soft_at_build_);
  positions_by_id(stiff, stiff_at_build_);
  candidates_.clear();
  const double far = reach() + skin * smoothing_length;
  Vector<2> low = Vector<2>::Constant(HUGE_VAL), high = -low;
  for (const Vector<2>& x : stiff_at_build_) low = low.cwiseMin(x), high = high.cwiseMax(x);
  for (std::size_t s = 0; s < soft.size(); ++s) {
    const Vector<2>& x = soft_at_build_[s];
    if (((x - low).array() < -far).any() || ((x - high).array() > far).any()) continue;
    if (!takes_part[static_cast<std::size_t>(soft_index_[s])]) continue;
    for (std::size_t t = 0; t < stiff.size(); ++t)
      if ((x - stiff_at_build_[t]).squaredNorm() < far * far)
        candidates_.push_back({static_cast<std::int32_t>(s), static_cast<std::int32_t>(t)});
  }
}

template <class Visit>
void SummationInterface::for_pairs(const Particles<2>& soft, const Particles<2>& stiff, Visit&& visit) {
  // Asked anew by each sum: a body may have sorted its particles since its pairs were found, even within the same step.
  index_by_id(soft, soft_index_);
  index_by_id(stiff, stiff_index_);
  const double h = smoothing_length, farthest = reach();
  std::visit(
      [&](auto k) {
        using K = decltype(k);
        for (const auto& [s, t] : candidates_) {
          const auto i = static_cast<std::size_t>(soft_index_[static_cast<std::size_t>(s)]);
          const auto j = static_cast<std::size_t>(stiff_index_[static_cast<std::size_t>(t)]);
          const Vector<2> x_ij = soft.position[i] - stiff.position[j];
          const double r = x_ij.norm();
          if (r >= farthest || r == 0.0) continue;
          visit(i, j, x_ij, r, Vector<2>(derivative<K, 2>(r, h) / r * x_ij));
        }
      },
      kernel);
}

void SummationInterface::strain_soft(const Particles<2>& soft, const Particles<2>& stiff, std::span<Matrix<2>> L) {
  for_pairs(soft, stiff, [&](std::size_t i, std::size_t j, const Vector<2>&, double, const Vector<2>& grad) {
    L[i] += stiff.volume(j) * (stiff.velocity[j] - soft.velocity[i]) * grad.transpose();
  });
}

void SummationInterface::strain_stiff(const Particles<2>& soft, const Particles<2>& stiff, std::span<Matrix<2>> L) {
  for_pairs(soft, stiff, [&](std::size_t i, std::size_t j, const Vector<2>&, double, const Vector<2>& grad) {
    L[j] -= soft.volume(i) * (soft.velocity[i] - stiff.velocity[j]) * grad.transpose();   // grad_j W = -grad_i W
  });
}

SummationInterface::Pull SummationInterface::pull(const Particles<2>& soft, const Particles<2>& stiff,
                                                  std::span<const Vector<2>> soft_velocity,
                                                  std::span<Vector<2>> soft_acceleration,
                                                  std::span<Vector<2>> stiff_force) {
  std::fill(stiff_force.begin(), stiff_force.end(), Vector<2>::Zero());
  Pull sum;
  const double d_0 = repulsion ? repulsion->cut_off * repulsion_spacing : 0.0;
  for_pairs(soft, stiff, [&](std::size_t i, std::size_t j, const Vector<2>& x_ij, double r, const Vector<2>& grad) {
    const Matrix<2> stress = plane(soft.stress[i]) / (soft.density[i] * soft.density[i]) +
                             plane(stiff.stress[j]) / (stiff.density[j] * stiff.density[j]);
    Vector<2> force = soft.mass[i] * stiff.mass[j] * stress * grad;   // on the soft particle
    if (r < d_0) {
      const double q = d_0 / r, form = std::pow(q, repulsion->steep) - std::pow(q, repulsion->flat);
      const Vector<2> push = soft.mass[i] * repulsion->coefficient * form / (r * r) * x_ij;
      force += push;
      sum.repulsion_power -= push.dot(soft_velocity[i] - stiff.velocity[j]);
    }
    soft_acceleration[i] += force / soft.mass[i];
    stiff_force[static_cast<std::size_t>(stiff.id[j])] -= force;
    sum.force -= force;
    sum.power += force.dot(soft_velocity[i]);
  });
  return sum;
}

}  // namespace furrow
