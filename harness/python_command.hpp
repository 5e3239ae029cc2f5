// Commands that read result files only: they are Python, and this program becomes them.
#pragma once

#include <string>
#include <vector>

namespace furrow {

struct PythonCommand {
  const char* name;
  const char* module;        ///< python3 -m module name ...
  const char* description;
};

inline constexpr PythonCommand python_commands[] = {
    {"gate", "gate", "Compare a run with the accepted baselines: what moved, where to, and whether it may be merged"},
    {"bless", "gate", "Accept cases of a run as baselines, with a reason for the ledger"},
    {"nightly", "night", "Run the nightly tier, remember every number of it, and tell in one screen what moved"},
    {"history", "night", "What was measured, night by night, and since which commit it is different"},
    {"defects", "defects", "Plant defects in a copy of the code and see which case catches each"},
    {"figures", "reports.paper", "Draw the paper's Table 1 and figures from results, running the cases that are missing"},
    {"noise", "gate", "Measure from several runs of one commit how far each metric moves without a cause"},
};

/// Replaces this process by the Python that answers `command`, from the current folder; the package is the project's own, and
/// FURROW_PROGRAM names this program. Returns only by throwing std::runtime_error.
[[noreturn]] int become_python(const PythonCommand& command, const std::vector<std::string>& arguments);

}  // namespace furrow
