// Return to a yield surface that grows with plastic strain: the answer of one step of any size, in closed form.
#include "harness/material_file.hpp"
#include "verification/material-point/drive.hpp"
#include "verification/material-point/problems.hpp"

namespace furrow::material_point_cases {

Problem single_step(const Parameters& input) {
  const NamedMaterial material = read_material(input, "material");
  struct Constants {
    double G, Y, H;
  };
  const Constants c = std::visit(
      [&](const auto& law) -> Constants {
        if constexpr (requires { law.hardening_modulus; })
          return {law.shear_modulus, law.yield_stress, law.hardening_modulus};
        else
          input.fail("material", "found a material without linear hardening, expected one with it");
      },
      material.law);
  return [=](Run& run) {
    run.exercises("materials/j2_plastic");
    Largest stress, strain;
    for (const double past_yield : {1.5, 3.0, 10.0, 30.0}) {
      // From rest along one deviatoric direction: sigma_eq of the elastic step is 3 G times the equivalent strain.
      const double q_trial = past_yield * c.Y, equivalent = q_trial / (3.0 * c.G);
      Increment increment;
      increment.dt = 1e-6;
      increment.strain.diagonal() << equivalent, -0.5 * equivalent, -0.5 * equivalent;
      const MaterialState state = advance(material.law, initial_state(material.law), increment);
      const double eps_p = (q_trial - c.Y) / (3.0 * c.G + c.H);
      stress.add(von_mises(state.stress) / (c.Y + c.H * eps_p) - 1.0);
      strain.add(state.plastic_strain / eps_p - 1.0);
    }
    run.measure("stress_error", stress.magnitude);
    run.measure("plastic_strain_error", strain.magnitude);
  };
}

}  // namespace furrow::material_point_cases
