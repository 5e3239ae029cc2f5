#include "reference/exact/earthmoving.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace furrow::exact {
namespace {

double cot(double x) { return 1.0 / std::tan(x); }

/// Force on the blade along its friction direction for the rupture plane beta, N/m.
double wedge(const Cut& c, double beta) {
  const double a = c.rake + c.tool_friction, slip = cot(beta + c.friction_angle), d = c.depth;
  const double D = std::cos(a) + std::sin(a) * slip;
  const double weight = c.density * c.gravity * d * d * 0.5 * (cot(c.rake) + cot(beta));
  const double cohesion = c.cohesion * d * (1.0 + cot(beta) * slip), adhesion = c.adhesion * d * (1.0 - cot(c.rake) * slip);
  const double surcharge = c.surcharge * d * (cot(c.rake) + cot(beta));
  const double inertia = c.density * c.speed * c.speed * d * (std::tan(beta) + slip) / (1.0 + std::tan(beta) * cot(c.rake));
  return (weight + cohesion + adhesion + surcharge + inertia) / D;
}

}  // namespace

CutForce earthmoving(const Cut& c, Rupture rupture) {
  Cut chosen = c;   // the plane is looked for with this
  if (rupture == Rupture::at_rest) chosen.speed = 0.0;
  const double highest = std::numbers::pi - c.rake - c.tool_friction - c.friction_angle;
  if (!(highest > 0.0)) throw std::invalid_argument("the blade is too steep and too rough for a plane of rupture");
  // P is infinite at both ends and has one least value between: coarse search, then golden section.
  constexpr int samples = 1000;
  int best = 1;
  const auto at = [&](int k) { return highest * k / samples; };
  for (int k = 2; k < samples; ++k)
    if (wedge(chosen, at(k)) < wedge(chosen, at(best))) best = k;
  double low = at(best - 1 > 0 ? best - 1 : 1), high = at(best + 1 < samples ? best + 1 : samples - 1);
  const double golden = std::numbers::phi - 1.0;
  while (high - low > 1e-12) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    (wedge(chosen, left) < wedge(chosen, right) ? high : low) = wedge(chosen, left) < wedge(chosen, right) ? right : left;
  }
  const double beta = 0.5 * (low + high), P = wedge(c, beta), a = c.rake + c.tool_friction;
  return {P * std::sin(a) + c.adhesion * c.depth * cot(c.rake), -P * std::cos(a) + c.adhesion * c.depth, beta};
}

}  // namespace furrow::exact
