#include "solver/smoothing/kernels.hpp"

#include <cstddef>
#include <utility>

namespace furrow {
namespace {

template <std::size_t... I>
std::vector<AnyKernel> one_of_each(std::index_sequence<I...>) {
  return {AnyKernel(std::in_place_index<I>)...};
}

std::vector<AnyKernel> all_kernels() { return one_of_each(std::make_index_sequence<std::variant_size_v<AnyKernel>>{}); }

std::string_view name_of(const AnyKernel& kernel) {
  return std::visit([](auto k) -> std::string_view { return decltype(k)::name; }, kernel);
}

}  // namespace

std::optional<AnyKernel> kernel_by_name(std::string_view name) {
  for (const AnyKernel& kernel : all_kernels()) {
    if (name_of(kernel) == name) return kernel;
  }
  return std::nullopt;
}

std::vector<std::string> kernel_names() {
  std::vector<std::string> names;
  for (const AnyKernel& kernel : all_kernels()) names.emplace_back(name_of(kernel));
  return names;
}

}  // namespace furrow
