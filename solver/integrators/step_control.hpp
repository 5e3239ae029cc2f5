#pragma once

#include <array>
#include <string_view>

#include "solver/body.hpp"

namespace furrow {

/// What set the length of a step.
enum class StepLimiter { courant, viscous, force, end_of_run, growth };
constexpr std::string_view name_of(StepLimiter limiter) {
  constexpr std::string_view names[] = {"courant", "viscous", "force", "end of run", "growth"};
  return names[static_cast<int>(limiter)];
}

struct StepControl {
  double courant = 0.3;   ///< times h/c
  double stability = 0.0; ///< reference frame: this part of 2/omega, omega the body's largest frequency; 0 = by `courant`
  double slow_stability = 0.5;   ///< as `stability`, of what is left where squeezed particles take shorter steps
  double force = 0.25;    ///< times sqrt(h/a)
  double first = 1.0;     ///< the first step is this part of what the conditions allow: less than 1 where a run begins with an impact
  double growth = 0.0;    ///< each step is at most so many times the one before it; 0 = no such limit
  double largest = 0.0;   ///< s; 0 = no such limit. Taken for every step where `fixed` is set
  bool fixed = false;
};

struct StepLength {
  double dt;
  StepLimiter limiter;
  std::array<double, most_fast_parts> part{};   ///< s; what each fast part can take, as many as there are
};

/// The smallest of the Courant condition h/c, in the reference frame h/c_s with c_s of the most squeezed particle
/// (reference_speed), the same with artificial viscosity h/(c + 0.6 (alpha c + beta mu)) (Monaghan 1992) and the force condition
/// sqrt(h/a), each with its factor; mu = h times `compression`, the largest -tr L (1/s). With `control.stability` the reference
/// frame's Courant conditions give way to the limit of the body as a whole, 2/omega = 2 h/(kappa c_s), kappa the body's
/// largest_wave_number(). Where the body has fast parts, that is the length of the shortest sub-steps, and each slower rung takes
/// slow_stability 2 h/(kappa c_s) with its own kappa, slower_wave_number, and the most squeezed particle of it and of slower ones.
/// Limiter `courant` stands for all of that and for a length given from outside as well.
template <int Dim>
StepLength step_length(const Body<Dim>& body, double compression, const StepControl& control, double wave_number = 0.0);

}  // namespace furrow
