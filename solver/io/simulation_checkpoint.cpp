#include "solver/io/simulation_checkpoint.hpp"

#include <stdexcept>

namespace furrow {
namespace {

/// Calls visit(name, number) for each number of the clock; the one list that writing and reading share.
template <class Clock, class Visit>
void for_each_number(Clock& c, Visit&& visit) {
  visit("time", c.time);
  visit("dt", c.dt);
  visit("first_dt", c.first_dt);
  visit("compression", c.compression);
  visit("initial_energy", c.initial_energy);
  visit("energy_scale", c.energy_scale);
  visit("initial_internal", c.initial_internal);
  visit("wave_number", c.wave_number);
  visit("deposited", c.deposited);
  visit("energy.kinetic", c.energy.kinetic);
  visit("energy.elastic", c.energy.elastic);
  visit("energy.plastic", c.energy.plastic);
  visit("energy.wall", c.energy.wall);
  visit("energy.layer", c.energy.layer);
  visit("energy.viscous", c.energy.viscous);
  visit("energy.artificial", c.energy.artificial);
  visit("energy.damping", c.energy.damping);
  visit("energy.contact", c.energy.contact);
  visit("energy.external", c.energy.external);
  visit("power.viscous", c.powers.viscous);
  visit("power.artificial", c.powers.artificial);
  visit("power.damping", c.powers.damping);
  visit("power.external", c.powers.external);
  visit("power.layer", c.powers.layer);
  visit("power.friction", c.powers.friction);
  visit("power.layer_viscous", c.powers.layer_viscous);
}

}  // namespace

template <int Dim>
Checkpoint checkpoint_of(const Simulation<Dim>& simulation) {
  Checkpoint checkpoint;
  const Particles<Dim>& p = simulation.body.particles;
  const auto n = static_cast<std::ptrdiff_t>(p.size());
  for_each_field(p, [&](const Field& field, const auto& array) {
    using Element = typename std::remove_cvref_t<decltype(array)>::value_type;
    if constexpr (std::is_arithmetic_v<Element>) {
      checkpoint.put_array(std::string(field.name), std::vector<Element>(array.begin(), array.begin() + n));
    } else {
      std::vector<double> flat;
      for (std::ptrdiff_t i = 0; i < n; ++i) {
        const Element& element = array[static_cast<std::size_t>(i)];
        flat.insert(flat.end(), element.data(), element.data() + element.size());
      }
      checkpoint.put_array(std::string(field.name), std::move(flat));
    }
  });
  for (std::size_t k = 0; k < simulation.body.rigid_bodies.size(); ++k) {
    const auto memory = simulation.body.rigid_bodies[k].contact.memory();
    const std::string name = "contact." + std::to_string(k);
    checkpoint.put_scalar(name + ".time", memory.time);
    checkpoint.put_scalar(name + ".largest_penetration", memory.largest_penetration);
    checkpoint.put_scalar(name + ".slipped", memory.slipped);
    checkpoint.put_array(name + ".impulse", std::vector<double>(memory.impulse.data(), memory.impulse.data() + Dim));
    std::vector<double> flat;
    for (const Vector<Dim>& s : memory.stretch) flat.insert(flat.end(), s.data(), s.data() + Dim);
    checkpoint.put_array(name + ".stretch", std::move(flat));
  }
  const auto clock = simulation.clock();
  for_each_number(clock, [&](const char* name, double value) { checkpoint.put_scalar(name, value); });
  checkpoint.put_scalar("steps", clock.steps);
  checkpoint.put_scalar("sub_steps", clock.sub_steps);
  checkpoint.put_scalar("particle_steps", clock.particle_steps);
  const auto fast = simulation.body.fast_memory();
  checkpoint.put_array("fast.rung", std::vector<std::int32_t>(fast.rung.begin(), fast.rung.end()));
  checkpoint.put_array("fast.slower_wave_number", fast.slower_wave_number);
  checkpoint.put_array("fast.viscous_power", fast.viscous_power);
  std::vector<double> pulls;
  for (const Vector<Dim>& a : fast.acceleration) pulls.insert(pulls.end(), a.data(), a.data() + Dim);
  checkpoint.put_array("fast.acceleration", std::move(pulls));
  checkpoint.put_scalar("limiter", static_cast<std::int32_t>(clock.limiter));
  return checkpoint;
}

template <int Dim>
void resume_from(const Checkpoint& checkpoint, Simulation<Dim>& simulation) {
  Particles<Dim>& p = simulation.body.particles;
  const std::size_t n = p.size();
  resize(p, n);
  for_each_field(p, [&](const Field& field, auto& array) {
    using Element = typename std::remove_cvref_t<decltype(array)>::value_type;
    const auto& values = checkpoint.array<std::conditional_t<std::is_arithmetic_v<Element>, Element, double>>(std::string(field.name));
    constexpr std::size_t components = sizeof(Element) / sizeof(values[0]);
    if (values.size() != n * components)
      throw std::out_of_range("the checkpoint has " + std::to_string(values.size() / components) + " particles in " +
                              std::string(field.name) + ", the case " + std::to_string(n));
    if constexpr (std::is_arithmetic_v<Element>)
      array = values;
    else
      for (std::size_t i = 0; i < n; ++i) std::copy_n(values.data() + i * components, components, array[i].data());
  });
  for (std::size_t k = 0; k < simulation.body.rigid_bodies.size(); ++k) {
    const std::string name = "contact." + std::to_string(k);
    typename Contact<Dim>::Memory memory;
    memory.time = checkpoint.scalar<double>(name + ".time");
    memory.largest_penetration = checkpoint.scalar<double>(name + ".largest_penetration");
    memory.slipped = checkpoint.scalar<double>(name + ".slipped");
    std::copy_n(checkpoint.array<double>(name + ".impulse").data(), Dim, memory.impulse.data());
    const auto& flat = checkpoint.array<double>(name + ".stretch");
    memory.stretch.resize(flat.size() / Dim);
    for (std::size_t i = 0; i < memory.stretch.size(); ++i) std::copy_n(flat.data() + i * Dim, Dim, memory.stretch[i].data());
    simulation.body.rigid_bodies[k].contact.remember(std::move(memory));
  }
  typename Simulation<Dim>::Clock clock;
  for_each_number(clock, [&](const char* name, double& value) { value = checkpoint.scalar<double>(name); });
  clock.steps = checkpoint.scalar<std::int64_t>("steps");
  clock.sub_steps = checkpoint.scalar<std::int64_t>("sub_steps");
  clock.particle_steps = checkpoint.scalar<std::int64_t>("particle_steps");
  clock.limiter = static_cast<StepLimiter>(checkpoint.scalar<std::int32_t>("limiter"));
  simulation.resume(clock);
  const auto& rung = checkpoint.array<std::int32_t>("fast.rung");
  const auto& pulls = checkpoint.array<double>("fast.acceleration");
  typename Body<Dim>::FastMemory fast{{rung.begin(), rung.end()}, checkpoint.array<double>("fast.slower_wave_number"),
                                      checkpoint.array<double>("fast.viscous_power"), std::vector<Vector<Dim>>(pulls.size() / Dim)};
  for (std::size_t l = 0; l < fast.acceleration.size(); ++l) std::copy_n(pulls.data() + l * Dim, Dim, fast.acceleration[l].data());
  simulation.body.remember(fast);
}

template Checkpoint checkpoint_of<2>(const Simulation<2>&);
template Checkpoint checkpoint_of<3>(const Simulation<3>&);
template void resume_from<2>(const Checkpoint&, Simulation<2>&);
template void resume_from<3>(const Checkpoint&, Simulation<3>&);

}  // namespace furrow
