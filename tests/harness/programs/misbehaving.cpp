// A program like furrow itself, whose one problem ends in every way a problem should not: for the tests of the runner.
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <thread>

#include "harness/command_line.hpp"

using namespace furrow;

namespace {

void never_end(Run& run) {
  for (long step = 0;; ++step) {
    run.progress(1e-3 * static_cast<double>(step), 1e6, step);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

const std::map<std::string, Problem> endings{
    {"good", [](Run& run) { run.measure("length", 1.0, "mm"); }},
    {"too_long", [](Run& run) { run.measure("length", 3.0, "mm"); }},
    {"throws", [](Run&) { throw std::runtime_error("the time step fell to zero"); }},
    {"aborts", [](Run&) { std::abort(); }},
    {"killed", [](Run&) { std::raise(SIGKILL); }},
    {"leaves", [](Run&) { std::_Exit(0); }},
    {"never_ends", never_end},
    {"measures_nan", [](Run& run) { run.measure("length", std::numeric_limits<double>::quiet_NaN(), "mm"); }},
    {"measures_nothing", [](Run&) {}},
    {"measures_more", [](Run& run) { run.measure("length", 1.0, "mm"), run.measure("width", 1.0, "mm"); }},
    {"measures_twice", [](Run& run) { run.measure("length", 1.0, "mm"), run.measure("length", 1.0, "mm"); }},
    {"measures_seconds", [](Run& run) { run.measure("length", 1.0, "s"); }},
    {"declares_more", [](Run& run) { run.measure("length", 1.0, "mm"), run.exercises("schemes/momentum"); }},
    {"skips", [](Run& run) { run.skip("length", "nothing to measure here"); }},
    {"skips_silently", [](Run& run) { run.skip("length", ""); }},
    {"half_result", [](Run& run) {
       run.measure("length", 1.0, "mm");
       std::ofstream(run.folder() / "result.json") << "{\"schema\": 1, \"case\"";
       std::_Exit(0);
     }},
};

Problem build(const Parameters& parameters) {
  std::vector<std::string> names;
  for (const auto& [name, problem] : endings) names.push_back(name);
  return endings.at(parameters.choice("how", names));
}

}  // namespace

int main(int argc, char** argv) {
  Family family("misbehaving", "tests/harness/programs", "ends in every way a problem should not");
  family.add("ends", build);
  return command_line({family}, argc, argv);
}
