// How soil and tool act on each other: by contact, or by the paper's sums over the particles of both.
#pragma once

#include "harness/input.hpp"
#include "solver/coupled_simulation.hpp"
#include "solver/materials/drucker_prager.hpp"

namespace furrow::tillage_cases {

struct Interface {
  bool summation = false;
  ContactLaw contact;                        ///< of surfaces, also of those that take no part in sums; friction is the blade's
  std::optional<LennardJones> repulsion;     ///< between particles of soil and tool, with sums
};

/// The key `interface` (contact, the default, or summation) and the table `contact`: stiffness and sticking_stiffness as shares of
/// the soil's moduli, damping, lennard_jones (of the surface with contact, between particles with sums).
Interface read_interface(const Parameters& input, const DruckerPrager& soil);

/// Couples two bodies that are set up, with coupled.contact.law in place already.
void couple(CoupledSimulation& coupled, const Interface& interface);

}  // namespace furrow::tillage_cases
