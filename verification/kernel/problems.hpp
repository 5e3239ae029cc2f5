// The problems of the family `kernel`.
#pragma once

#include "harness/case.hpp"

namespace furrow::kernel_cases {

Problem continuous(const Parameters& input);   ///< the kernel as a function: moments, derivative, shape, Fourier transform
Problem discrete(const Parameters& input);     ///< the kernel summed over particles, by the solver's own lists and sums

}  // namespace furrow::kernel_cases
