#pragma once

#include "solver/coupled_simulation.hpp"
#include "solver/io/checkpoint.hpp"

namespace furrow {

/// Adds to a checkpoint of the soft body what a restart of a coupled simulation needs besides: the stiff body and the contact.
void save_stiff(const CoupledSimulation& coupled, Checkpoint& checkpoint);

/// Takes it back; the soft body has been resumed from the same checkpoint. Throws std::out_of_range when it is none of such a run.
void load_stiff(const Checkpoint& checkpoint, CoupledSimulation& coupled);

}  // namespace furrow
