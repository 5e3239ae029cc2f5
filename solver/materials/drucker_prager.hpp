#pragma once

#include <algorithm>
#include <limits>

#include "solver/materials/concept.hpp"
#include "solver/materials/drucker_prager_cone.hpp"

namespace furrow {

/// How the stress of a Drucker-Prager soil is brought forward.
enum class DruckerPragerUpdate {
  return_map,    ///< elastic step, then the exact return along the flow to cone, cut-off or their corner (backward Euler)
  rate,          ///< the paper's Eqs 11 and 14, elastic part 2 G e_dot + K eps_dot_kk, one explicit step, then drift correction
  rate_printed   ///< the same with Eq. 11 as printed: 2 G eps_dot of the total strain rate
};

/// Elastic-perfectly plastic soil after Drucker & Prager with flow that need not be associated (paper Eqs 11 to 14): hypoelastic
/// with constant K and G, yield sqrt(J2) + alpha I1 = k, potential sqrt(J2) + beta I1, mean stress at most the cut-off.
struct DruckerPrager {
  static constexpr std::string_view name = "drucker_prager";

  double reference_density;   ///< kg/m^3
  double bulk_modulus;        ///< K, Pa
  double shear_modulus;       ///< G, Pa
  DruckerPragerCone cone;
  double tension_limit =
      std::numeric_limits<double>::infinity();   ///< largest mean stress, Pa, where the apex is not lower still
  DruckerPragerUpdate update = DruckerPragerUpdate::return_map;

  MaterialState initial_state() const {
    MaterialState state;
    state.density = reference_density;
    return state;
  }

  /// Largest value of I1, Pa.
  double cut_off() const { return 3.0 * std::min(tension_limit, cone.apex()); }

  /// f = sqrt(J2) + alpha I1 - k, Pa; plastic where it is 0.
  double yield_function(const Tensor& stress) const {
    return std::sqrt(j2(deviator(stress))) + cone.alpha * stress.trace() - cone.k;
  }

  MaterialState respond(MaterialState state, const Increment& increment) const {
    const Tensor before = state.stress;
    const Stress next = update == DruckerPragerUpdate::return_map ? returned(elastic(before, increment.strain))
                                                                  : drift_corrected(by_rate(before, increment.strain));
    state.stress = next.s + next.I1 / 3.0 * Tensor::Identity();

    const double middle_density = state.density * std::exp(0.5 * increment.strain.trace());
    if (next.plastic) {   // what is not elastic in the increment, by whichever way the stress was found
      const Tensor change = state.stress - before;
      const Tensor plastic_deviator = deviator(increment.strain) - deviator(change) / (2.0 * shear_modulus);
      const double plastic_volume = increment.strain.trace() - change.trace() / (3.0 * bulk_modulus);
      state.plastic_strain += std::sqrt(2.0 / 3.0) * plastic_deviator.norm();
      state.plastic_work += (double_contraction(next.s, plastic_deviator) + next.I1 / 3.0 * plastic_volume) / state.density;
    }
    state.internal_energy += 0.5 * double_contraction(before + state.stress, increment.strain) / middle_density;
    return state;
  }

  double sound_speed(const MaterialState& state) const {
    return std::sqrt((bulk_modulus + 4.0 / 3.0 * shear_modulus) / state.density);
  }

  double stored_energy(const MaterialState& state) const {
    const double mean = state.stress.trace() / 3.0;
    return (mean * mean / (2.0 * bulk_modulus) + j2(deviator(state.stress)) / (2.0 * shear_modulus)) / state.density;
  }

 private:
  struct Stress {
    Tensor s;
    double I1;
    bool plastic = false;
  };

  Stress elastic(const Tensor& stress, const Tensor& strain) const {
    return {deviator(stress) + 2.0 * shear_modulus * deviator(strain), stress.trace() + 3.0 * bulk_modulus * strain.trace()};
  }

  /// Along the flow d_sigma = -lambda (G s/sqrt(J2) + 3 K beta I) to the cone; along the hydrostatic axis to the cut-off; to
  /// their corner where neither alone ends inside the other. The apex is the corner of a cut-off that passes through it.
  Stress returned(Stress trial) const {
    const double J = std::sqrt(j2(trial.s)), highest = cut_off();
    const double f = J + cone.alpha * trial.I1 - cone.k;
    if (f <= 0.0 && trial.I1 <= highest) return trial;

    const double at_cut_off =
        cone.alpha > 0.0 ? std::max(0.0, cone.k - cone.alpha * highest) : cone.k;   // sqrt(J2) of the corner
    double J_new = J, I1_new = highest;
    if (J > at_cut_off) {   // not the cut-off alone
      const double lambda = f / (shear_modulus + 9.0 * bulk_modulus * cone.alpha * cone.beta);
      const double I1_cone = trial.I1 - 9.0 * bulk_modulus * cone.beta * lambda;
      I1_new = std::min(I1_cone, highest);
      J_new = I1_cone <= highest ? J - shear_modulus * lambda : at_cut_off;
    }
    return {J > 0.0 ? Tensor(trial.s * (J_new / J)) : Tensor(Tensor::Zero()), I1_new, true};
  }

  /// One explicit step of Eq. 11 with the multiplier of Eq. 14, where the point is plastic and loads (f >= 0 and lambda > 0).
  Stress by_rate(const Tensor& stress, const Tensor& strain) const {
    const Tensor s = deviator(stress);
    const double J = std::sqrt(j2(s)), K = bulk_modulus, G = shear_modulus;
    Stress next = elastic(stress, strain);
    if (update == DruckerPragerUpdate::rate_printed) next.I1 += 2.0 * G * strain.trace();
    const double on_surface = 1e-9 * (cone.k + cone.alpha * std::abs(stress.trace()));
    if (J > 0.0 && J + cone.alpha * stress.trace() - cone.k >= -on_surface) {
      const double lambda = (3.0 * cone.alpha * K * strain.trace() + G / J * double_contraction(s, strain)) /
                            (9.0 * cone.alpha * cone.beta * K + G);
      if (lambda > 0.0) {
        next.s -= lambda * G / J * s;
        next.I1 -= lambda * 9.0 * K * cone.beta;
        next.plastic = true;
      }
    }
    return next;
  }

  /// Bui et al. 2008: mean stress back to the cut-off, then the deviator scaled back to the cone at constant mean stress.
  Stress drift_corrected(Stress next) const {
    if (next.I1 > cut_off()) {
      next.I1 = cut_off();
      next.plastic = true;
    }
    const double J = std::sqrt(j2(next.s)), strength = std::max(0.0, cone.k - cone.alpha * next.I1);
    if (J > strength) {
      next.s *= strength / J;
      next.plastic = true;
    }
    return next;
  }
};
static_assert(Material<DruckerPrager>);

}  // namespace furrow
