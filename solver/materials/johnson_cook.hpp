#pragma once

#include <optional>

#include "solver/materials/first_law.hpp"
#include "solver/materials/johnson_cook_damage.hpp"
#include "solver/materials/johnson_cook_strength.hpp"
#include "solver/materials/linear_eos.hpp"
#include "solver/materials/mie_grueneisen.hpp"
#include "solver/materials/straight_path.hpp"

namespace furrow {

/// Where the paper's printed equations differ from the right ones, each can be had for itself.
struct JohnsonCookForm {
  bool stress_power = true;   ///< false: Eq. 9, the energy takes pressure work only and nothing heats by plastic flow
  bool root_of_j2 = true;     ///< false: Eq. 19, f_y = sigma_y/(sqrt(3) J2), in SI units
  bool plastic_rate = true;   ///< false: Eq. 21 with the rate sqrt(2/3 eps_dot : eps_dot) of the total strain
};

/// A metal by Johnson & Cook: strength that depends on plastic strain, its rate and temperature, adiabatic heating by the share
/// beta of the plastic work, an equation of state, and damage if there is a law for it.
///
/// The direction of the stress follows the strain exactly as for perfect plasticity (straight_path.hpp; along the stress this is
/// the radial return), the return to the yield surface is implicit in everything that the flow stress depends on (backward Euler,
/// of first order in dt):
///   q_trial - 3 G x = integrity sigma_y(eps_p + x, x/dt, T + beta q x/(rho c_p)),   q = q_trial - 3 G x,
/// solved for the plastic strain increment x to 1e-12 of q_trial.
template <class Eos>
struct JohnsonCook {
  static constexpr std::string_view name = "johnson_cook";
  static constexpr int most_iterations = 100;   ///< bisection alone would need about 60; typical are 4

  Eos eos;
  double shear_modulus;   ///< G, Pa
  JohnsonCookStrength strength;
  double specific_heat;    ///< c_p, J/(kg K)
  double taylor_quinney;   ///< beta, 0 for isothermal flow
  std::optional<JohnsonCookDamage> damage{};
  JohnsonCookForm form{};

  MaterialState initial_state() const {
    MaterialState state;
    state.density = eos.reference_density;
    state.temperature = strength.reference_temperature;
    return state;
  }

  MaterialState respond(MaterialState state, const Increment& increment) const {
    const double G = shear_modulus;
    const double intact = damage ? damage->integrity(state) : 1.0;
    const Closing closing{damage && damage->keeps_tension ? 1.0 : intact, form.stress_power};
    if (intact == 0.0) return closed_step(eos, state, Tensor::Zero(), increment, closing);

    const Tensor s_0 = deviator(state.stress), way = 2.0 * G * deviator(increment.strain);
    const auto powers = strength.powers(state.plastic_strain, state.temperature);
    const double q_yield = intact * strength.flow_stress(powers, total_rate(increment)).value;
    const StraightPath path = straight_path(s_0, way, form.root_of_j2 ? q_yield : HUGE_VAL);
    const double x = form.root_of_j2 ? plastic_increment(state, powers, path.q_trial, q_yield, intact, increment)
                                     : plastic_increment_without_root(path.q_trial, q_yield);
    const double q = std::max(0.0, path.q_trial - 3.0 * G * x);
    if (x > 0.0) {
      state.plastic_strain += x;
      state.plastic_work += q * x / state.density;
      state.temperature += heating(state.density) * q * x;
    }
    state = closed_step(eos, state, q * path.direction, increment, closing);
    if (damage && x > 0.0) break_up(state, x, increment.dt);
    return state;
  }

  double sound_speed(const MaterialState& state) const { return longitudinal_speed(eos, shear_modulus, state); }

  double stored_energy(const MaterialState& state) const {
    const bool stretched = state.density < eos.reference_density;
    const double kept = stretched && damage && !damage->keeps_tension ? damage->integrity(state) : 1.0;
    return kept * eos.cold_energy(state.density) + j2(deviator(state.stress)) / (2.0 * shear_modulus * state.density);
  }

 private:
  /// Rise of temperature for a plastic work per volume, K m^3/J.
  double heating(double rho) const { return form.stress_power ? taylor_quinney / (rho * specific_heat) : 0.0; }

  double total_rate(const Increment& increment) const { return std::sqrt(2.0 / 3.0) * increment.strain.norm() / increment.dt; }

  /// Root x of g(x) = q_trial - 3 G x - intact sigma_y; 0 in the elastic range. Newton's method inside a bracket that every
  /// evaluation narrows; where Newton leaves the bracket or would crawl it is halved.
  /// The yield stress at the total rate, q_yield, is above that without flow: a trial beyond it is plastic, and close to the root.
  double plastic_increment(const MaterialState& state, const JohnsonCookStrength::Powers& powers, double q_trial, double q_yield,
                           double intact, const Increment& increment) const {
    const double G = shear_modulus, b = heating(state.density);
    const double fixed_rate = form.plastic_rate ? 0.0 : total_rate(increment);
    const auto sigma_y = [&](double x) {
      const double rate = form.plastic_rate ? x / increment.dt : fixed_rate;
      return strength.flow_stress(strength.moved(powers, x, state.temperature + b * (q_trial - 3.0 * G * x) * x), rate);
    };
    const double excess = q_trial - (q_trial > q_yield ? q_yield : intact * sigma_y(0.0).value);
    if (!(excess > 0.0)) return 0.0;

    double low = 0.0, high = q_trial / (3.0 * G);   // g(low) > 0, g(high) <= 0
    double x = excess / (3.0 * G), width = high;
    for (int k = 0; k < most_iterations; ++k) {
      const auto y = sigma_y(x);
      const double g = q_trial - 3.0 * G * x - intact * y.value;
      if (std::abs(g) <= 1e-13 * q_trial) break;
      (g > 0.0 ? low : high) = x;
      const double by_rate = form.plastic_rate ? y.by_log_rate / x : 0.0;
      const double slope = -3.0 * G - intact * (y.by_strain + by_rate + y.by_temperature * b * (q_trial - 6.0 * G * x));
      const double next = x - g / slope;
      if (std::abs(g) <= 1e-8 * q_trial && next > low && next < high) return next;   // convergence is quadratic: below 1e-13 there
      const bool crawls = high - low > 0.5 * width && k > 2;
      width = high - low;
      x = next > low && next < high && !crawls ? next : 0.5 * (low + high);
      if (x <= low || x >= high) break;   // neighbouring numbers
    }
    return x;
  }

  /// Eqs 19 and 20 as printed: s becomes f_y s with f_y = sigma_y/(sqrt(3) J2), and what is taken off is plastic strain.
  double plastic_increment_without_root(double q_trial, double sigma_y) const {
    const double J2 = q_trial * q_trial / 3.0;
    const double f_y = sigma_y / (std::sqrt(3.0) * J2);
    return f_y < 1.0 ? (1.0 - f_y) * q_trial / (3.0 * shear_modulus) : 0.0;
  }

  /// Damage by a plastic increment x at the stress of the end of the step; a point that fails drops its load at once.
  void break_up(MaterialState& state, double x, double dt) const {
    const double q = von_mises(state.stress), mean = state.stress.trace() / 3.0;
    const double triaxiality = q > 0.0 ? mean / q : std::copysign(1e300, mean);
    damage->accumulate(
        state, x,
        {triaxiality, strength.rate_ratio(x / dt), strength.homologous_temperature(state.temperature), state.plastic_strain});
    if (damage->integrity(state) > 0.0) return;
    state.stress = (damage->keeps_tension ? mean : std::min(0.0, mean)) * Tensor::Identity();
  }
};
static_assert(Material<JohnsonCook<LinearEos>> && Material<JohnsonCook<MieGrueneisen>>);

}  // namespace furrow
