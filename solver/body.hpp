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
#include "solver/schemes/fast_part.hpp"
#include "solver/schemes/momentum.hpp"
#include "solver/schemes/quadratic_sums.hpp"
#include "solver/schemes/reference_sums.hpp"
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

  /// Moves particles by `velocity` for dt; sorts them and finds neighbours when something has moved further than the skin allows;
  /// brings images up to date.
  void drift(std::span<const Vector<Dim>> velocity, double dt);
  /// Brings images up to date; with `find` sorts particles and finds neighbours before.
  void refresh_neighbours(bool find = false);
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

  // Sub-cycling in the reference frame (body_sub_cycle.cpp): squeezed particles, the fast parts, take several short steps in one of
  // the body, the more squeezed the more. The pulls of all others, dampers, walls and gravity act at the ends of their own steps:
  // impulses between which a fast part moves by its own pulls (Tuckerman, Berne & Martyna 1992). Nothing may be prescribed or held,
  // and no other body may be near.

  /// Chooses the fast parts anew; `slow_ratio` as in worth_short_steps.
  void choose_fast_parts(double slow_ratio);
  /// The slowest first; none where short steps are not worth it.
  const std::vector<FastPart<Dim>>& fast_parts() const { return fast_; }
  /// The rung of each particle, 0 of those in no fast part; empty where there is none.
  std::span<const std::uint8_t> rungs() const { return rung_; }
  /// Takes the pulls of the fast parts out of the accelerations, and puts those that there are now back in. In between accelerate()
  /// and power() are of all else.
  void part();
  void join();
  /// What drift and respond() are to a whole body, for a step of dt. Each fast part takes sub_steps[k] steps in one of the part
  /// before; velocities come out with the pulls of the fast parts in them. Returns the largest -tr L of the slow part, 1/s.
  double respond_in_sub_steps(double dt, std::span<const int> sub_steps);
  /// Viscous work on the fast parts in the last of these, J; in the particles' internal energy already where energy is on.
  double fast_viscous_work() const { return fast_viscous_work_; }
  double fast_deposit() const { return fast_deposit_; }   ///< what the particles' internal energy got of it
  /// What is to be kept of the fast parts for a run that goes on.
  struct FastMemory {
    std::vector<std::uint8_t> rung;
    std::vector<double> slower_wave_number, viscous_power;   ///< of each part
    std::vector<Vector<Dim>> acceleration;                   ///< of all parts, one after the other
  };
  FastMemory fast_memory() const;
  void remember(const FastMemory& memory);

  /// Sets the velocity of prescribed particles and of boundary layers.
  void prescribe(double time, std::span<Vector<Dim>> velocity) const;
  /// Kinetic energy of the particles whose motion is prescribed, J: what sets them in motion did this work.
  double prescribed_kinetic_energy(double time) const;

  std::size_t index_of(std::int32_t id) const { return static_cast<std::size_t>(index_of_id_[static_cast<std::size_t>(id)]); }
  const NeighbourList& neighbours() const { return neighbours_; }
  /// As of the last accelerate(); in the reference frame without what the stress takes, which energy does not need.
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
  /// Volumes and corrections for where particles are now.
  CorrectionView<Dim> correction();
  /// Volumes with densities `ahead` of what they are (s).
  void find_volumes(double ahead);
  void make_correction();
  /// With the correction that there is, none or linear, in the middle of a step of dt.
  void plain_velocity_gradient(double dt);
  CorrectionView<Dim> view_of_correction() const;
  bool in_reference_frame() const { return scheme.frame == Frame::reference; }
  /// In the reference frame but for periodic boxes: sums know what the kernel says of each pair (reference_sums.hpp), or with
  /// quadratic gradients what the fit makes of it (quadratic_sums.hpp).
  bool keeps_pairs() const { return in_reference_frame() && !box.any_periodic(); }
  bool keeps_weights() const { return keeps_pairs() && scheme.correction != Correction::quadratic; }
  std::span<const Matrix<Dim>> linear() const { return scheme.correction == Correction::linear ? linear_ : std::span<const Matrix<Dim>>(); }
  void build_reference();
  /// The rest of respond() when gradient_rate_ is there, but for the fast part. Returns the largest -tr L.
  double respond_in_reference(double dt);
  /// Particle i after dt of F'; returns tr L.
  template <class Law>
  double strain(const Law& law, std::size_t i, const Matrix<Dim>& rate, double dt);
  /// A = P B^T of reference_sums.hpp, with the pressure of bulk viscosity, which it notes down.
  Matrix<Dim> pull(std::size_t i);
  double viscous_power(std::size_t i) const { return -viscous_pressure_[i] * velocity_gradient_[i].trace() / particles.density[i]; }
  /// The fast parts of the rungs that there are.
  void make_fast_parts();
  /// Moves fast part k through a step of dt of the part before, in sub_steps[k] steps, and those that are faster with it.
  void advance_fast_part(std::size_t k, double dt, std::span<const int> sub_steps);
  void strain_fast_part(const FastPart<Dim>& part, double dt);
  void pull_fast_part(FastPart<Dim>& part);
  bool is_squeezed(std::size_t i) const { return !rung_.empty() && rung_[i] != 0; }
  /// Corrections, and what is kept of pairs, for the neighbours that there are now.
  void look_at_pairs();
  /// In the reference frame: cuts pairs where particles have failed since the last time.
  void open_cracks();
  void accelerate_in_reference(std::span<Vector<Dim>> velocity);

  NeighbourList neighbours_;
  std::vector<std::int32_t> index_of_id_;
  std::vector<Matrix<Dim>> velocity_gradient_, linear_;
  std::vector<Matrix<Dim>> gradient_rate_;   ///< in the reference frame: dv/dX, F'
  PairWeights weights_;
  PairGradients pair_gradients_;
  std::vector<std::uint8_t> rung_;
  std::vector<FastPart<Dim>> fast_;
  bool parted_ = false;
  double fast_viscous_work_ = 0.0, fast_deposit_ = 0.0;
  std::vector<Vector<Dim>> mean_velocity_;   ///< of a step with sub-steps
  Particles<Dim> undeformed_;                ///< in the reference frame: what the momentum sum sees, stress the first Piola-Kirchhoff
  std::vector<QuadraticGradient<Dim>> quadratic_;
  std::vector<double> viscous_pressure_;     ///< in the reference frame, Pa
  std::vector<double> damper_power_;         ///< in the reference frame, W/kg
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
