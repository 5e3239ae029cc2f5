#include "solver/io/coupled_checkpoint.hpp"

#include <stdexcept>

#include "solver/io/simulation_checkpoint.hpp"

namespace furrow {
namespace {

/// The one list of single numbers and vectors that writing and reading share.
template <class Memory, class Visit>
void for_each_vector(Memory& m, Visit&& visit) {
  visit("impulse", m.contact.impulse);
  visit("given_contact", m.impulses.contact);
  visit("given_rigid", m.impulses.rigid);
  visit("given_actuator", m.impulses.actuator);
  visit("given_stones", m.impulses.stones);
  visit("given_soil", m.impulses.soil);
  visit("pending", m.impulses.pending);
  visit("reaction", m.reaction);
  visit("stone_force", m.stone_force);
}
template <class Memory, class Visit>
void for_each_number(Memory& m, Visit&& visit) {
  visit("time", m.contact.time);
  visit("largest_penetration", m.contact.largest_penetration);
  visit("slipped", m.contact.slipped);
  visit("actuator_work", m.actuator_work);
  visit("previous_dt", m.previous_dt);
  visit("initial_energy", m.initial_energy);
}

std::vector<double> flat(const std::vector<Vector<2>>& vectors) {
  std::vector<double> values;
  for (const Vector<2>& v : vectors) values.insert(values.end(), v.data(), v.data() + 2);
  return values;
}

std::vector<Vector<2>> vectors(const std::vector<double>& flat) {
  std::vector<Vector<2>> result(flat.size() / 2);
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = {flat[2 * k], flat[2 * k + 1]};
  return result;
}

}  // namespace

void save_stiff(const CoupledSimulation& coupled, Checkpoint& checkpoint) {
  checkpoint.put_all("stiff.", checkpoint_of(coupled.stiff));
  const CoupledSimulation::Memory memory = coupled.memory();
  Checkpoint own;
  for_each_vector(memory, [&](const char* name, const Vector<2>& v) { own.put_array(name, std::vector<double>{v[0], v[1]}); });
  for_each_number(memory, [&](const char* name, double value) { own.put_scalar(name, value); });
  own.put_array("stretch", flat(memory.contact.stretch));
  own.put_array("node_force", flat(memory.node_force));
  own.put_array("held_force", flat(memory.held_force));
  checkpoint.put_all("coupling.", own);
}

void load_stiff(const Checkpoint& checkpoint, CoupledSimulation& coupled) {
  resume_from(checkpoint.part("stiff."), coupled.stiff);
  const Checkpoint own = checkpoint.part("coupling.");
  CoupledSimulation::Memory memory;
  for_each_vector(memory, [&](const char* name, Vector<2>& v) { v = vectors(own.array<double>(name)).at(0); });
  for_each_number(memory, [&](const char* name, double& value) { value = own.scalar<double>(name); });
  memory.contact.stretch = vectors(own.array<double>("stretch"));
  memory.node_force = vectors(own.array<double>("node_force"));
  memory.held_force = vectors(own.array<double>("held_force"));
  if (memory.node_force.size() != coupled.surface.ids.size())
    throw std::out_of_range("the checkpoint has " + std::to_string(memory.node_force.size()) +
                            " nodes on the surface, the case " + std::to_string(coupled.surface.ids.size()));
  coupled.remember(memory);
}

}  // namespace furrow
