#pragma once

#include <algorithm>
#include <cmath>

#include "solver/materials/concept.hpp"

namespace furrow {

/// Johnson-Cook damage (paper Eqs 23, 24; Johnson & Cook 1985): a point fractures when the sum of d_eps_p/eps_f reaches one, with
///   eps_f = [D1 + D2 exp(D3 s*)] [1 + D4 ln(rate ratio)] [1 + D5 T*],   s* = sigma_m/sigma_eq, tension positive.
/// Outside the triaxialities at which the constants were measured the fit is meaningless (it turns negative for 6061-T6 at
/// s* > 1.35), and the pressure noise of particles goes far outside: s* is clipped and eps_f has a floor.
///
/// A local law fails a point at eps_f wherever it lies, and a crack of one particle's width then costs the less energy the finer
/// the particles are. With softening_length l_c > 0 the sum only marks the onset; from there the strength falls linearly with
/// plastic strain to nothing at the plastic displacement eps_f l_c over one particle: energy per crack area about sigma_y eps_f
/// l_c/2 at every spacing.
struct JohnsonCookDamage {
  double D1, D2, D3, D4, D5;
  double lowest_triaxiality, highest_triaxiality;
  double least_fracture_strain;    ///< floor of eps_f, positive
  double softening_length = 0.0;   ///< l_c, m; 0: local
  double spacing = 0.0;            ///< particle spacing, m; used with softening_length
  bool printed_rate = false;       ///< Eq. 24 as printed: brackets misplaced, and plastic strain where its rate belongs
  bool keeps_tension = false;      ///< as printed: failure zeroes shear only

  struct Circumstances {
    double triaxiality;              ///< sigma_m/sigma_eq
    double rate_ratio;               ///< plastic strain rate over reference rate, at least 1
    double homologous_temperature;   ///< T*
    double plastic_strain;           ///< eps_p over 1; in the printed form only
  };

  double fracture_strain(const Circumstances& c) const {
    const double s = std::clamp(c.triaxiality, lowest_triaxiality, highest_triaxiality);
    const double E = D2 * std::exp(D3 * s), warm = 1.0 + D5 * c.homologous_temperature;
    const double eps_f = printed_rate ? (D1 + E * (1.0 + D4 * std::log(c.plastic_strain))) * warm
                                      : (D1 + E) * (1.0 + D4 * std::log(c.rate_ratio)) * warm;
    return std::max(eps_f, least_fracture_strain);
  }

  /// Adds what a plastic strain increment does to onset and damage.
  void accumulate(MaterialState& state, double d_eps_p, const Circumstances& c) const {
    if (d_eps_p <= 0.0) return;
    const double part = d_eps_p / fracture_strain(c);
    const double sum = state.fracture_onset + part;
    state.fracture_onset = std::min(1.0, sum);
    if (softening_length > 0.0)
      state.damage = std::min(1.0, state.damage + std::max(0.0, sum - 1.0) * spacing / softening_length);
    else
      state.damage = state.fracture_onset;
  }

  /// What is left of strength and of tensile pressure: 1 until fracture begins, 0 when failed.
  double integrity(const MaterialState& state) const {
    if (softening_length > 0.0) return 1.0 - state.damage;
    return state.damage < 1.0 ? 1.0 : 0.0;
  }
};

}  // namespace furrow
