// What accelerates a body: its own stress, walls, boundary layers, loads and constraints.
#include <tuple>

#include "solver/body.hpp"
#include "solver/boundaries/carried_soil.hpp"
#include "solver/modules.hpp"
#include "solver/particles/ordered_sum.hpp"
#include "solver/schemes/hourglass.hpp"

namespace furrow {
namespace {

/// tan(phi) of soil in plane strain without dilation, sin(phi) = 3 alpha, and 0 of any other material.
double internal_friction(const AnyMaterial& material) {
  const DruckerPrager* soil = std::get_if<DruckerPrager>(&material);
  const double sine = soil == nullptr ? 0.0 : std::min(0.99, 3.0 * soil->cone.alpha);
  return sine / std::sqrt(1.0 - sine * sine);
}

}  // namespace

template <int Dim>
void Body<Dim>::accelerate(double time, std::span<Vector<Dim>> velocity) {
  Particles<Dim>& p = particles;
  const std::size_t n = p.size();
  const Vector<Dim> gravity = loads.gravity_at(time);
  const double damping = loads.damping_at(time);
  friction_power_ = 0.0;
  if (in_reference_frame()) {
    accelerate_in_reference(velocity);
  } else {
    lend_velocities(velocity, true);
    extrapolate_stresses(gravity);
    const MomentumTerms terms{scheme.viscosity, scheme.artificial_stress, spacing};
    momentum<Dim>(stencil(), p, velocity, correction(), terms, workspace_, p.acceleration, power_);
    if (scheme.hourglass > 0.0) hourglass_control<Dim>(stencil(), p, velocity, scheme.hourglass, p.acceleration, power_);
    account_layers(velocity);
    if (const double friction = internal_friction(material); scheme.viscosity && friction > 0.0 && !layers.empty()) {
      const LayerSurroundings<Dim> around = layer_surroundings();
      for (std::size_t l = 0; l < layers.size(); ++l) {
        if (layers[l].slip != Slip::none || layers[l].ids.empty()) continue;
        const auto carried = carried_friction<Dim>(around, layers[l], own_velocity_[l].front(),
                                                   {scheme.viscosity->alpha, scheme.viscosity->beta}, friction, p,
                                                   velocity, p.acceleration);
        layer_forces_[l] += carried.force;
        friction_power_ += carried.power;
      }
    }
    return_velocities(velocity);
  }

  wall_forces_.clear();
  for (const RigidWall<Dim>& wall : walls) {
    has_run(Module::wall);
    const auto push = wall.push(p, spacing, velocity, p.acceleration, [this](std::size_t i) { return !is_in_layer(i); });
    wall_forces_.push_back(push.force);
    friction_power_ += push.friction_power;
  }
  external_power_ = damping_power_ = 0.0;
  double touch_power = 0.0;
  for (RigidBody<Dim>& rigid : rigid_bodies) {
    rigid.move(time);
    const auto touch = rigid.contact.touch(p, spacing, time, velocity, p.acceleration, rigid.outline,
                                           [this](std::size_t i) { return !is_in_layer(i); });
    friction_power_ += touch.power;
    touch_power += touch.surface_power;
  }
  if (neighbour_body) {
    const Exchange exchange = neighbour_body(time, velocity, p.acceleration);
    friction_power_ += exchange.contact;
    touch_power += exchange.external;
  }
  if (damping > 0.0) has_run(Module::damping);
  if (!gravity.isZero(0.0)) has_run(Module::gravity);
  if (damping > 0.0 || !gravity.isZero(0.0))
    std::tie(external_power_, damping_power_) = std::tuple_cat(ordered_sum<2>(n, [&](std::size_t i, auto& sum) {
      if (is_in_layer(i)) return;
      p.acceleration[i] += gravity - damping * velocity[i];
      sum[0] += p.mass[i] * gravity.dot(velocity[i]);
      sum[1] += p.mass[i] * damping * velocity[i].squaredNorm();
    }));
  external_power_ += touch_power;
  for (std::size_t l = 0; l < layers.size(); ++l)
    external_power_ -= layers[l].ids.empty() ? 0.0 : layer_forces_[l].dot(layers[l].velocity(time));
  for (const AppliedForce<Dim>& load : loads.forces) {
    has_run(Module::applied_force);
    double mass = 0.0;
    for (const std::int32_t id : load.ids) mass += p.mass[index_of(id)];
    const Vector<Dim> a = load.force(time) / mass;
    for (const std::int32_t id : load.ids) {
      const std::size_t i = index_of(id);
      p.acceleration[i] += a;
      external_power_ += p.mass[i] * a.dot(velocity[i]);
    }
  }
  if (!loads.held.ids.empty()) has_run(Module::held_forces);
  for (std::size_t k = 0; k < loads.held.ids.size(); ++k) {
    const std::size_t i = index_of(loads.held.ids[k]);
    p.acceleration[i] += loads.held.forces[k] / p.mass[i];
    external_power_ += loads.held.forces[k].dot(velocity[i]);
  }
  if (!loads.faces.empty()) has_run(Module::held_face);
  for (const HeldFace& face : loads.faces)
    for (const HeldFace::Column& column : face.columns) {
      Vector<Dim> at_face = Vector<Dim>::Zero();
      double compliance = 0.0;
      for (std::size_t k = 0; k < column.ids.size(); ++k) {
        const std::size_t i = index_of(column.ids[k]);
        at_face += column.weights[k] * p.acceleration[i];
        compliance += column.weights[k] * column.weights[k] / p.mass[i];
      }
      for (std::size_t k = 0; k < column.ids.size(); ++k) {
        const std::size_t i = index_of(column.ids[k]);
        p.acceleration[i] -= column.weights[k] / (p.mass[i] * compliance) * at_face;
      }
    }
  reactions_.assign(loads.motions.size(), Vector<Dim>::Zero());
  for (std::size_t k = 0; k < loads.motions.size(); ++k)
    for (const std::int32_t id : loads.motions[k].ids) {
      const std::size_t i = index_of(id);
      reactions_[k] += p.mass[i] * p.acceleration[i];
      // Whatever the body does to a prescribed particle, the one who prescribes takes up.
      external_power_ -= p.mass[i] * p.acceleration[i].dot(velocity[i]);
      p.acceleration[i].setZero();
    }
}

template <int Dim>
LayerSurroundings<Dim> Body<Dim>::layer_surroundings() {
  const std::size_t n = particles.size();
  soil_volume_.resize(particles.position.size());
  for_all(n, [&](std::size_t i) { soil_volume_[i] = is_in_layer(i) ? 0.0 : particles.volume(i); });
  if (!images.empty()) images.fill(soil_volume_);
  return {scheme.kernel, smoothing_length(), box, &neighbours_, particles.position, soil_volume_, index_of_id_, in_layer_};
}

template <int Dim>
void Body<Dim>::lend_velocities(std::span<Vector<Dim>> velocity, bool all_smooth) {
  if (layers.empty()) return;
  has_run(Module::boundary_layer);
  own_velocity_.resize(layers.size());
  const LayerSurroundings<Dim> around = layer_surroundings();
  for (std::size_t l = 0; l < layers.size(); ++l) {
    own_velocity_[l].clear();
    for (const std::int32_t id : layers[l].ids) own_velocity_[l].push_back(velocity[index_of(id)]);
    if (layers[l].ids.empty()) continue;
    const Slip slip = all_smooth ? Slip::free : layers[l].slip;
    extrapolate_velocity<Dim>(around, layers[l], slip, own_velocity_[l].front(), velocity);
  }
  if (!images.empty()) images.fill_velocities(velocity);
}

template <int Dim>
void Body<Dim>::return_velocities(std::span<Vector<Dim>> velocity) const {
  for (std::size_t l = 0; l < layers.size(); ++l)
    for (std::size_t k = 0; k < layers[l].ids.size(); ++k) velocity[index_of(layers[l].ids[k])] = own_velocity_[l][k];
}

template <int Dim>
void Body<Dim>::extrapolate_stresses(const Vector<Dim>& gravity) {
  if (layers.empty()) return;
  Particles<Dim>& p = particles;
  plane_stress_.resize(p.position.size());
  for_all(p.size(), [&](std::size_t i) { plane_stress_[i] = p.stress[i].template topLeftCorner<Dim, Dim>(); });
  if (!images.empty()) images.fill_tensors(std::span(plane_stress_));
  const double rho = std::visit([](const auto& law) { return law.initial_state().density; }, material);
  const LayerSurroundings<Dim> around = layer_surroundings();
  for (const BoundaryLayer<Dim>& layer : layers) extrapolate_stress<Dim>(around, layer, rho * gravity, plane_stress_, p.stress);
}

template <int Dim>
void Body<Dim>::account_layers(std::span<const Vector<Dim>> velocity) {
  Particles<Dim>& p = particles;
  layer_forces_.assign(layers.size(), Vector<Dim>::Zero());
  layer_power_ = layer_viscous_power_ = 0.0;
  if (layers.empty()) return;
  for_all(p.size(), [&](std::size_t i) {
    plane_stress_[i] = p.stress[i].template topLeftCorner<Dim, Dim>();
    if (scheme.correction == Correction::linear) plane_stress_[i] *= linear_[i].transpose();
  });
  if (!images.empty()) images.fill_tensors(std::span(plane_stress_));
  strained_.assign(velocity.begin(), velocity.end());
  const LayerSurroundings<Dim> around = layer_surroundings();
  for (std::size_t l = 0; l < layers.size(); ++l) {
    if (layers[l].ids.empty()) continue;
    const Vector<Dim> V = own_velocity_[l].front();
    if (layers[l].slip != Slip::free) extrapolate_velocity<Dim>(around, layers[l], layers[l].slip, V, strained_);
    exchange_.resize(layers[l].ids.size());
    layer_exchange<Dim>(around, layers[l], V, volume_, plane_stress_, strained_, exchange_);
    for (std::size_t k = 0; k < layers[l].ids.size(); ++k) {
      const std::size_t i = index_of(layers[l].ids[k]);
      const Vector<Dim> force = p.mass[i] * p.acceleration[i];
      layer_forces_[l] += force - exchange_[k].from_other_layers;
      layer_power_ += exchange_[k].power;
      // The sum over pairs took the lent velocity for a motion; the viscous force did work on V only.
      layer_viscous_power_ += (force - exchange_[k].stress_force).dot(velocity[i] - V);
      p.acceleration[i].setZero();
    }
  }
}

#define FURROW_INSTANTIATE(Dim)                                                                \
  template void Body<Dim>::accelerate(double, std::span<Vector<Dim>>);                         \
  template LayerSurroundings<Dim> Body<Dim>::layer_surroundings();                             \
  template void Body<Dim>::lend_velocities(std::span<Vector<Dim>>, bool);                      \
  template void Body<Dim>::return_velocities(std::span<Vector<Dim>>) const;                    \
  template void Body<Dim>::extrapolate_stresses(const Vector<Dim>&);                           \
  template void Body<Dim>::account_layers(std::span<const Vector<Dim>>);
FURROW_INSTANTIATE(2)
FURROW_INSTANTIATE(3)
#undef FURROW_INSTANTIATE

}  // namespace furrow
