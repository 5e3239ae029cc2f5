// Drucker-Prager soil at a point (paper Eqs 11 to 14, Bui et al. 2008): strength, dilation and apex in the tests of a laboratory
// against closed forms, and paths with unloading and turning principal axes against the rate equations.
#include <limits>
#include <numbers>

#include "harness/material_file.hpp"
#include "reference/exact/plasticity.hpp"
#include "verification/material-point/drive.hpp"
#include "verification/material-point/problems.hpp"

namespace furrow::material_point_cases {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

const DruckerPrager& soil(const NamedMaterial& material, const Parameters& input) {
  const auto* law = std::get_if<DruckerPrager>(&material.law);
  if (!law) input.fail("material", "found no soil, expected one with the law drucker_prager");
  return *law;
}

MaterialState under_pressure(const DruckerPrager& law, double p) {
  MaterialState state = law.initial_state();
  state.stress = -p * Tensor::Identity();
  return state;
}

/// Axial strain of the specimen; lateral stress is kept in y, and in z as well (triaxial) or z does not move (plane strain).
exact::Leg axial(double strain, bool plane, int samples) {
  exact::Leg leg{.duration = 1.0, .samples = samples, .stress_controlled = {false, true, !plane, false, false, false}};
  leg.rate[0] = strain;
  return leg;
}

/// Difference of axial and cell stress at the end of a test at cell pressure p.
double strength_at(const DruckerPrager& law, double strain, bool plane, double p) {
  const MaterialState end = drive(law, under_pressure(law, p), {axial(strain, plane, 1)}, 1e-3).back();
  return std::abs(end.stress(0, 0) - end.stress(1, 1));
}

}  // namespace

Problem soil_strength(const Parameters& input) {
  const std::string cone_name = input.choice("cone", {"bui", "plane_strain", "compression", "extension"});
  const NamedMaterial material = read_material(input, "material", 0.0, {{"cone", cone_name}});
  const DruckerPrager law = soil(material, input);
  const double phi = input.quantity("friction_angle", dimension::none), c = input.quantity("cohesion", dimension::stress);
  const double psi = input.quantity("dilation_angle", dimension::none);
  const double p = input.quantity("cell_pressure", dimension::stress, range::positive);
  return [=](Run& run) {
    run.exercises("materials/drucker_prager");
    const exact::Cone truth = exact::cone(cone_name.c_str(), c, phi, psi);
    const double far = 0.8,
                 further = 3.0;   // axial strains: in plane strain the stress out of plane finds its value exponentially

    run.measure("triaxial_compression", strength_at(law, -far, false, p), "Pa",
                {exact::triaxial_compression_strength(truth, p), 0.0});
    run.measure("triaxial_extension", strength_at(law, far, false, p), "Pa", {exact::triaxial_extension_strength(truth, p), 0.0});
    const double r = 0.5 * strength_at(law, -further, true, p), r_more = 0.5 * strength_at(law, -further, true, 2.0 * p);
    run.measure("plane_strain_compression", r, "Pa", {exact::plane_strain_strength(truth, p), 0.0});
    // Mohr-Coulomb through the two: r = c cos(phi) + (p + r) sin(phi).
    const double slope = (r_more - r) / p, effective = std::asin(slope / (1.0 + slope));
    const double cohesion = (r - (p + r) * std::sin(effective)) / std::cos(effective);
    run.measure("effective_friction_angle", effective, "rad", {exact::plane_strain_friction(truth), 0.0});
    run.measure("effective_cohesion", cohesion, "Pa", {exact::plane_strain_cohesion(truth), 0.0});
    run.note("In plane strain this cone acts as an angle of friction of " + std::to_string(effective / degree) +
             " deg and a cohesion of " + std::to_string(cohesion / 1e3) + " kPa; the material says " +
             std::to_string(phi / degree) + " deg and " + std::to_string(c / 1e3) + " kPa.");

    // At constant stress all strain is plastic and follows the potential: d_volume = 3 beta lambda, d_eps_p = lambda/sqrt(3).
    const std::vector<MaterialState> flowing = drive(law, under_pressure(law, p), {axial(-far, false, 100)}, 1e-3);
    const MaterialState& a = flowing[80];
    const MaterialState& b = flowing.back();
    run.measure("dilation", std::log(a.density / b.density) / (b.plastic_strain - a.plastic_strain), "1",
                {3.0 * std::sqrt(3.0) * truth.beta, 0.0});

    // Pulled apart alike in all directions, and in shear as well: both end at the apex.
    const MaterialState pulled = advance(law, law.initial_state(), {0.05 * Tensor::Identity(), Tensor::Zero(), 1.0});
    run.measure("apex", pulled.stress.trace() / 3.0, "Pa", {truth.k / (3.0 * truth.alpha), 0.0});
    Tensor mixed = 0.05 * Tensor::Identity();
    mixed(0, 1) = mixed(1, 0) = 0.004;
    mixed(0, 0) += 0.003;
    MaterialState corner = law.initial_state();
    for (int k = 0; k < 50; ++k) corner = advance(law, corner, {0.02 * mixed, Tensor::Zero(), 1.0});
    run.measure("corner", (corner.stress - pulled.stress).norm() / pulled.stress.norm());
  };
}

Problem soil_path(const Parameters& input) {
  const NamedMaterial material = read_material(input, "material");
  const DruckerPrager law = soil(material, input);
  const std::string name = input.choice("path", {"triaxial", "plane_strain", "shear", "compression_then_shear"});
  const double p = input.quantity("cell_pressure", dimension::stress, range::positive);
  return [=](Run& run) {
    run.exercises("materials/drucker_prager");
    exact::Leg shear{.duration = 1.0, .samples = 20};
    shear.rate[3] = shear.spin[0] = 0.5 * 0.2;
    exact::Leg back = shear;
    back.rate[3] = back.spin[0] = -0.5 * 0.1;
    const std::vector<exact::Leg> legs =
        name == "triaxial"       ? std::vector{axial(-0.1, false, 20), axial(0.02, false, 10), axial(-0.1, false, 20)}
        : name == "plane_strain" ? std::vector{axial(-0.1, true, 20), axial(0.02, true, 10), axial(-0.1, true, 20)}
        : name == "shear"        ? std::vector{shear, back}
                                 : std::vector{axial(-0.1, true, 20), axial(0.02, true, 10), shear};
    const MaterialState start = under_pressure(law, p);
    const std::vector<exact::Point> truth = exact::follow(twin(law), point(start), legs);
    std::vector<double> steps, rms;
    for (const double step : {8e-4, 4e-4, 2e-4, 1e-4, 5e-5}) {
      const std::vector<MaterialState> states = drive(law, start, legs, step);
      Largest off, size;
      double squares = 0.0;
      for (std::size_t k = 0; k < states.size(); ++k) {
        const double e = (states[k].stress - tensor(truth[k].stress)).norm();
        off.add(e);
        squares += e * e;
        size.add(tensor(truth[k].stress).norm());
      }
      steps.push_back(step);
      rms.push_back(std::sqrt(squares / static_cast<double>(states.size())) / size.magnitude);
      if (step == 8e-4) run.measure("path_error_largest_step", off.magnitude / size.magnitude);
      if (step == 1e-4) run.measure("path_error", off.magnitude / size.magnitude);
      if (step != 5e-5) continue;
      Series solver{.label = "solver"}, reference{.label = "rate equations", .role = "reference"};
      for (std::size_t k = 0; k < states.size(); ++k) {
        solver.x.push_back(-states[k].stress.trace() / 3.0);
        solver.y.push_back(std::sqrt(j2(deviator(states[k].stress))));
        reference.x.push_back(-exact::trace(truth[k].stress) / 3.0);
        reference.y.push_back(exact::sqrt_j2(truth[k].stress));
      }
      Figure& figure = run.figure({.name = "path", .title = "Stress path", .x = {"pressure", "Pa"}, .y = {"sqrt(J2)", "Pa"}});
      figure.series = {solver, reference};
    }
    measure_order(run, "observed_order", steps, rms, 1e-10);
  };
}

}  // namespace furrow::material_point_cases
