#include "verification/material-point/drive.hpp"

#include <array>
#include <stdexcept>

#include "harness/ladder.hpp"

namespace furrow::material_point_cases {
namespace {

constexpr std::array<Component, 6> components{Component{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};

void add(Tensor& a, const Component& at, double value) {
  a(at.first, at.second) += value;
  if (at.first != at.second) a(at.second, at.first) += value;
}

using Six = std::array<double, 6>;

double largest(const Six& r) {
  Largest all;
  for (const double x : r) all.add(x);
  return all.magnitude;
}

/// x of sum_c J[c] x_c = b, by elimination with column pivots.
Six solution(std::array<Six, 6> J, Six b, std::size_t n) {
  for (std::size_t p = 0; p < n; ++p) {
    std::size_t best = p;
    for (std::size_t i = p + 1; i < n; ++i)
      if (std::abs(J[p][i]) > std::abs(J[p][best])) best = i;
    for (std::size_t c = p; c < n; ++c) std::swap(J[c][p], J[c][best]);
    std::swap(b[p], b[best]);
    for (std::size_t i = p + 1; i < n; ++i) {
      const double factor = J[p][i] / J[p][p];
      for (std::size_t c = p; c < n; ++c) J[c][i] -= factor * J[c][p];
      b[i] -= factor * b[p];
    }
  }
  for (std::size_t p = n; p-- > 0;) {
    for (std::size_t c = p + 1; c < n; ++c) b[p] -= J[c][p] * b[c];
    b[p] /= J[p][p];
  }
  return b;
}

double prescribed_rate(const exact::Leg& leg) {
  Largest rate;
  for (std::size_t i = 0; i < 6; ++i)
    if (!leg.stress_controlled[i]) rate.add((i < 3 ? 1.0 : 2.0) * leg.rate[i]);
  for (const double w : leg.spin) rate.add(w);
  return rate.magnitude;
}

}  // namespace

MaterialState initial_state(const AnyMaterial& material) {
  return std::visit([](const auto& law) { return law.initial_state(); }, material);
}

MaterialState advance(const AnyMaterial& material, const MaterialState& state, const Increment& increment) {
  return std::visit([&](const auto& law) { return furrow::advance(law, state, increment); }, material);
}

MaterialState solve_step(const AnyMaterial& material, const MaterialState& state, Increment& increment,
                         std::span<const Component> unknown, const Residual& residual, double scale) {
  const std::size_t n = unknown.size();
  if (n == 0) return advance(material, state, increment);
  const auto evaluate = [&](const Tensor& strain, MaterialState& end) {
    end = advance(material, state, {strain, increment.spin, increment.dt});
    Six r{};
    residual(end, std::span(r).first(n));
    return r;
  };
  MaterialState end;
  Six r = evaluate(increment.strain, end);
  for (int k = 0; k < 60 && !(largest(r) <= 1e-12 * scale); ++k) {
    std::array<Six, 6> J{};   // J[c]: what component c of the strain changes in the residual
    const double h = 1e-7 * (increment.strain.norm() + 1e-6);
    for (std::size_t c = 0; c < n; ++c) {
      Tensor moved = increment.strain;
      add(moved, unknown[c], h);
      MaterialState ignored;
      const Six there = evaluate(moved, ignored);
      for (std::size_t i = 0; i < n; ++i) J[c][i] = (there[i] - r[i]) / h;
    }
    const Six change = solution(J, r, n);
    double part = 1.0;   // shorter where the kink of the yield surface throws a full step too far
    for (int halving = 0; halving < 12; ++halving, part *= 0.5) {
      Tensor trial = increment.strain;
      for (std::size_t c = 0; c < n; ++c) add(trial, unknown[c], -part * change[c]);
      MaterialState trial_end;
      const Six trial_r = evaluate(trial, trial_end);
      if (halving < 11 && !(largest(trial_r) < largest(r))) continue;
      increment.strain = trial;
      end = trial_end;
      r = trial_r;
      break;
    }
  }
  if (!(largest(r) <= 1e-11 * scale)) throw std::runtime_error("material point: no strain increment meets the stress condition");
  return end;
}

std::vector<MaterialState> drive(const AnyMaterial& material, MaterialState state, const std::vector<exact::Leg>& legs,
                                 double largest_step) {
  std::vector<MaterialState> samples;
  const double stiffness =
      state.density * std::pow(std::visit([&](const auto& law) { return law.sound_speed(state); }, material), 2);
  for (const exact::Leg& leg : legs) {
    const double per_sample = prescribed_rate(leg) * leg.duration / leg.samples;
    const int n = std::max(1, static_cast<int>(std::ceil(per_sample / largest_step - 1e-9)));
    const double dt = leg.duration / (leg.samples * n);
    std::vector<Component> unknown;
    Tensor strain = Tensor::Zero(), spin = Tensor::Zero();
    for (std::size_t i = 0; i < 6; ++i)
      if (leg.stress_controlled[i])
        unknown.push_back(components[i]);
      else
        add(strain, components[i], leg.rate[i] * dt);
    spin(0, 1) = leg.spin[0] * dt, spin(1, 2) = leg.spin[1] * dt, spin(2, 0) = leg.spin[2] * dt;
    spin(1, 0) = -spin(0, 1), spin(2, 1) = -spin(1, 2), spin(0, 2) = -spin(2, 0);

    const exact::Voigt start = voigt(state.stress);
    Increment increment{strain, spin, dt};
    for (int k = 1; k <= leg.samples * n; ++k) {
      const Residual residual = [&](const MaterialState& end, std::span<double> r) {
        const exact::Voigt stress = voigt(end.stress);
        std::size_t c = 0;
        for (std::size_t i = 0; i < 6; ++i)
          if (leg.stress_controlled[i]) r[c++] = stress[i] - (start[i] + leg.rate[i] * k * dt);
      };
      // Round-off of the stress, and of the density, which the moduli turn into stress.
      const double scale = state.stress.norm() + stiffness * (strain.norm() + 1e-3);
      state = solve_step(material, state, increment, unknown, residual, scale);
      if (k % n == 0) samples.push_back(state);
    }
  }
  return samples;
}

exact::PressureLaw pressure_law(const LinearEos& eos) {
  return {.reference_density = eos.reference_density, .bulk_modulus = eos.bulk_modulus};
}

exact::PressureLaw pressure_law(const MieGrueneisen& eos) {
  return {.reference_density = eos.reference_density, .sound_speed = eos.sound_speed, .slope = eos.slope, .gamma = eos.gamma};
}

exact::JohnsonCookConstants constants(const JohnsonCookStrength& s, double specific_heat, double taylor_quinney) {
  return {s.A,           s.B,           s.n, s.C, s.m, s.reference_rate, s.reference_temperature, s.melting_temperature,
          specific_heat, taylor_quinney};
}

namespace {

exact::RateLaw twin_of(const LinearElastic& m) {
  return exact::von_mises(pressure_law(m.eos()), m.shear_modulus, 1e3 * m.shear_modulus, 0.0);
}
template <class Eos>
exact::RateLaw twin_of(const J2Plastic<Eos>& m) {
  return exact::von_mises(pressure_law(m.eos), m.shear_modulus, m.yield_stress, m.hardening_modulus);
}
template <class Eos>
exact::RateLaw twin_of(const JohnsonCook<Eos>& m) {
  return exact::johnson_cook(pressure_law(m.eos), m.shear_modulus, constants(m.strength, m.specific_heat, m.taylor_quinney));
}
exact::RateLaw twin_of(const DruckerPrager& m) {
  return exact::drucker_prager(m.bulk_modulus, m.shear_modulus, m.cone.alpha, m.cone.k, m.cone.beta);
}

template <class Law>
double plastic_strain_of(const Law&, double hardening) {
  return hardening;
}
template <class Eos>
double plastic_strain_of(const JohnsonCook<Eos>& m, double hardening) {
  return exact::plastic_strain(constants(m.strength, m.specific_heat, m.taylor_quinney), hardening);
}

}  // namespace

exact::RateLaw twin(const AnyMaterial& material) {
  return std::visit([](const auto& law) { return twin_of(law); }, material);
}

double plastic_strain(const AnyMaterial& material, const exact::Point& p) {
  return std::visit([&](const auto& law) { return plastic_strain_of(law, p.hardening); }, material);
}

exact::Point point(const MaterialState& state) {
  return {
      .stress = voigt(state.stress), .density = state.density, .energy = state.internal_energy, .temperature = state.temperature};
}

exact::Voigt voigt(const Tensor& a) {
  exact::Voigt v{};
  for (std::size_t i = 0; i < 6; ++i) v[i] = a(components[i].first, components[i].second);
  return v;
}

Tensor tensor(const exact::Voigt& v) {
  Tensor a = Tensor::Zero();
  for (std::size_t i = 0; i < 6; ++i) add(a, components[i], v[i]);
  return a;
}

void measure_order(Run& run, std::string_view metric, const std::vector<double>& steps, const std::vector<double>& errors,
                   double round_off) {
  Figure& figure = run.figure({.name = std::string(metric),
                               .title = "Error over strain step",
                               .kind = "points",
                               .x = {"strain a step"},
                               .y = {"largest error"},
                               .log_x = true,
                               .log_y = true});
  figure.caption = "Each point is the whole path at one step size.";
  figure.add({.label = "error", .x = steps, .y = errors});
  if (std::abs(errors.front()) <= round_off && std::abs(errors.back()) <= round_off)
    run.skip(metric, "the law is exact along this path: every error is round-off");
  else
    run.measure(metric, error_ladder(steps, errors, round_off).order);
}

}  // namespace furrow::material_point_cases
