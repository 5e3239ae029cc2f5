// Simulation: the time loop. Kick, drift, respond, drift, kick: of second order in the step, with the strain rate taken at the
// middle of the step and the forces at its ends.
#pragma once

#include <functional>
#include <stdexcept>

#include "solver/body.hpp"
#include "solver/integrators/energy.hpp"
#include "solver/integrators/step_control.hpp"

namespace furrow {

/// A run that went wrong: says when, where and in which field.
class Divergence : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// When a run is given up.
template <int Dim>
struct Watch {
  Vector<Dim> low = Vector<Dim>::Constant(-1e30), high = Vector<Dim>::Constant(1e30);   ///< where particles may be
  double smallest_step = 1e-6;      ///< of the first step
  double largest_imbalance = 0.5;   ///< growth of energy without work, of the largest energy so far
};

template <int Dim>
class Simulation {
 public:
  Body<Dim> body;
  StepControl control;
  Watch<Dim> watch;

  /// Neighbours, accelerations and energies of the initial state. Call once, when the body is set up.
  void start();
  /// One step, no longer than until `end`; throws Divergence.
  void step(double end);
  /// Steps until `end`, calling observe(*this) after each.
  void run_until(double end, const std::function<void(const Simulation&)>& observe = {});

  double time() const { return time_; }
  double dt() const { return dt_; }
  StepLimiter limiter() const { return limiter_; }
  std::int64_t steps() const { return steps_; }
  /// Work and dissipation are those of this moment; what is stored (kinetic, elastic, plastic, in walls) and the imbalance are
  /// looked up every `stock_every` steps, in a step that reaches its `end`, and by take_stock().
  const EnergyLedger& energy() const { return energy_; }
  /// (E - E_0) over the largest kinetic plus elastic energy or work so far.
  double energy_imbalance() const { return imbalance_; }
  static constexpr std::int64_t stock_every = 10;
  /// With `control.stability` the largest frequency is looked up anew so often; in between it follows what is squeezed most.
  static constexpr std::int64_t frequency_every = 100;
  /// With `scheme.sub_cycling` the fast parts are chosen anew so often.
  static constexpr std::int64_t fast_part_every = 50;
  /// Steps of the fastest part so far, those of the body where there is none; and what they came to in steps of one particle.
  std::int64_t sub_steps() const { return sub_steps_; }
  std::int64_t particle_steps() const { return particle_steps_; }
  void take_stock();
  Vector<Dim> momentum() const;
  double angular_momentum() const;   ///< about z through the origin, kg m^2/s

  struct Powers {
    double viscous = 0.0, artificial = 0.0, damping = 0.0, external = 0.0, layer = 0.0, friction = 0.0, layer_viscous = 0.0;   ///< W, at the end of the last step
  };
  /// Everything but the particles that a restart needs to go on bit for bit.
  struct Clock {
    double time = 0.0, dt = 0.0, first_dt = 0.0;
    double compression = 0.0;        ///< largest -tr L, 1/s
    double initial_energy = 0.0, energy_scale = 0.0, initial_internal = 0.0;
    double wave_number = 0.0;        ///< kappa of step_length
    double deposited = 0.0;          ///< viscous heat in the particles' internal energy, J
    std::int64_t steps = 0, sub_steps = 0, particle_steps = 0;
    StepLimiter limiter = StepLimiter::courant;
    EnergyLedger energy;
    Powers powers;
  };
  Clock clock() const;
  /// Goes on from here: the body's particles must be those of the checkpoint, in its order.
  void resume(const Clock& clock);

 private:
  void drift(double dt);
  using SubSteps = std::array<int, most_fast_parts>;   ///< of each fast part in one of the part before
  SubSteps sub_steps_of(double dt, const StepLength& length) const;
  void move(double dt, const SubSteps& sub_steps);
  void account(double dt);
  void check() const;
  Powers powers() const;

  double time_ = 0.0, dt_ = 0.0, first_dt_ = 0.0, compression_ = 0.0, wave_number_ = 0.0;
  double initial_energy_ = 0.0, energy_scale_ = 0.0, initial_internal_ = 0.0, deposited_ = 0.0, imbalance_ = 0.0;
  std::int64_t steps_ = 0, sub_steps_ = 0, particle_steps_ = 0;
  StepLimiter limiter_ = StepLimiter::courant;
  EnergyLedger energy_;
  Powers powers_;
  std::vector<Vector<Dim>> predicted_, drift_;
};

}  // namespace furrow
