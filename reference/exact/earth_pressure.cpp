#include "reference/exact/earth_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace furrow::exact {

double rankine_active(double friction_angle) { return std::pow(std::tan(0.25 * std::numbers::pi - 0.5 * friction_angle), 2); }

double rankine_passive(double friction_angle) { return std::pow(std::tan(0.25 * std::numbers::pi + 0.5 * friction_angle), 2); }

double active_force(double friction_angle, double cohesion, double unit_weight, double height) {
  const double K = rankine_active(friction_angle), free_height = 2.0 * cohesion / (unit_weight * std::sqrt(K));
  const double pressed = std::max(0.0, height - free_height);
  return 0.5 * K * unit_weight * pressed * pressed;
}

double passive_force(double friction_angle, double cohesion, double unit_weight, double height) {
  const double K = rankine_passive(friction_angle);
  return 0.5 * K * unit_weight * height * height + 2.0 * cohesion * std::sqrt(K) * height;
}

double bearing_surcharge(double friction_angle) {
  return std::exp(std::numbers::pi * std::tan(friction_angle)) * rankine_passive(friction_angle);
}

double bearing_cohesion(double friction_angle) {
  if (friction_angle == 0.0) return 2.0 + std::numbers::pi;
  return (bearing_surcharge(friction_angle) - 1.0) / std::tan(friction_angle);
}

double vertical_cut_cohesion(double friction_angle, double unit_weight, double height, double stability_number) {
  return unit_weight * height / (stability_number * std::tan(0.25 * std::numbers::pi + 0.5 * friction_angle));
}

}  // namespace furrow::exact
