#include "reference/exact/rate_path.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_odeiv2.h>

namespace furrow::exact {
namespace {

constexpr std::size_t size = 10;   // six stresses, density, energy, hardening, temperature
using Array = std::array<double, size>;
constexpr double shear_twice[6] = {1.0, 1.0, 1.0, 2.0, 2.0, 2.0};

Array pack(const Point& p) {
  Array y{};
  std::copy(p.stress.begin(), p.stress.end(), y.begin());
  y[6] = p.density;
  y[7] = p.energy;
  y[8] = p.hardening;
  y[9] = p.temperature;
  return y;
}

Point unpack(const double* y) {
  Point p;
  std::copy(y, y + 6, p.stress.begin());
  p.density = y[6];
  p.energy = y[7];
  p.hardening = y[8];
  p.temperature = y[9];
  return p;
}

/// W sigma - sigma W.
Voigt turning(const Voigt& s, const std::array<double, 3>& w) {
  const double S[3][3] = {{s[0], s[3], s[5]}, {s[3], s[1], s[4]}, {s[5], s[4], s[2]}};
  const double W[3][3] = {{0.0, w[0], -w[2]}, {-w[0], 0.0, w[1]}, {w[2], -w[1], 0.0}};
  const auto at = [&](int i, int j) {
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += W[i][k] * S[k][j] - S[i][k] * W[k][j];
    return sum;
  };
  return {at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(1, 2), at(2, 0)};
}

struct Rates {
  Array dydt{};
  double multiplier = 0.0;     // 1/s
  double plastic_rate = 0.0;   // equivalent, 1/s
};

enum class Mode { elastic, slow, fast };

/// One leg in one mode of the law.
struct System {
  const RateLaw* law;
  const Leg* leg;
  Mode mode;

  /// Strain rates that the stress-controlled components need, by a linear system, and with them everything else.
  Rates rates(const Point& p) const {
    const double G = law->shear_modulus, K = law->bulk_modulus(p), by_energy = law->pressure_by_energy(p);
    const Flow flow = mode == Mode::elastic ? Flow{} : mode == Mode::slow ? law->flow(p) : law->fast(p);
    const bool slow = mode == Mode::slow;
    const double viscous = mode == Mode::fast ? flow.multiplier : 0.0;
    const Voigt away = deviator(flow.direction);   // stress taken off per multiplier
    Voigt off{};
    for (std::size_t i = 0; i < 6; ++i) off[i] = 2.0 * G * away[i] + (i < 3 ? K * trace(flow.direction) : 0.0);
    const Voigt turned = turning(p.stress, leg->spin);

    // stress rate i = turned_i + sum_j C_ij D_j - viscous off_i
    double C[6][6];
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) {
        const bool normal = i < 3 && j < 3;
        C[i][j] = (i == j ? 2.0 * G : 0.0) + (normal ? K - 2.0 / 3.0 * G : 0.0);
        if (i < 3) C[i][j] -= by_energy * p.stress[j] * shear_twice[j] / p.density;
        if (slow) C[i][j] -= off[i] * flow.gradient[j] * shear_twice[j];
      }
    Voigt D = leg->rate;
    std::array<std::size_t, 6> unknown{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < 6; ++i)
      if (leg->stress_controlled[i]) unknown[n++] = i;
    if (n > 0) {
      std::array<double, 36> a{};
      std::array<double, 6> b{};
      for (std::size_t r = 0; r < n; ++r) {
        const std::size_t i = unknown[r];
        b[r] = leg->rate[i] - turned[i] + viscous * off[i];
        for (std::size_t j = 0; j < 6; ++j)
          if (!leg->stress_controlled[j]) b[r] -= C[i][j] * D[j];
        for (std::size_t c = 0; c < n; ++c) a[r * n + c] = C[i][unknown[c]];
      }
      gsl_matrix_view A = gsl_matrix_view_array(a.data(), n, n);
      gsl_vector_view B = gsl_vector_view_array(b.data(), n);
      if (gsl_linalg_HH_svx(&A.matrix, &B.vector) != GSL_SUCCESS) b.fill(std::nan(""));
      for (std::size_t r = 0; r < n; ++r) D[unknown[r]] = b[r];
    }

    Rates r;
    r.multiplier = slow ? contraction(flow.gradient, D) : viscous;
    r.plastic_rate = r.multiplier * flow.strain;
    for (std::size_t i = 0; i < 6; ++i) {
      r.dydt[i] = turned[i];
      for (std::size_t j = 0; j < 6; ++j) r.dydt[i] += C[i][j] * D[j];
      r.dydt[i] -= viscous * off[i];
    }
    r.dydt[6] = -p.density * trace(D);
    r.dydt[7] = contraction(p.stress, D) / p.density;
    r.dydt[8] = r.multiplier * flow.hardening;
    r.dydt[9] = r.multiplier * flow.heating * contraction(p.stress, flow.direction);
    return r;
  }
};

int derivative(double, const double y[], double dydt[], void* params) {
  const Rates r = static_cast<const System*>(params)->rates(unpack(y));
  for (std::size_t i = 0; i < size; ++i) {
    if (!std::isfinite(r.dydt[i])) return GSL_FAILURE;   // a trial step too long: GSL takes a shorter one
    dydt[i] = r.dydt[i];
  }
  return GSL_SUCCESS;
}

template <class T, void (*release)(T*)>
struct Release {
  void operator()(T* p) const { release(p); }
};
template <class T, void (*release)(T*)>
using Owned = std::unique_ptr<T, Release<T, release>>;

/// Integrates one leg at a time; switches between flow and none where the law says so.
class Follower {
 public:
  // Viscoplastic flow is stiff (its stress relaxes within a strain of 1e-5), but mildly: Prince and Dormand's explicit method of
  // eighth order gets along, and starts well where the hardening B eps_p^n has no derivative.
  Follower(const RateLaw& law, double tolerance)
      : law_(law), step_(gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, size)), evolve_(gsl_odeiv2_evolve_alloc(size)) {
    const double s = law.stress_scale;
    const Array scale = {s, s, s, s, s, s, 1e3, 1e4, law.hardening_scale, 300.0};
    control_.reset(gsl_odeiv2_control_scaled_new(tolerance, 0.0, 1.0, 0.0, scale.data(), size));
  }

  std::vector<Point> follow(const Point& start, const std::vector<Leg>& legs) {
    std::vector<Point> states;
    Array y = pack(start);
    for (const Leg& leg : legs) {
      system_ = {&law_, &leg, Mode::elastic};
      system_.mode = choice(y);
      restart();
      double h = 1e-6 * leg.duration;
      for (int k = 1; k <= leg.samples; ++k) {
        advance(y, leg.duration * (k - 1) / leg.samples, leg.duration * k / leg.samples, h);
        states.push_back(unpack(y.data()));
      }
    }
    return states;
  }

 private:
  /// The mode in which the law goes on from here along this leg.
  Mode choice(const Array& y) const {
    const Point p = unpack(y.data());
    const double f = law_.yield(p), tolerance = 1e-10 * law_.stress_scale;
    if (f < -tolerance) return Mode::elastic;
    if (law_.fast && f > tolerance) return Mode::fast;
    const Rates slow = System{&law_, system_.leg, Mode::slow}.rates(p);
    if (!(slow.multiplier > 0.0)) return Mode::elastic;
    return law_.fast && slow.plastic_rate >= (1.0 - 1e-6) * law_.slowest_fast ? Mode::fast : Mode::slow;
  }

  /// Negative while the mode holds, relative to its scale.
  double event(const Array& y) const {
    const Point p = unpack(y.data());
    switch (system_.mode) {
      case Mode::elastic:
        return law_.yield(p) / law_.stress_scale;
      case Mode::fast:
        return -law_.yield(p) / law_.stress_scale;
      case Mode::slow:
        break;
    }
    const Rates r = system_.rates(p);
    if (r.multiplier < 0.0) return 1.0;
    return law_.fast ? r.plastic_rate / law_.slowest_fast - 1.0 : -1.0;
  }

  void restart() {
    gsl_odeiv2_evolve_reset(evolve_.get());
    gsl_odeiv2_step_reset(step_.get());
  }

  void apply(double& t, double end, double& h, Array& y) {
    if (gsl_odeiv2_evolve_apply(evolve_.get(), control_.get(), step_.get(), &gsl_, &t, end, &h, y.data()) != GSL_SUCCESS)
      throw std::runtime_error("rate path: the integration failed");
  }

  void advance(Array& y, double t, double end, double& h) {
    constexpr double on_surface = 1e-12;
    for (int steps = 0; t < end; ++steps) {
      if (steps > 1000000) throw std::runtime_error("rate path: too many steps");
      const Array before = y;
      const double t_before = t;
      apply(t, end, h, y);
      if (event(y) <= on_surface) continue;
      // Somewhere in this step the mode ended: halve until the step ends there.
      double low = 0.0, high = t - t_before;
      for (int k = 0; k < 60 && std::abs(event(y)) > on_surface; ++k) {
        const double middle = 0.5 * (low + high);
        y = before;
        t = t_before;
        restart();
        double inner = middle;
        while (t < t_before + middle) apply(t, t_before + middle, inner, y);
        (event(y) > 0.0 ? high : low) = middle;
      }
      system_.mode = choice(y);
      restart();
      h = 1e-3 * (end - t_before);
    }
  }

  const RateLaw& law_;
  System system_{};
  gsl_odeiv2_system gsl_{derivative, nullptr, size, &system_};
  Owned<gsl_odeiv2_step, gsl_odeiv2_step_free> step_;
  Owned<gsl_odeiv2_evolve, gsl_odeiv2_evolve_free> evolve_;
  Owned<gsl_odeiv2_control, gsl_odeiv2_control_free> control_;
};

}  // namespace

double contraction(const Voigt& a, const Voigt& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 6; ++i) sum += shear_twice[i] * a[i] * b[i];
  return sum;
}

double trace(const Voigt& a) { return a[0] + a[1] + a[2]; }

Voigt deviator(const Voigt& a) {
  Voigt s = a;
  for (std::size_t i = 0; i < 3; ++i) s[i] -= trace(a) / 3.0;
  return s;
}

double sqrt_j2(const Voigt& stress) {
  const Voigt s = deviator(stress);
  return std::sqrt(0.5 * contraction(s, s));
}

std::vector<Point> follow(const RateLaw& law, const Point& start, const std::vector<Leg>& legs, double tolerance) {
  // GSL aborts the program on its first error unless told to return the status instead.
  [[maybe_unused]] static gsl_error_handler_t* const previous = gsl_set_error_handler_off();
  return Follower(law, tolerance).follow(start, legs);
}

}  // namespace furrow::exact
