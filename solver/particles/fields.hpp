// THE field table: every quantity that a particle carries, with its symbol, HDF5 name, unit and one sentence. Sorting,
// snapshots and checkpoints walk this table; a field that is not here does not exist.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/particles/ordered_sum.hpp"
#include "solver/tensor/tensor.hpp"

namespace furrow {

struct Field {
  std::string_view symbol, name, unit, meaning;
};

/// One array per field, elements of fixed size; sorted by cell whenever neighbours are rebuilt. Behind the particles proper, the
/// arrays that neighbours read (position, velocity, mass, density, sound speed) may carry images of them (images.hpp).
template <int Dim>
struct Particles {
  std::vector<std::int32_t> id;
  std::vector<Vector<Dim>> position, velocity, acceleration, position_at_build, reference_position, crack_normal;
  std::vector<Matrix<Dim>> deformation_gradient;
  std::vector<double> mass, density, density_rate;
  std::vector<Tensor> stress;
  std::vector<double> sound_speed;
  std::vector<double> internal_energy, plastic_strain, plastic_work, temperature, fracture_onset, damage;

  std::size_t size() const { return id.size(); }   ///< without images
  double volume(std::size_t i) const { return mass[i] / density[i]; }
};

/// Calls visit(Field, array) for every field of the table, in this order.
template <class P, class Visitor>
void for_each_field(P& p, Visitor&& visit) {
  visit(Field{"id", "id", "1", "number given at creation, kept when particles are sorted"}, p.id);
  visit(Field{"x", "position", "m", "position"}, p.position);
  visit(Field{"v", "velocity", "m/s", "velocity"}, p.velocity);
  visit(Field{"a", "acceleration", "m/s^2", "acceleration at the end of the last step"}, p.acceleration);
  visit(Field{"x_b", "position_at_build", "m", "position when neighbours were last found"}, p.position_at_build);
  visit(Field{"X", "reference_position", "m", "position at creation"}, p.reference_position);
  visit(Field{"F", "deformation_gradient", "1", "deformation since creation"}, p.deformation_gradient);
  visit(Field{"m", "mass", "kg", "mass; per metre of width in plane strain"}, p.mass);
  visit(Field{"rho", "density", "kg/m^3", "density"}, p.density);
  visit(Field{"drho", "density_rate", "kg/(m^3 s)", "rate of the density over the last step"}, p.density_rate);
  visit(Field{"sigma", "stress", "Pa", "Cauchy stress, tension positive"}, p.stress);
  visit(Field{"c", "sound_speed", "m/s", "longitudinal speed of sound"}, p.sound_speed);
  visit(Field{"e", "internal_energy", "J/kg", "internal energy per mass"}, p.internal_energy);
  visit(Field{"eps_p", "plastic_strain", "1", "equivalent plastic strain"}, p.plastic_strain);
  visit(Field{"w_p", "plastic_work", "J/kg", "plastic work per mass, dissipated so far"}, p.plastic_work);
  visit(Field{"T", "temperature", "K", "temperature"}, p.temperature);
  visit(Field{"omega", "fracture_onset", "1", "sum of plastic strain over fracture strain, 1 when fracture begins"}, p.fracture_onset);
  visit(Field{"D", "damage", "1", "damage, 1 when failed"}, p.damage);
  visit(Field{"n_c", "crack_normal", "1", "normal in the undeformed body of the crack that this particle's failure opened; 0 without"},
        p.crack_normal);
}

/// Gives every field n elements; new ones are zero, images are dropped.
template <int Dim>
void resize(Particles<Dim>& p, std::size_t n) {
  for_each_field(p, [n](const Field&, auto& array) {
    using Element = typename std::remove_reference_t<decltype(array)>::value_type;
    if constexpr (std::is_arithmetic_v<Element>)
      array.resize(n, Element{});
    else
      array.resize(n, Element::Zero());
  });
}

/// New element k is old element order[k], in every field; images are dropped.
template <int Dim>
void permute(Particles<Dim>& p, const std::vector<std::int32_t>& order) {
  for_each_field(p, [&order](const Field&, auto& array) {
    static thread_local std::remove_reference_t<decltype(array)> sorted;   // kept: memory is not asked for at every sort
    sorted.resize(order.size());
    const auto source = std::span(std::as_const(array));
    const auto target = std::span(sorted);
    for_all(order.size(), [&](std::size_t k) { target[k] = source[static_cast<std::size_t>(order[k])]; });
    array.swap(sorted);
  });
}

}  // namespace furrow
