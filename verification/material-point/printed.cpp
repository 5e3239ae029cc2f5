// What each of the paper's printed equations does to a point of material, one at a time, beside the right form: a table for the
// report. The right forms are gated by the rate equations.
#include "harness/printed_forms.hpp"
#include "reference/exact/plasticity.hpp"
#include "verification/material-point/drive.hpp"
#include "verification/material-point/problems.hpp"

namespace furrow::material_point_cases {
namespace {

struct Fate {
  double flow_stress = 0.0, heating = 0.0, work = 0.0;         // at strain 0.2 of a pull at 1000/s: Pa, K, J/kg
  double pressure = 0.0;                                       // after a shock to 20 % compression, Pa
  double fracture = std::numeric_limits<double>::infinity();   // plastic strain at failure of the pull
  double tension_after = 0.0;                                  // mean stress of the failed point expanded by 3 %, Pa
};

Fate fate(const AnyMaterial& material) {
  Fate f;
  const MaterialState start = initial_state(material);
  const double rate = 1e3, step = 1e-3;
  Tensor squeeze = Tensor::Zero();
  squeeze(0, 0) = std::log(1.0 / 1.2);
  f.pressure = -advance(material, start, {squeeze, Tensor::Zero(), 1e-6}).stress.trace() / 3.0;

  MaterialState state = start;
  Tensor pull =
      Tensor::Zero();   // of constant volume: the shear that a bar in tension sees, without solving for its lateral strain
  pull.diagonal() << step, -0.5 * step, -0.5 * step;
  for (int k = 1; k <= 2000 && state.damage < 1.0; ++k) {
    state = advance(material, state, {pull, Tensor::Zero(), step / rate});
    if (k == 200)
      f.flow_stress = von_mises(state.stress), f.heating = state.temperature - start.temperature, f.work = state.internal_energy;
  }
  if (state.damage >= 1.0) {
    f.fracture = state.plastic_strain;
    f.tension_after = advance(material, state, {0.01 * Tensor::Identity(), Tensor::Zero(), step / rate}).stress.trace() / 3.0;
  }
  return f;
}

}  // namespace

Problem printed_forms(const Parameters& input) {
  std::vector<NamedMaterial> metals, soils;
  for (const PrintedForm& v : printed_forms_of_metals) metals.push_back(read_material(input, "metal", 0.0, v.changes));
  const std::vector<std::string> updates{"return_map", "rate", "rate_printed"};
  for (const std::string& update : updates) soils.push_back(read_material(input, "soil", 0.0, {{"update", update}}));
  return [=](Run& run) {
    run.exercises("materials/johnson_cook");
    run.exercises("materials/drucker_prager");
    Table& table = run.table("metal", "A point of the tool at 1000/s, one printed equation at a time",
                             {{"variant"},
                              {"flow stress at strain 0.2", "MPa"},
                              {"rise of temperature", "K"},
                              {"energy", "J/kg"},
                              {"pressure at 20 % compression", "GPa"},
                              {"plastic strain at failure"},
                              {"mean stress when failed and expanded by 3 %", "MPa"}});
    for (std::size_t i = 0; i < metals.size(); ++i) {
      const Fate f = fate(metals[i].law);
      table.row({printed_forms_of_metals[i].difference, f.flow_stress / 1e6, f.heating, f.work, f.pressure / 1e9, f.fracture,
                 f.tension_after / 1e6});
      if (i > 0) {
        run.measure("flow_stress_" + printed_forms_of_metals[i].name, f.flow_stress, "Pa");
        continue;
      }
      exact::Leg leg{.duration = 2e-4};
      leg.rate[0] = 1e3, leg.rate[1] = leg.rate[2] = -500.0;
      const exact::Point truth = exact::follow(twin(metals[0].law), point(initial_state(metals[0].law)), {leg}).back();
      run.measure("flow_stress_right", f.flow_stress, "Pa", {std::sqrt(3.0) * exact::sqrt_j2(truth.stress), 0.0});
    }

    Table& ground = run.table("soil", "A point of the soil compressed by 5 % and pulled by 4 % across, in plane strain",
                              {{"update"}, {"pressure", "kPa"}, {"sqrt(J2)", "kPa"}});
    Tensor way = Tensor::Zero();
    way.diagonal() << -0.05, 0.04, 0.0;
    for (std::size_t i = 0; i < soils.size(); ++i) {
      MaterialState state = initial_state(soils[i].law);
      for (int k = 0; k < 1000; ++k) state = advance(soils[i].law, state, {way / 1000.0, Tensor::Zero(), 1e-6});
      const double p = -state.stress.trace() / 3.0, J = std::sqrt(j2(deviator(state.stress)));
      ground.row({updates[i] == "rate_printed" ? std::string("rate form, Eq. 11 as printed: 2 G times the total strain rate")
                  : updates[i] == "rate"       ? std::string("rate form, drift corrected")
                                               : std::string("return map"),
                  p / 1e3, J / 1e3});
      if (i > 0) {
        run.measure("pressure_" + updates[i], p, "Pa");
        continue;
      }
      exact::Leg leg{.duration = 1.0};
      for (std::size_t c = 0; c < 3; ++c) leg.rate[c] = way.diagonal()(static_cast<Eigen::Index>(c));
      const exact::Point truth = exact::follow(twin(soils[0].law), point(initial_state(soils[0].law)), {leg}).back();
      run.measure("pressure_return_map", p, "Pa", {-exact::trace(truth.stress) / 3.0, 0.0});
    }
  };
}

}  // namespace furrow::material_point_cases
