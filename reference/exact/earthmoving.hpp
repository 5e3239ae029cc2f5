// The two-dimensional earthmoving equation (Reece 1965; McKyes & Ali 1977): a plane wedge of soil that a wide blade pushes up.
#pragma once

namespace furrow::exact {

/// A cut, SI units and rad; forces are per width.
struct Cut {
  double density;             ///< kg/m^3
  double cohesion;            ///< Pa
  double friction_angle;      ///< of the soil
  double rake;                ///< of the blade's face, from the horizontal ahead
  double depth;               ///< m
  double speed;               ///< m/s
  double tool_friction = 0.0; ///< angle
  double adhesion = 0.0;      ///< Pa
  double surcharge = 0.0;     ///< Pa
  double gravity = 0.0;       ///< m/s^2
};

struct CutForce {
  double draft;      ///< on the blade, against its motion, N/m
  double vertical;   ///< on the blade, positive up, N/m
  double rupture;    ///< angle of the rupture plane, rad
};

/// Which rupture plane is taken. Least force: the one that makes all of P least, with inertia (Perumpral, Swick). At rest: the one
/// that makes it least without; McKyes too looks for it among the static terms (in that of weight alone). The two are one at speed
/// zero; inertia makes the first ever flatter, though limit analysis, which knows no inertia, proves nothing of it then.
enum class Rupture { least_force, at_rest };

/// P = rho g d^2 N_g + c d N_c + c_a d N_ca + q d N_q + rho v^2 d N_a on the rupture plane chosen, with
///   D = cos(alpha + delta) + sin(alpha + delta) cot(beta + phi),  N_g = (cot alpha + cot beta)/(2 D),
///   N_c = [1 + cot beta cot(beta + phi)]/D,  N_ca = [1 - cot alpha cot(beta + phi)]/D,  N_q = (cot alpha + cot beta)/D,
///   N_a = [tan beta + cot(beta + phi)]/{D [1 + tan beta cot alpha]},
/// draft P sin(alpha + delta) + c_a d cot alpha, vertical -P cos(alpha + delta) + c_a d. Throws std::invalid_argument where
/// alpha + delta + phi leaves no plane.
CutForce earthmoving(const Cut& cut, Rupture rupture = Rupture::least_force);

}  // namespace furrow::exact
