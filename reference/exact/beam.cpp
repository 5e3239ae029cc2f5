#include "reference/exact/beam.hpp"

namespace furrow::exact {

double cantilever_deflection(const std::vector<BeamLoad>& loads, double x, double EI) {
  double sum = 0.0;
  for (const BeamLoad& load : loads) {
    const double a = load.arm;
    if (a <= 0.0) continue;
    sum += x >= a ? load.force * a * a * (3.0 * x - a) / (6.0 * EI) + load.couple * a * (2.0 * x - a) / (2.0 * EI)
                  : load.force * x * x * (3.0 * a - x) / (6.0 * EI) + load.couple * x * x / (2.0 * EI);
  }
  return sum;
}

double clamp_moment(const std::vector<BeamLoad>& loads) {
  double sum = 0.0;
  for (const BeamLoad& load : loads)
    if (load.arm > 0.0) sum += load.force * load.arm + load.couple;
  return sum;
}

double plate_stiffness(double E, double nu, double t) { return E * t * t * t / (12.0 * (1.0 - nu * nu)); }

}  // namespace furrow::exact
