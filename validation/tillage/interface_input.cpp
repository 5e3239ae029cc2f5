#include "validation/tillage/interface_input.hpp"

namespace furrow::tillage_cases {

Interface read_interface(const Parameters& input, const DruckerPrager& soil) {
  Interface interface;
  interface.summation = input.choice_or("interface", "contact", {"contact", "summation"}) == "summation";
  const Parameters in = input.table_or_empty("contact");
  std::optional<LennardJones> repulsion;
  if (in.has("lennard_jones")) {
    const Parameters lj = in.table("lennard_jones");
    repulsion = LennardJones{.coefficient = lj.number("coefficient", range::positive),
                             .cut_off = lj.number("cut_off", {0.1, 3.0}),
                             .steep = lj.number("steep", range::positive),
                             .flat = lj.number("flat", range::positive)};
    if (repulsion->steep <= repulsion->flat)
      lj.fail("steep", "found an exponent that is not above the other, flat; expected steep > flat: the force would attract");
  }
  if (interface.summation) {
    for (const char* key : {"stiffness", "damping", "sticking_stiffness"})
      if (in.has(key)) in.fail(key, "found a contact law beside sums over both bodies, expected lennard_jones or nothing");
    interface.repulsion = repulsion;
  } else {
    interface.contact.lennard_jones = repulsion;
  }
  ContactLaw& law = interface.contact;
  law.stiffness = in.number_or("stiffness", 1.0, range::positive) * (soil.bulk_modulus + 4.0 / 3.0 * soil.shear_modulus);
  law.damping = in.number_or("damping", 0.0, range::not_negative);
  law.sticking_stiffness = in.number_or("sticking_stiffness", 1.0, range::positive) * soil.shear_modulus;
  return interface;
}

void couple(CoupledSimulation& coupled, const Interface& interface) {
  if (interface.summation) {
    const Body<2>&soft = coupled.soft.body, &stiff = coupled.stiff.body;
    coupled.single_rate = true;
    SummationInterface sums;
    sums.kernel = soft.scheme.kernel;
    sums.smoothing_length = 0.5 * (soft.smoothing_length() + stiff.smoothing_length());
    sums.repulsion = interface.repulsion;
    sums.repulsion_spacing = soft.spacing;
    coupled.summation = std::move(sums);
  }
  coupled.couple();
}

}  // namespace furrow::tillage_cases
