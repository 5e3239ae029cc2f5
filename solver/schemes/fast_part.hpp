// The part of a body in the reference frame that takes shorter steps than the rest: particles that are squeezed so much that their
// waves are the fastest, and those that see them. Seen for itself it is a small body with neighbours, images and kept pairs of its own.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/schemes/reference_sums.hpp"

namespace furrow {

/// The momentum sum of the reference frame splits by particles: a_i = 1/rho_0 sum_j V_j [A_i + A_j] grad_i W_ij, where each A pulls
/// at its own particle and at those that see it, action and reaction alike. The fast part holds the pulls of the squeezed ones; the
/// pulls of all others change slowly (Tuckerman, Berne & Martyna 1992 for the splitting of steps).
template <int Dim>
struct FastPart {
  std::vector<std::int32_t> particle;      ///< of the body, by rising index in both groups: the squeezed, then others that see them
  std::size_t squeezed = 0;                ///< how many of the first group there are
  std::vector<std::uint8_t> is_squeezed;   ///< of each particle of the body; empty where there is no fast part
  Images<Dim> images;
  NeighbourList strained;                  ///< rows of the squeezed: all that they see
  NeighbourList pulled;                    ///< the same, then rows of the others: the squeezed that they see
  PairWeights weights;                     ///< of `pulled`, and of `strained`, with which it begins
  std::vector<Vector<Dim>> position;       ///< in the reference configuration, with images as all that follow
  std::vector<Vector<Dim>> velocity;
  std::vector<Matrix<Dim>> A, rate;
  std::vector<Vector<Dim>> acceleration;   ///< by the pulls of the squeezed, without images
  std::vector<Vector<Dim>> path;           ///< since the step began, without images
  std::vector<Matrix<Dim>> correction;     ///< B of the squeezed; empty where all B = I

  bool empty() const { return particle.empty(); }
  std::size_t size() const { return particle.size(); }
  Stencil<Dim> stencil(const Stencil<Dim>& whole, const NeighbourList& rows) const {
    return {whole.kernel, whole.smoothing_length, whole.box, position, &rows, images.empty() ? nullptr : &images};
  }

  /// Chosen anew; `weights` and `correction` are those of the whole body. No particle squeezed leaves it empty.
  void choose(const Stencil<Dim>& whole, const PairWeights& weights, std::span<const Matrix<Dim>> correction,
              std::vector<std::uint8_t> squeezed);
};

/// The particles that a fast part should hold: those whose waves, of speed `speed` seen from the reference configuration, are faster
/// than a limit, which is chosen from a ladder so that steps by the fastest of either part cost least. `ratio` = how many times the
/// stable step of the slow part may be longer than that of the fast one at the same speed. None where it would save less than a fifth.
template <int Dim>
std::vector<std::uint8_t> worth_short_steps(const Stencil<Dim>& whole, std::span<const double> speed, double ratio);

}  // namespace furrow
