#include "reference/exact/quadrature.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace furrow::exact {

double integrate(const std::function<double(double)>& f, double a, double b, double absolute) {
  // GSL aborts the program on its first error unless told to return the status instead.
  [[maybe_unused]] static gsl_error_handler_t* const previous = gsl_set_error_handler_off();
  const std::unique_ptr<gsl_integration_cquad_workspace, decltype(&gsl_integration_cquad_workspace_free)> workspace(
      gsl_integration_cquad_workspace_alloc(200), gsl_integration_cquad_workspace_free);
  if (!workspace) throw std::runtime_error("quadrature: no memory for the workspace");

  // The rule leaves out points where the integrand is not finite; that must not go unseen.
  struct Watched {
    const std::function<double(double)>& f;
    bool finite = true;
  } watched{f};
  gsl_function integrand;
  integrand.function = [](double x, void* p) {
    Watched& w = *static_cast<Watched*>(p);
    const double y = w.f(x);
    w.finite = w.finite && std::isfinite(y);
    return y;
  };
  integrand.params = &watched;
  double result = 0.0, error = 0.0;
  const int status = gsl_integration_cquad(&integrand, a, b, absolute, 1e-13, workspace.get(), &result, &error, nullptr);
  if (status != GSL_SUCCESS || !watched.finite || !std::isfinite(result)) {
    throw std::runtime_error("quadrature over [" + std::to_string(a) + ", " + std::to_string(b) + "]: " +
                             (watched.finite ? gsl_strerror(status) : "the integrand is not finite everywhere"));
  }
  return result;
}

}  // namespace furrow::exact
