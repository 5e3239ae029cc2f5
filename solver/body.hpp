// Body: particles of one material with the scheme that discretises them. It knows how to find its neighbours, how its stress
// answers a motion and how its stress accelerates it; when each of these happens is the integrator's business.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "solver/boundaries/boundary_layer.hpp"
#include "solver/boundaries/constraints.hpp"
#include "solver/boundaries/contact.hpp"
#include "solver/boundaries/wall.hpp"
#include "solver/materials/materials.hpp"
#include "solver/particles/fields.hpp"
#include "solver/particles/images.hpp"
#include "solver/schemes/momentum.hpp"
#include "solver/schemes/scheme.hpp"

namespace furrow {

template <int Dim>
class Body {
 public:
  std::string name = "body";
  Particles<Dim> particles;
  AnyMaterial material;
  Scheme scheme;
  double spacing = 0.0;   ///< dx, m
  Box<Dim> box;
  Loads<Dim> loads;
  std::vector<RigidWall<Dim>> walls;
  std::vector<BoundaryLayer<Dim>> layers;
  std::vector<RigidBody<Dim>> rigid_bodies;
  /// Called by accelerate() when the own stress has acted: another body may add what it does to this one, at the time and with the
  /// velocities given. Returns the powers (W) of relative motion in the contact and of the other body's motion on this one.
  struct Exchange {
    double contact = 0.0, external = 0.0;
  };
  std::function<Exchange(double time, std::span<const Vector<Dim>> velocity, std::span<Vector<Dim>> acceleration)> neighbour_body;
  /// Called by respond(): another body may add to the velocity gradients what sums over its particles give.
  std::function<void(std::span<Matrix<Dim>> velocity_gradient)> neighbour_strain;
  Images<Dim> images;

  double smoothing_length() const { return scheme.smoothing_ratio * spacing; }
  Stencil<Dim> stencil() const;

  /// Appends particles at these positions with the material's initial state, the velocity and the mass rho dx^Dim; ids go on
  /// counting.
  void add(const std::vector<Vector<Dim>>& positions, const Vector<Dim>& velocity = Vector<Dim>::Zero());

  /// Holds a face: `columns` are ids of two or more particles each, from the face inwards, the first half a spacing behind it. Call
  /// before anything has moved. Weights are those with which the momentum sum puts the load of a uniform stress on the particles
  /// behind a free face, so that a stressed body hangs in its clamp without a layer that is out of balance; they are brought
  /// by the least change to read linear velocities exactly. Columns of two are the sharpest, with 3/2 and -1/2; a body that is pulled
  /// or bent out of its clamp wants columns as deep as twice the support.
  void hold_face(std::string name, const std::vector<std::vector<std::int32_t>>& columns);

  /// Sorts particles and finds neighbours when something has moved further than the skin allows, and brings images up to date.
  /// `force` does so in any case.
  void refresh_neighbours(bool force = false);
  /// The list exactly as it was when positions were position_at_build: what a restart needs to go on bit for bit.
  void restore_neighbours();

  /// State after dt of the present motion, seen from the present
  /// positions: velocity gradient, density equation, material law. Returns the largest rate of compression -tr L, 1/s.
  double respond(double dt, std::int64_t step);

  /// Accelerations from stress, walls, gravity, damping and applied forces at `time`; `velocity` is that of the same time, and
  /// comes back as it was.
  void accelerate(double time, std::span<Vector<Dim>> velocity);

  /// kappa = omega h/c_s of the body's largest frequency omega, in the reference frame (largest_frequency); c_s of its most
  /// squeezed particle. Changes nothing that a later step sees.
  double largest_wave_number();

  /// Sets the velocity of prescribed particles and of boundary layers.
  void prescribe(double time, std::span<Vector<Dim>> velocity) const;
  /// Kinetic energy of the particles whose motion is prescribed, J: what sets them in motion did this work.
  double prescribed_kinetic_energy(double time) const;

  std::size_t index_of(std::int32_t id) const { return static_cast<std::size_t>(index_of_id_[static_cast<std::size_t>(id)]); }
  const NeighbourList& neighbours() const { return neighbours_; }
  std::span<const MomentumPower> power() const { return power_; }
  const std::vector<Matrix<Dim>>& velocity_gradient() const { return velocity_gradient_; }
  std::span<const double> wall_forces() const { return wall_forces_; }
  /// Power of everything from outside but walls, and force on each prescribed motion's particles from the body, as of the last
  /// accelerate().
  double external_power() const { return external_power_; }
  double damping_power() const { return damping_power_; }
  const std::vector<Vector<Dim>>& reactions() const { return reactions_; }
  /// Force of the body on each boundary layer, N; the power that goes into the soil that layers stand for; and what the powers of
  /// artificial terms (power()) have too little because of the velocities lent to layers. All as of the last accelerate().
  const std::vector<Vector<Dim>>& layer_forces() const { return layer_forces_; }
  double layer_power() const { return layer_power_; }
  double layer_viscous_power() const { return layer_viscous_power_; }
  double friction_power() const { return friction_power_; }   ///< W, taken out of the motion by friction on walls and by contact
  bool is_in_layer(std::size_t i) const { return !in_layer_.empty() && in_layer_[i] != 0; }
  std::int64_t builds() const { return builds_; }

  MaterialState state(std::size_t i) const;
  void set_state(std::size_t i, const MaterialState& state);

 private:
  bool neighbours_are_stale() const;
  void find_neighbours();
  void fill_images();
  /// Particles of layers that neither soil nor a layer's particle in reach of soil can see have no neighbours: nothing that their
  /// sums could give is read.
  void put_idle_layers_to_rest();
  LayerSurroundings<Dim> layer_surroundings();
  /// Gives the particles of layers the velocities that sums over pairs see, and takes them away again. Artificial viscosity sees
  /// every surface as smooth: what it would hold back along a rough one is not the soil's friction.
  void lend_velocities(std::span<Vector<Dim>> velocity, bool all_smooth);
  void return_velocities(std::span<Vector<Dim>> velocity) const;
  void extrapolate_stresses(const Vector<Dim>& gravity);
  /// Forces and power of layers after the sum over pairs, whose accelerations they take.
  void account_layers(std::span<const Vector<Dim>> velocity);
  /// Volumes and corrections for where particles are now, their densities `ahead` of what they are (s).
  CorrectionView<Dim> correction(double ahead);
  void make_correction();
  /// Without correction or with a linear one, in the middle of a step of dt.
  void plain_velocity_gradient(double dt);
  CorrectionView<Dim> view_of_correction() const;
  bool in_reference_frame() const { return scheme.frame == Frame::reference; }
  void build_reference();
  /// In the reference frame: cuts pairs where particles have failed since the last time.
  void open_cracks();
  void accelerate_in_reference(std::span<const Vector<Dim>> velocity);

  NeighbourList neighbours_;
  std::vector<std::int32_t> index_of_id_;
  std::vector<Matrix<Dim>> velocity_gradient_, linear_;
  std::vector<Matrix<Dim>> gradient_rate_;   ///< in the reference frame: dv/dX, F'
  Particles<Dim> undeformed_;                ///< in the reference frame: what the momentum sum sees, stress the first Piola-Kirchhoff
  std::vector<QuadraticGradient<Dim>> quadratic_;
  std::vector<double> viscous_pressure_;     ///< in the reference frame, Pa
  std::vector<double> volume_, density_before_;
  std::vector<MomentumPower> power_;
  MomentumWorkspace<Dim> workspace_;
  std::vector<double> wall_forces_;
  std::vector<Vector<Dim>> reactions_;
  std::vector<std::uint8_t> in_layer_;
  std::vector<double> soil_volume_;
  std::vector<Matrix<Dim>> plane_stress_;
  std::vector<std::vector<Vector<Dim>>> own_velocity_;       ///< of each layer's particles, while another is lent to them
  std::vector<Vector<Dim>> layer_forces_;
  double external_power_ = 0.0, damping_power_ = 0.0, layer_power_ = 0.0;
  double friction_power_ = 0.0, layer_viscous_power_ = 0.0;
  std::vector<Vector<Dim>> strained_;
  std::vector<LayerExchange<Dim>> exchange_;
  std::int64_t builds_ = 0;
};

}  // namespace furrow
