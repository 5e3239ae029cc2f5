// Limit states of soil with friction and cohesion in plane strain: earth pressure, bearing, a vertical cut.
#pragma once

namespace furrow::exact {

/// Rankine's coefficients tan^2(45 deg -+ phi/2); phi in rad.
double rankine_active(double friction_angle);
double rankine_passive(double friction_angle);

/// Force on a smooth vertical wall of height H, N/m: the integral of K_a gamma z - 2 c sqrt(K_a), where that is a pressure; of K_p
/// gamma z + 2 c sqrt(K_p). unit_weight in N/m^3, cohesion in Pa, height in m.
double active_force(double friction_angle, double cohesion, double unit_weight, double height);
double passive_force(double friction_angle, double cohesion, double unit_weight, double height);

/// Prandtl's bearing factors: N_q = e^(pi tan phi) K_p, N_c = (N_q - 1) cot phi, 2 + pi for phi = 0 (Prandtl 1920).
double bearing_surcharge(double friction_angle);
double bearing_cohesion(double friction_angle);

/// Cohesion at which a vertical cut of height H just stands, Pa: c = gamma H/(N tan(45 deg + phi/2)) with the stability number N
/// of slip circles, 3.83 (Taylor 1937). Its plane wedge has N = 4.
double vertical_cut_cohesion(double friction_angle, double unit_weight, double height, double stability_number = 3.83);

}  // namespace furrow::exact
