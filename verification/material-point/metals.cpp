// Metals along paths (Johnson & Cook 1983, paper Eqs 18 to 22). A specimen is pulled, pressed, twisted, or one after the other,
// with unloading and reversal, at rates from 1e-3 to 1e5 /s and from 77 to 800 K. The reference solves the rate equations by GSL;
// and for adiabatic flow at constant rate there is a closed form.
#include <algorithm>
#include <numeric>

#include "harness/material_file.hpp"
#include "reference/exact/plasticity.hpp"
#include "verification/material-point/drive.hpp"
#include "verification/material-point/problems.hpp"

namespace furrow::material_point_cases {
namespace {

std::vector<double> halved(double coarsest, int times) {
  std::vector<double> steps;
  for (int k = 0; k <= times; ++k) steps.push_back(std::ldexp(coarsest, -k));
  return steps;
}

constexpr std::array<bool, 6> uniaxial{false, true, true, false, false, false};
constexpr std::array<bool, 6> plane{false, true, false, false, false, false};

/// Axial strain at a rate under the given stress control.
exact::Leg axial(double strain, double rate, const std::array<bool, 6>& control) {
  exact::Leg leg{.duration = std::abs(strain) / rate,
                 .samples = std::max(1, static_cast<int>(std::abs(strain) * 100.0)),
                 .stress_controlled = control};
  leg.rate[0] = std::copysign(rate, strain);
  return leg;
}

/// Simple shear x' = gamma y.
exact::Leg torsion(double gamma, double rate) {
  exact::Leg leg{.duration = std::abs(gamma) / rate, .samples = std::max(1, static_cast<int>(std::abs(gamma) * 50.0))};
  leg.rate[3] = leg.spin[0] = 0.5 * std::copysign(rate, gamma);
  return leg;
}

/// Every path unloads, or turns back through the elastic range.
std::vector<exact::Leg> path(const std::string& name, double rate) {
  constexpr double unload = 0.002;
  if (name == "tension") return {axial(0.15, rate, uniaxial), axial(-unload, rate, uniaxial), axial(0.15, rate, uniaxial)};
  if (name == "compression") return {axial(-0.25, rate, uniaxial), axial(0.1, rate, uniaxial)};
  if (name == "torsion") return {torsion(0.4, rate), torsion(-0.2, rate)};
  if (name == "plane_strain") return {axial(-0.2, rate, plane), axial(unload, rate, plane), axial(-0.05, rate, plane)};
  return {axial(0.1, rate, uniaxial), axial(-unload, rate, uniaxial), torsion(0.2, rate)};   // tension_torsion
}

struct Errors {
  double largest_stress = 0.0, temperature = 0.0, plastic_strain = 0.0;   // relative to the largest of the reference
  double deviator = 0.0;                                                  // root mean square while the reference flows
  std::vector<double> of_leg;                                             // root mean square of the stress over each leg
};

Errors errors(const AnyMaterial& material, const std::vector<exact::Leg>& legs, const std::vector<MaterialState>& states,
              const std::vector<exact::Point>& truth, double T_0) {
  Largest stress, temperature, strain, stress_scale, heating, strain_scale;
  double squares = 0.0;
  int samples = 0;
  std::size_t k = 0;
  Errors e;
  for (const exact::Leg& leg : legs) {
    double squares_of_leg = 0.0;
    const double strain_of_sample = std::max(std::abs(leg.rate[0]), std::abs(leg.rate[3])) * leg.duration / leg.samples;
    for (int sample = 0; sample < leg.samples; ++sample, ++k) {
      const Tensor exact_stress = tensor(truth[k].stress);
      const double off = (states[k].stress - exact_stress).norm();
      stress.add(off);
      squares_of_leg += off * off;
      stress_scale.add(exact_stress.norm());
      const double flowed = plastic_strain(material, truth[k]) - (k > 0 ? plastic_strain(material, truth[k - 1]) : 0.0);
      if (flowed > 0.5 * strain_of_sample) {
        squares += deviator(states[k].stress - exact_stress).squaredNorm();
        ++samples;
      }
      temperature.add(states[k].temperature - truth[k].temperature);
      heating.add(truth[k].temperature - T_0);
      strain.add(states[k].plastic_strain - plastic_strain(material, truth[k]));
      strain_scale.add(plastic_strain(material, truth[k]));
    }
    e.of_leg.push_back(std::sqrt(squares_of_leg / leg.samples));
  }
  for (double& rms : e.of_leg) rms /= stress_scale.magnitude;
  e.deviator = std::sqrt(squares / samples) / stress_scale.magnitude;
  e.largest_stress = stress.magnitude / stress_scale.magnitude;
  e.temperature = heating.magnitude > 0.0 ? temperature.magnitude / heating.magnitude : temperature.magnitude;
  e.plastic_strain = strain.magnitude / strain_scale.magnitude;
  return e;
}

void show_path(Run& run, const std::vector<exact::Leg>& legs, const std::vector<MaterialState>& states,
               const std::vector<exact::Point>& truth) {
  Series solver{.label = "solver, largest step"}, reference{.label = "rate equations", .role = "reference"};
  Series warm = solver, warm_reference = reference;
  std::size_t k = 0;
  double way = 0.0;
  for (const exact::Leg& leg : legs)
    for (int sample = 0; sample < leg.samples; ++sample, ++k) {
      way += leg.duration / leg.samples * std::max(std::abs(leg.rate[0]), 2.0 * std::abs(leg.rate[3]));
      for (Series* s : {&solver, &reference, &warm, &warm_reference}) s->x.push_back(way);
      solver.y.push_back(von_mises(states[k].stress));
      reference.y.push_back(std::sqrt(3.0) * exact::sqrt_j2(truth[k].stress));
      warm.y.push_back(states[k].temperature);
      warm_reference.y.push_back(truth[k].temperature);
    }
  Figure& stress =
      run.figure({.name = "stress", .title = "Equivalent stress along the path", .x = {"strain passed"}, .y = {"stress", "Pa"}});
  stress.series = {solver, reference};
  Figure& temperature = run.figure(
      {.name = "temperature", .title = "Temperature along the path", .x = {"strain passed"}, .y = {"temperature", "K"}});
  temperature.series = {warm, warm_reference};
}

}  // namespace

Problem metal_path(const Parameters& input) {
  NamedMaterial material = read_material(input, "material");
  std::visit(
      [](auto& law) {
        if constexpr (requires { law.damage; }) law.damage.reset();
      },
      material.law);   // it is not to break here
  const double rate = input.quantity("rate", dimension::rate, range::positive);
  const double T_0 = input.quantity("temperature", dimension::temperature, range::positive);
  const std::vector<double> strain_steps =
      halved(input.number("strain_step", range::positive), static_cast<int>(input.integer_or("halvings", 3, 2, 6)));
  const bool first_leg = input.choice_or("order_of_leg", "last", {"first", "last"}) == "first";
  const std::string name = input.choice("path", {"tension", "compression", "torsion", "plane_strain", "tension_torsion"});
  return [=](Run& run) {
    exercise(run, material.law);
    MaterialState start = initial_state(material.law);
    start.temperature = T_0;
    const std::vector<exact::Leg> legs = path(name, rate);
    const std::vector<exact::Point> truth = exact::follow(twin(material.law), point(start), legs);

    std::vector<double> rms;
    for (const double step : strain_steps) {
      const std::vector<MaterialState> states = drive(material.law, start, legs, step);
      const Errors e = errors(material.law, legs, states, truth, T_0);
      rms.push_back(first_leg ? e.of_leg.front() : e.of_leg.back());
      if (step != strain_steps.front()) continue;
      run.measure("flow_stress_error", e.deviator);
      run.measure("largest_stress_error", e.largest_stress);
      run.measure("plastic_strain_error", e.plastic_strain);
      if (truth.back().temperature > T_0)
        run.measure("temperature_error", e.temperature);
      else
        run.skip("temperature_error", "isothermal");
      show_path(run, legs, states, truth);
    }
    measure_order(run, "observed_order", strain_steps, rms, 1e-10);
  };
}

Problem adiabatic_flow(const Parameters& input) {
  const NamedMaterial material = read_material(input, "material");
  const double rate = input.quantity("rate", dimension::rate, range::positive);
  const double strain = input.number("plastic_strain", range::positive);
  const std::vector<double> strain_steps = halved(input.number("strain_step", range::positive), 3);
  return [=](Run& run) {
    run.exercises("materials/johnson_cook");
    std::visit(
        [&](auto law) {
          if constexpr (requires { law.strength; }) {
            // Nearly rigid, so that the plastic strain rate is the strain rate, as the closed form has it.
            law.shear_modulus *= 1e4;
            law.damage.reset();
            const exact::Adiabatic truth = exact::johnson_cook_adiabatic(
                constants(law.strength, law.specific_heat, law.taylor_quinney), law.eos.reference_density, rate, strain);
            const double T_truth =
                law.strength.reference_temperature +
                truth.homologous_temperature * (law.strength.melting_temperature - law.strength.reference_temperature);
            std::vector<double> off;
            for (const double step : strain_steps) {
              MaterialState state = law.initial_state();
              const int n = static_cast<int>(std::lround(strain / step));
              Tensor way = Tensor::Zero();
              way.diagonal() << strain, -0.5 * strain, -0.5 * strain;   // no change of volume
              for (int k = 0; k < n; ++k) state = furrow::advance(law, state, {way / n, Tensor::Zero(), strain / rate / n});
              off.push_back((state.temperature - T_truth) / (T_truth - law.strength.reference_temperature));
              if (step != strain_steps.front()) continue;
              run.measure("temperature", state.temperature, "K", {T_truth, 0.0});
              run.measure("flow_stress", von_mises(state.stress), "Pa", {truth.flow_stress, 0.0});
            }
            measure_order(run, "observed_order", strain_steps, off, 1e-10);
          } else {
            throw std::runtime_error("adiabatic flow is a problem of Johnson-Cook's law");
          }
        },
        material.law);
  };
}

}  // namespace furrow::material_point_cases
