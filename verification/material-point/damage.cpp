// Johnson-Cook damage (paper Eqs 23, 24 in their right form): a point at constant triaxiality, rate and temperature fails exactly
// at the fracture strain; along a path of changing triaxiality damage is the integral of d_eps_p/eps_f.
#include "harness/material_file.hpp"
#include "reference/exact/plasticity.hpp"
#include "reference/exact/quadrature.hpp"
#include "verification/material-point/drive.hpp"
#include "verification/material-point/problems.hpp"

namespace furrow::material_point_cases {
namespace {

/// Axial strain in n steps while lateral stress keeps the triaxiality s(k/n): sigma_l = sigma_a (3 s - 1)/(3 s + 2), mirrored for
/// compression. From `temperature` (K) on, or from the law's own where it is 0. `visit` sees each state and may stop the path by returning false.
template <class Law>
void pull_at_triaxiality(const Law& law, double temperature, double strain, double rate, int n, const std::function<double(double)>& triaxiality,
                         const std::function<bool(const MaterialState&, const MaterialState&)>& visit) {
  const AnyMaterial material = law;
  MaterialState state = initial_state(material);
  if (temperature > 0.0) state.temperature = temperature;
  const double sign = triaxiality(1.0) < -1.0 / 6.0 ? -1.0 : 1.0;   // below, the axial stress is the compressive one
  Increment increment;
  increment.dt = strain / n / rate;
  increment.strain.diagonal() << sign * strain / n, -0.5 * sign * strain / n, -0.5 * sign * strain / n;
  const std::array<Component, 2> lateral{Component{1, 1}, {2, 2}};
  const double stiffness = state.density * std::pow(law.sound_speed(state), 2);
  for (int k = 1; k <= n; ++k) {
    const double s = sign * triaxiality(static_cast<double>(k) / n);
    const double ratio = (3.0 * s - 1.0) / (3.0 * s + 2.0);
    const Residual residual = [ratio](const MaterialState& end, std::span<double> r) {
      r[0] = end.stress(1, 1) - ratio * end.stress(0, 0);
      r[1] = end.stress(2, 2) - ratio * end.stress(0, 0);
    };
    // A law that fails within the step has no stress to keep a ratio with: the step is solved for the law that does not fail.
    Law unbroken = law;
    unbroken.damage.reset();
    (void)solve_step(AnyMaterial(unbroken), state, increment, lateral, residual, stiffness);
    const MaterialState before = state;
    state = advance(material, state, increment);
    if (!visit(before, state)) return;
  }
}

}  // namespace

Problem fracture(const Parameters& input) {
  const NamedMaterial material = read_material(
      input, "material", 0.0, {{"heating.taylor_quinney", R"({ value = 0, unit = "1", source = "furrow-material-choices" })"}});
  const bool changing = input.choice_or("triaxiality_path", "constant", {"constant", "changing"}) == "changing";
  const double s_0 = input.number("triaxiality"), s_1 = changing ? input.number("final_triaxiality") : s_0;
  const double rate = input.quantity("rate", dimension::rate, range::positive);
  const double temperature = input.quantity_or("temperature", dimension::temperature, 0.0, range::not_negative);
  return [=](Run& run) {
    run.exercises("materials/johnson_cook_damage");
    std::visit(
        [&](auto law) {
          if constexpr (requires { law.damage; }) {
            if (!law.damage) throw std::runtime_error("the material has no damage");
            const JohnsonCookDamage& d = *law.damage;
            const double ratio = law.strength.rate_ratio(rate);
            const double T_0 = law.strength.reference_temperature, T_m = law.strength.melting_temperature;
            const double homologous = temperature > T_0 ? (temperature - T_0) / (T_m - T_0) : 0.0;
            const auto eps_f = [&](double s) {
              return exact::johnson_cook_fracture_strain({d.D1, d.D2, d.D3, d.D4, d.D5}, s, ratio, homologous);
            };
            if (!changing) {
              const double truth = eps_f(s_0), step = 1e-3;
              double damage_by_strain = 0.0, failed_at = 0.0, last_before = 0.0;
              MaterialState failed;
              pull_at_triaxiality(
                  law, temperature, 1.1 * truth, rate, static_cast<int>(1.1 * truth / step), [&](double) { return s_0; },
                  [&](const MaterialState& before, const MaterialState& now) {
                    failed = now;
                    if (now.damage >= 1.0) {
                      failed_at = now.plastic_strain;
                      last_before = before.plastic_strain;
                      damage_by_strain = before.damage / before.plastic_strain;
                      return false;
                    }
                    return true;
                  });
              run.measure("fracture_strain", 1.0 / damage_by_strain, "1", {truth, 0.0});
              run.measure("step_of_failure", (failed_at - truth) / (failed_at - last_before));
              run.measure("strength_when_failed",
                          (von_mises(failed.stress) + std::max(0.0, failed.stress.trace() / 3.0)) / law.strength.A);
              return;
            }
            // Nearly rigid, so that all strain is plastic and the triaxiality a function of it that is known beforehand.
            law.shear_modulus *= 1e4;
            if constexpr (requires { law.eos.bulk_modulus; })
              law.eos.bulk_modulus *= 1e4;
            else
              law.eos.sound_speed *= 1e2;
            const double strain = 0.8 * std::min(eps_f(s_0), eps_f(s_1));
            const auto at = [&](double part) { return s_0 + (s_1 - s_0) * part; };
            const double truth = exact::integrate([&](double eps) { return 1.0 / eps_f(at(eps / strain)); }, 0.0, strain);
            std::vector<double> steps, off;
            for (const int n : {250, 500, 1000, 2000}) {
              MaterialState end;
              pull_at_triaxiality(law, temperature, strain, rate, n, at, [&](const MaterialState&, const MaterialState& now) {
                end = now;
                return true;
              });
              steps.push_back(strain / n);
              off.push_back(end.damage / truth - 1.0);
              if (n == 250) run.measure("damage", end.damage, "1", {truth, 0.0});
            }
            measure_order(run, "observed_order", steps, off, 1e-10);
          } else {
            throw std::runtime_error("damage is a problem of Johnson-Cook's law");
          }
        },
        material.law);
  };
}

}  // namespace furrow::material_point_cases
