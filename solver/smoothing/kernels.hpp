// THE list of smoothing kernels. A new kernel is a header of its own and a word here; tests and cases run over the list.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "solver/smoothing/cubic_spline.hpp"
#include "solver/smoothing/kernel.hpp"
#include "solver/smoothing/quintic_spline.hpp"
#include "solver/smoothing/wendland_c2.hpp"
#include "solver/smoothing/wendland_c4.hpp"

namespace furrow {

using AnyKernel = std::variant<CubicSpline, QuinticSpline, WendlandC2, WendlandC4>;

/// The kernel of this name; empty when there is none.
std::optional<AnyKernel> kernel_by_name(std::string_view name);
std::vector<std::string> kernel_names();

/// Radius of the support in units of h.
inline double support(const AnyKernel& kernel) {
  return std::visit([](auto k) { return decltype(k)::support; }, kernel);
}

}  // namespace furrow
