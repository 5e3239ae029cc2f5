// Coupled simulation: a soft body (soil) and a stiff one (a metal tool) in contact, each with a step of its own. The metal's step is
// hundreds of times shorter than the soil's: it goes many steps within one of the soil's, under contact forces that are held.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/boundaries/contact.hpp"
#include "solver/boundaries/summation_interface.hpp"
#include "solver/simulation.hpp"

namespace furrow {

/// The stiff body's surface as an outline: particles of its outermost layer, and behind them points of what it is fixed to.
struct BodySurface {
  static constexpr std::int32_t rigid = -1;
  std::vector<std::int32_t> ids;              ///< of the nodes, anticlockwise; `rigid` for a point of the rigid part
  std::vector<Vector<2>> start;               ///< of the nodes, m
  std::function<Vector<2>(double)> displacement, velocity;   ///< of the rigid part
  double radius = 0.0;                        ///< from nodes to the surface, m: half a spacing of the stiff body
};

/// Kicks of the soil and of the tool are the same to round-off: the soil's step from t_n to t_(n+1) takes the contact force F_n for
/// its first half and F_(n+1) for its second; the tool's steps in it take F_n (dt_(n-1) + dt_n)/(2 dt_n), so that after every step
/// it has been given what the soil has but the last half kick, which it gets in the next one.
class CoupledSimulation {
 public:
  Simulation<2> soft, stiff;
  Contact<2> contact;
  BodySurface surface;
  bool single_rate = false;   ///< both bodies take the step of the stiff one
  /// In place of `contact`, which then measures overlap and gives no force: sums over the particles of both bodies alike. Only with
  /// a single rate, since the stress of the stiff body changes in each of its steps, and with both bodies in the present frame.
  std::optional<SummationInterface> summation;

  CoupledSimulation() = default;
  CoupledSimulation(const CoupledSimulation&) = delete;
  CoupledSimulation& operator=(const CoupledSimulation&) = delete;

  /// Call once, when both bodies are set up, before soft.start() or soft.resume(): from then on every look that the soil takes at
  /// its surroundings brings the tool to the same time, and soft.step() is a step of both.
  void couple();

  const Outline<2>& outline() const { return outline_; }
  /// Particles of the stiff body (or points of its rigid part) that forces of the soft one act on, by id: with contact those of its
  /// surface, with sums over both bodies all of it; and these forces as of the last look, N.
  const std::vector<std::int32_t>& node_ids() const { return summation ? all_ids_ : surface.ids; }
  const std::vector<Vector<2>>& node_forces() const { return node_force_; }
  std::int64_t sub_steps() const { return stiff.steps(); }

  /// Momentum, N s, since the start: given to the tool's particles by contact, to its rigid part by contact, to the tool by its
  /// actuator, and by stones that stand in its way.
  struct Impulses {
    Vector<2> contact = Vector<2>::Zero(), rigid = Vector<2>::Zero(), actuator = Vector<2>::Zero(), stones = Vector<2>::Zero();
    Vector<2> soil = Vector<2>::Zero();   ///< given to the soil by contact
    Vector<2> pending = Vector<2>::Zero();   ///< what the soil has been given and the tool will be in the next step
  };
  const Impulses& impulses() const { return impulses_; }
  /// Force on the actuator that drives the tool, N: of the driven particles and of the rigid part's surface.
  Vector<2> actuator_force() const;
  /// Energy of both, stored and dissipated, less the work from outside since the start, J: 0 but for errors.
  double energy_error() const;
  /// Work of the actuator on the tool so far, J, which other energies are to be compared with.
  double actuator_work() const { return actuator_work_; }
  /// Called after every step of the tool.
  std::function<void(const Simulation<2>& stiff)> observe_stiff;

  /// Everything but the two simulations that a restart needs.
  struct Memory {
    Contact<2>::Memory contact;
    Impulses impulses;
    double actuator_work = 0.0, previous_dt = 0.0, initial_energy = 0.0;
    Vector<2> reaction = Vector<2>::Zero(), stone_force = Vector<2>::Zero();
    std::vector<Vector<2>> node_force, held_force;
  };
  Memory memory() const;
  void remember(const Memory& memory);

 private:
  void couple_by_sums();
  Body<2>::Exchange exchange(double time, std::span<const Vector<2>> velocity, std::span<Vector<2>> acceleration,
                             Vector<2>& force);
  Body<2>::Exchange look(double time, std::span<const Vector<2>> velocity, std::span<Vector<2>> acceleration);
  void advance_stiff(double time);
  /// A new held force on the k-th particle that has one.
  void change_held(std::size_t k, const Vector<2>& force);
  void place_outline(double time);
  Vector<2> reaction() const;
  Vector<2> stone_force() const;

  Outline<2> outline_;
  Impulses impulses_;
  std::vector<std::int32_t> all_ids_;
  std::vector<Vector<2>> node_force_;
  std::vector<std::uint8_t> soil_;     ///< by the soft body's particle: whether it is none of a boundary layer
  std::vector<std::uint8_t> driven_;   ///< by held force: whether its particle is moved by the actuator
  bool started_ = false;
  double previous_dt_ = 0.0, actuator_work_ = 0.0, initial_energy_ = 0.0;
  Vector<2> reaction_ = Vector<2>::Zero(), stone_force_ = Vector<2>::Zero();
};

}  // namespace furrow
