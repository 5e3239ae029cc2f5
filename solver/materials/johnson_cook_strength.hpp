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

  /// B eps_p^n and T*^m with what they are powers of.
  struct Powers {
    double eps_p, hardened, theta, soft;
  };
  Powers powers(double eps_p, double T) const {
    const double hardened = B == 0.0 ? 0.0 : B * std::pow(eps_p, n);
    const double theta = homologous_temperature(T);
    return {eps_p, hardened, theta, theta > 0.0 ? std::pow(theta, m) : 0.0};
  }
  /// The same after a plastic strain increment, at a temperature T: to round-off powers(p.eps_p + x, T), but where both change by
  /// little without a power of their own.
  Powers moved(const Powers& p, double x, double T) const {
    const double theta = homologous_temperature(T);
    const double hardened = B == 0.0 ? 0.0
                            : x < near * p.eps_p ? p.hardened * power_near_one(x / p.eps_p, n)
                                                 : B * std::pow(p.eps_p + x, n);
    const double soft = theta == p.theta ? p.soft
                        : std::abs(theta - p.theta) < near * p.theta ? p.soft * power_near_one((theta - p.theta) / p.theta, m)
                                                                     : std::pow(theta, m);
    return {p.eps_p + x, hardened, theta, soft};
  }

  /// sigma_y = [A + B eps_p^n] [1 + C ln(rate ratio)] [1 - T*^m].
  FlowStress flow_stress(const Powers& p, double rate) const {
    const double ratio = rate_ratio(rate);
    const double Y = A + p.hardened, R = 1.0 + C * std::log(ratio), S = 1.0 - p.soft;
    const bool softening = p.theta > 0.0 && p.theta < 1.0;
    return {Y * R * S, p.hardened == 0.0 ? 0.0 : n * p.hardened / p.eps_p * R * S, ratio > 1.0 ? Y * C * S : 0.0,
            softening ? -Y * R * m * p.soft / (p.theta * (melting_temperature - reference_temperature)) : 0.0};
  }
  FlowStress flow_stress(double eps_p, double rate, double T) const { return flow_stress(powers(eps_p, T), rate); }

 private:
  static constexpr double near = 0.02;
  /// (1 + r)^a for |r| < near and a from 0 to 3, to round-off: its binomial series; the first term left out is below 1e-17.
  static double power_near_one(double r, double a) {
    if (std::abs(r) < 1e-5) return binomial_series<3>(r, a);
    if (std::abs(r) < 1e-3) return binomial_series<5>(r, a);
    return binomial_series<8>(r, a);
  }
  template <int Terms>
  static double binomial_series(double r, double a) {
    double sum = 1.0;
    for (int k = Terms; k > 0; --k) sum = 1.0 + (a - (k - 1)) * (1.0 / k) * r * sum;
    return sum;
  }
};

}  // namespace furrow
