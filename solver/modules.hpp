// The solver's modules, and which of them have run in this process: what a case says it exercises is checked against it.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <string_view>

namespace furrow {

enum class Module : std::size_t {
  linear_elastic, j2_plastic, johnson_cook, johnson_cook_damage, drucker_prager, linear_eos, mie_grueneisen, jaumann_rate,
  velocity_gradient, momentum, density, viscosity, artificial_stress, kernel_correction, quadratic_gradient, hourglass, xsph,
  reference_frame, cracks,
  images, neighbours,
  wall, boundary_layer, contact, summation_interface, prescribed_motion, held_face, applied_force, held_forces, gravity, damping,
  step_control, simulation, coupled_simulation,
};

/// Names as results know them, in the order of Module.
inline constexpr std::array module_names = std::to_array<std::string_view>({
    "materials/linear_elastic", "materials/j2_plastic", "materials/johnson_cook", "materials/johnson_cook_damage",
    "materials/drucker_prager", "materials/linear_eos", "materials/mie_grueneisen", "materials/jaumann_rate",
    "schemes/velocity_gradient", "schemes/momentum", "schemes/density", "schemes/viscosity", "schemes/artificial_stress",
    "schemes/kernel_correction", "schemes/quadratic_gradient", "schemes/hourglass", "schemes/xsph", "schemes/reference_frame",
    "schemes/cracks",
    "particles/images", "particles/neighbours",
    "boundaries/wall", "boundaries/boundary_layer", "boundaries/contact", "boundaries/summation_interface",
    "boundaries/prescribed_motion", "boundaries/held_face", "boundaries/applied_force", "boundaries/held_forces",
    "boundaries/gravity", "boundaries/damping",
    "integrators/step_control", "simulation", "coupled_simulation",
});
static_assert(module_names.size() == static_cast<std::size_t>(Module::coupled_simulation) + 1);

inline std::array<std::atomic<bool>, module_names.size()> modules_run{};

/// Called by a module where it does its work, once a sweep and not in loops over particles.
inline void has_run(Module module) {
  std::atomic<bool>& flag = modules_run[static_cast<std::size_t>(module)];
  if (!flag.load(std::memory_order_relaxed)) flag.store(true, std::memory_order_relaxed);
}

}  // namespace furrow
