// The command line: ./furrow list | run | matrix | report | test | bench.
#pragma once

#include <vector>

#include "harness/case.hpp"

namespace furrow {

/// Runs one command and returns its exit code: 0 nothing red, 1 a metric is red, 2 wrong usage or input, 3 a case ended as error.
int command_line(const std::vector<Family>& families, int argc, char** argv);

}  // namespace furrow
