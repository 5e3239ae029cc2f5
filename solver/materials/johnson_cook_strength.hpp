#pragma once

#include <algorithm>
#include <cmath>

namespace furrow {

/// Johnson-Cook flow stress (paper Eqs 21, 22; Johnson & Cook 1983), and how it changes with each argument.
struct JohnsonCookStrength {
  double A, B;   ///< Pa
  double n, C, m;
  double reference_rate;          ///< eps_dot_0, 1/s
  double reference_temperature;   ///< T_ref, K
  double melting_temperature;     ///< T_melt, K

  struct FlowStress {
    double value;            ///< sigma_y, Pa
    double by_strain;        ///< d sigma_y / d eps_p, Pa; infinite at eps_p = 0 for n < 1
    double by_log_rate;      ///< d sigma_y / d ln eps_p_dot, Pa
    double by_temperature;   ///< d sigma_y / d T, Pa/K
  };

  /// T* = (T - T_ref)/(T_melt - T_ref), within 0 and 1.
  double homologous_temperature(double T) const {
    return std::clamp((T - reference_temperature) / (melting_temperature - reference_temperature), 0.0, 1.0);
  }

  /// Rate over reference rate, at least 1: the law does not soften below the rate at which A, B and n were measured.
  double rate_ratio(double rate) const { return std::max(1.0, rate / reference_rate); }

  /// sigma_y = [A + B eps_p^n] [1 + C ln(rate ratio)] [1 - T*^m].
  FlowStress flow_stress(double eps_p, double rate, double T) const {
    const double hardened = B == 0.0 ? 0.0 : B * std::pow(eps_p, n);
    const double ratio = rate_ratio(rate);
    const double theta = homologous_temperature(T);
    const double soft = theta > 0.0 ? std::pow(theta, m) : 0.0;
    const double Y = A + hardened, R = 1.0 + C * std::log(ratio), S = 1.0 - soft;
    const bool softening = theta > 0.0 && theta < 1.0;
    return {Y * R * S, hardened == 0.0 ? 0.0 : n * hardened / eps_p * R * S, ratio > 1.0 ? Y * C * S : 0.0,
            softening ? -Y * R * m * soft / (theta * (melting_temperature - reference_temperature)) : 0.0};
  }
};

}  // namespace furrow
