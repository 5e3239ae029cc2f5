// The parts of a body in the reference frame that take shorter steps than the rest: particles that are squeezed so much that their
// waves are the fastest, and those that see them. Seen for itself each is a small body with neighbours, images and kept pairs of its
// own; the more squeezed, the shorter the steps.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/schemes/reference_sums.hpp"

namespace furrow {

/// The momentum sum of the reference frame splits by particles: a_i = 1/rho_0 sum_j V_j [A_i + A_j] grad_i W_ij, where each A pulls
/// at its own particle and at those that see it, action and reaction alike. Particles lie on rungs: those of rung 0 take the steps
/// of the body, those of each further rung several in one of the rung before it. A fast part holds the pulls of one rung, the pulls of
/// the rungs before it change slowly for it (Tuckerman, Berne & Martyna 1992 for the splitting of steps). Its particles are all that
/// move faster than in the part before: that rung, further ones, and those that see either. Impulses that come at a multiple of half
/// a period feed a mode which nothing damps (Ma, Izaguirre & Skeel 2003); what is squeezed so far flows, and bulk viscosity damps
/// it, and what is fed all the same the energy balance of a run shows.
template <int Dim>
struct FastPart {
  std::vector<std::int32_t> particle;      ///< of the body, by rising index in both groups: the rung's own, then others
  std::vector<std::int32_t> outer;         ///< the same particles in the part before, or in the body for the first
  std::size_t own = 0;                     ///< how many of the first group there are
  double slower_wave_number = 0.0;         ///< kappa of all slower rungs alone, with their most squeezed particle
  double viscous_power = 0.0;              ///< of the own, as of their last step, W
  Images<Dim> images;
  NeighbourList strained;                  ///< rows of the own: all that they see
  NeighbourList pulled;                    ///< the same, then rows of the others: the own that they see
  PairWeights weights;                     ///< of `pulled`, and of `strained`, with which it begins
  std::vector<Vector<Dim>> position;       ///< in the reference configuration, with images as all that follow
  std::vector<Vector<Dim>> velocity, mean_velocity;   ///< now, and over a step of this part
  std::vector<Matrix<Dim>> A, rate;
  std::vector<Vector<Dim>> acceleration;   ///< by the pulls of the own, without images
  std::vector<Vector<Dim>> path;           ///< since the step of the part before began, without images
  std::vector<Matrix<Dim>> correction;     ///< B of the own; empty where all B = I

  std::size_t size() const { return particle.size(); }
  Stencil<Dim> stencil(const Stencil<Dim>& whole, const NeighbourList& rows) const {
    return {whole.kernel, whole.smoothing_length, whole.box, position, &rows, images.empty() ? nullptr : &images};
  }

  /// The part of rung `number`, from 1; `weights` and `correction` are those of the whole body, `before` is the part of the rung
  /// before, none for the first.
  FastPart(const Stencil<Dim>& whole, const PairWeights& weights, std::span<const Matrix<Dim>> correction,
           std::span<const std::uint8_t> rung, int number, const FastPart* before);
};

/// As many as were tried: a rod at 484 m/s fills all three.
constexpr int most_fast_parts = 3;

/// The rung of each particle: by its waves' speed, `speed`, seen from the reference configuration, between limits that are chosen
/// from a ladder so that steps by the fastest of each rung cost least. `ratio` = how many times the stable step of slower rungs may
/// be longer than that of the fastest at the same speed. Empty where short steps would save less than a fifth.
template <int Dim>
std::vector<std::uint8_t> worth_short_steps(const Stencil<Dim>& whole, std::span<const double> speed, double ratio);

}  // namespace furrow
