// Catch2, version 2 or 3, under one name. Version 2 puts Approx into the global namespace by itself.
#pragma once

#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
using Catch::Approx;
#else
#include <catch2/catch.hpp>
#endif
