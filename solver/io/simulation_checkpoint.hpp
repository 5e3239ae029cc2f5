#pragma once

#include "solver/io/checkpoint.hpp"
#include "solver/simulation.hpp"

namespace furrow {

/// Everything that `simulation` needs to go on bit for bit: particles in their order, and the clock.
template <int Dim>
Checkpoint checkpoint_of(const Simulation<Dim>& simulation);

/// Puts a simulation that was set up the same way (material, scheme, loads, walls) where the checkpoint was taken.
/// Throws FileError or std::out_of_range when the checkpoint is not one of such a simulation.
template <int Dim>
void resume_from(const Checkpoint& checkpoint, Simulation<Dim>& simulation);

}  // namespace furrow
