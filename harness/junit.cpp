#include <cmath>

#include <fmt/format.h>

#include "harness/result.hpp"

namespace furrow {
namespace {

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\n': result += "&#10;"; break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20 || c == '\t') result += c;
    }
  return result;
}

std::string shown(const Json& value) { return value.is_null() ? "none" : value.dump(); }

std::string message(const Json& metric) {
  std::string text = metric.value("reason", "");
  if (!metric["band"].is_null())
    text += fmt::format("{}error {} ({}), band [{}, {}], value {} {}", text.empty() ? "" : "; ", shown(metric["error"]),
                        metric["norm"].get<std::string>(), shown(metric["band"][0]), shown(metric["band"][1]),
                        shown(metric["value"]), metric["unit"].get<std::string>());
  return escaped(text);
}

// A child element of the test case, or nothing for a pass.
std::string outcome(const Json& metric) {
  const std::string verdict = metric["verdict"];
  if (verdict == "pass") return "";
  if (verdict == "fail") return fmt::format("<failure message=\"{}\"/>", message(metric));
  if (verdict == "error") return fmt::format("<error message=\"{}\"/>", message(metric));
  return fmt::format("<skipped message=\"{}: {}\"/>", verdict, message(metric));
}

}  // namespace

std::string junit_xml(const std::vector<Json>& results) {
  std::string suites;
  int tests = 0, failures = 0, errors = 0, skipped = 0;
  double time = 0.0;
  for (const Json& result : results) {
    int suite_tests = 0, suite_failures = 0, suite_errors = 0, suite_skipped = 0;
    const std::string id = escaped(result["case"].get<std::string>());
    std::string cases;
    for (const Json& metric : result["metrics"]) {
      const std::string verdict = metric["verdict"], inner = outcome(metric);
      ++suite_tests;
      if (verdict == "fail") ++suite_failures;
      if (verdict == "error") ++suite_errors;
      if (verdict == "known-gap" || verdict == "skipped" || verdict == "reported") ++suite_skipped;
      cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\"{}\n", id, escaped(metric["name"].get<std::string>()),
                           inner.empty() ? "/>" : ">" + inner + "</testcase>");
    }
    if (result["verdict"] == "error" && suite_errors == 0) {
      ++suite_tests;
      ++suite_errors;
      cases += fmt::format("    <testcase classname=\"{}\" name=\"case\"><error message=\"{}\"/></testcase>\n", id,
                           escaped(result.value("reason", "")));
    }
    const double wall = result["cost"]["wall_s"];
    suites += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n{}  </testsuite>\n",
        id, suite_tests, suite_failures, suite_errors, suite_skipped, wall, cases);
    tests += suite_tests;
    failures += suite_failures;
    errors += suite_errors;
    skipped += suite_skipped;
    time += wall;
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuites name=\"furrow\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n{}</testsuites>\n",
      tests, failures, errors, skipped, time, suites);
}

}  // namespace furrow
