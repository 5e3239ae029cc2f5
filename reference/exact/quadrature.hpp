// GSL quadrature behind one function. Integrands of several pieces are fine: the rule is doubly adaptive.
#pragma once

#include <functional>

namespace furrow::exact {

/// Integral of f over [a, b] by gsl_integration_cquad (Gonnet 2010), asked for an error below the larger of
/// `absolute` and 1e-13 of the integral. Throws std::runtime_error when GSL reports a failure or the
/// integrand is not finite at a point that was asked for.
double integrate(const std::function<double(double)>& f, double a, double b, double absolute = 1e-14);

}  // namespace furrow::exact
