// Smoothing kernels: W(r, h) = sigma_d / h^d * w(q), q = r/h, with compact support of `support` smoothing lengths.
// A kernel is a small type with w, dw and its normalisation; everything else follows from those here.
#pragma once

#include <concepts>
#include <string_view>

namespace furrow {

template <class K>
concept SmoothingKernel = requires(double q, int dim) {
  { K::name } -> std::convertible_to<std::string_view>;      // as in case files: "cubic_spline"
  { K::support } -> std::convertible_to<double>;             // radius of the support in units of h
  { K::w(q) } -> std::same_as<double>;                       // shape, q >= 0, over doubles or Lanes; zero beyond the support
  { K::dw(q) } -> std::same_as<double>;                      // dw/dq
  { K::normalisation(dim) } -> std::same_as<double>;         // sigma_d for d = 1, 2, 3
};

/// Where w and dw of a kernel are found: the kernel itself, or its OneDimensional where the shape differs in one dimension.
template <SmoothingKernel K, int Dim>
struct KernelShape {
  using type = K;
};
template <SmoothingKernel K>
  requires requires { typename K::OneDimensional; }
struct KernelShape<K, 1> {
  using type = typename K::OneDimensional;
};
template <SmoothingKernel K, int Dim>
using Shape = typename KernelShape<K, Dim>::type;

/// (dw/dq)/q: grad W = scale/h^2 (dw/dq)/q (x_i - x_j). Kernels that know it spare a division.
template <class S, class Real>
constexpr Real dw_over_q(const Real& q) {
  if constexpr (requires { S::dw_over_q(q); })
    return S::dw_over_q(q);
  else
    return S::dw(q) / q;
}

/// sigma_d / h^d, 1/m^Dim.
template <SmoothingKernel K, int Dim>
constexpr double scale(double h) {
  double h_to_dim = h;
  for (int d = 1; d < Dim; ++d) h_to_dim *= h;
  return K::normalisation(Dim) / h_to_dim;
}

/// W(r, h), 1/m^Dim.
template <SmoothingKernel K, int Dim>
constexpr double value(double r, double h) {
  return scale<K, Dim>(h) * Shape<K, Dim>::w(r / h);
}

/// dW/dr, 1/m^(Dim+1).
template <SmoothingKernel K, int Dim>
constexpr double derivative(double r, double h) {
  return scale<K, Dim>(h) / h * Shape<K, Dim>::dw(r / h);
}

}  // namespace furrow
