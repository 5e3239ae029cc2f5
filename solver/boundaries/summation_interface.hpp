// The paper's interface (Eqs 25, 26): near it "the differences in particle types are neglected", every sum runs over the particles
// of both bodies alike. An option, not the default: velocities of one body then strain the other, with its moduli, and what that
// does to stiff metal in soft soil a case shows.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "solver/boundaries/contact.hpp"
#include "solver/particles/fields.hpp"
#include "solver/smoothing/kernels.hpp"

namespace furrow {

/// Sums over pairs of a particle of a soft body and one of a stiff body, both in the present frame and without correction, as the
/// paper's other sums are. Pairs are taken in the order of the ids, whatever the order of the particles: threads and restarts
/// change no bit.
class SummationInterface {
 public:
  AnyKernel kernel = WendlandC2{};
  double smoothing_length = 0.0;   ///< h of pairs across the interface, m
  /// Force between particles of different bodies, so that they do not mix (Lennard-Jones form, Monaghan 1994). Here d is the
  /// distance of the two particles, m the mass of the soft one, d_0 in spacings of `repulsion_spacing` (m).
  std::optional<LennardJones> repulsion;
  double repulsion_spacing = 0.0;

  /// Pairs near enough now, of the soft particles that take part (by index). They are kept by id: either body may sort its particles
  /// before the sums.
  void find_pairs(const Particles<2>& soft, const Particles<2>& stiff, std::span<const std::uint8_t> takes_part);

  /// L_i += sum_j m_j/rho_j (v_j - v_i) (x) grad_i W_ij over particles j of the other body (Eqs 12, 13 across the interface).
  void strain_soft(const Particles<2>& soft, const Particles<2>& stiff, std::span<Matrix<2>> velocity_gradient);
  void strain_stiff(const Particles<2>& soft, const Particles<2>& stiff, std::span<Matrix<2>> velocity_gradient);

  struct Pull {
    Vector<2> force = Vector<2>::Zero();   ///< on the stiff body, N
    double power = 0.0;                    ///< W: of the forces on the soft body
    double repulsion_power = 0.0;          ///< W: what relative motion puts into the repulsion
  };
  /// a_i += m_j [sigma_i/rho_i^2 + sigma_j/rho_j^2] grad_i W_ij (Eq. 10 across the interface) and the repulsion; the same forces,
  /// opposite, on the stiff particles, by id, N.
  Pull pull(const Particles<2>& soft, const Particles<2>& stiff, std::span<const Vector<2>> soft_velocity,
            std::span<Vector<2>> soft_acceleration, std::span<Vector<2>> stiff_force);

  std::size_t candidates() const { return candidates_.size(); }

 private:
  double reach() const;
  bool stale(const Particles<2>& soft, const Particles<2>& stiff) const;
  /// visit(i, j, x_ij, r, grad_i W_ij) of each pair within reach.
  template <class Visit>
  void for_pairs(const Particles<2>& soft, const Particles<2>& stiff, Visit&& visit);

  std::vector<std::array<std::int32_t, 2>> candidates_;          ///< ids: soft, stiff
  std::vector<Vector<2>> soft_at_build_, stiff_at_build_;        ///< by id
  std::vector<std::int32_t> soft_index_, stiff_index_;           ///< by id
};

}  // namespace furrow
