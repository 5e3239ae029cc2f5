#include "harness/case_file.hpp"

#include <filesystem>
#include <fstream>

#include <unistd.h>

#include "tests/catch.hpp"

using namespace furrow;

namespace {

Problem slab(const Parameters& p) {
  p.choice("kernel", {"cubic_spline", "wendland_c2"});
  p.integer("dimension", 1, 3);
  p.quantity_or("width", dimension::length, 1.0, range::positive);
  return [](Run&) {};
}

// A family with one problem, and a case file in a folder of its own.
struct Sample {
  std::vector<Family> families{Family("slab", "nowhere", "a slab").add("slab", slab)};
  Bibliography bibliography{{"book", {"book", "A book", ""}}};
  std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("furrow-case-file-" + std::to_string(getpid()) + ".toml");

  ~Sample() { std::filesystem::remove(file); }

  std::vector<CaseSpec> read(const std::string& text, const Overrides& overrides = {}) {
    std::ofstream(file) << text;
    return read_case_file(file, families, nullptr, bibliography, overrides);
  }
  std::string message(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  REQUIRE(text.find(from) != std::string::npos);
  return text.replace(text.find(from), from.size(), to);
}

const std::string text = R"(family = "slab"
[[case]]
name = "{kernel}-{dimension}d"
problem = "slab"
title = "Slab of {kernel}"
why = "w"
description = "d"
tier = "quick"
sweep = { kernel = ["cubic_spline", "wendland_c2"], dimension = [1, 2, 3] }
parameters = { width = { value = 3, unit = "mm" } }
resolution = { spacing = { value = [1, 4, 2], unit = "mm" }, h_over_dx = [1.5, 1.2] }
[[case.metric]]
name = "error"
symbol = "e"
unit = "mm"
class = "exact"
reference = { value = 2.0, standard_uncertainty = 0.1, source = "book" }
norm = "L2 relative"
band = [0.0, inf]
band_why = "b"
ladder = "error"
at = { h_over_dx = 1.2, spacing = { value = 2, unit = "mm" } }
[[case.metric]]
name = "order"
symbol = "p"
unit = "1"
class = "exact"
reference = { source = "book" }
norm = "value"
band = [1.8, 2.2]
band_why = "b"
observed_order_of = "error"
when = { dimension = [2, 3] }
)";

}  // namespace

TEST_CASE("A sweep is an instance for each combination, named after its values", "[case_file]") {
  Sample sample;
  const std::vector<CaseSpec> cases = sample.read(text);
  REQUIRE(cases.size() == 6);
  std::vector<std::string> ids;
  for (const CaseSpec& spec : cases) ids.push_back(spec.id);
  CHECK(std::count(ids.begin(), ids.end(), "slab/wendland-c2-3d") == 1);
  CHECK(cases[0].title == "Slab of cubic spline");
  CHECK(cases[0].tier == Tier::quick);
  CHECK(cases[0].time_limit == 300.0);
  CHECK(cases[0].fingerprint != cases[1].fingerprint);
  CHECK(sample.read(text)[0].fingerprint == cases[0].fingerprint);
}

TEST_CASE("A ladder goes from coarse to fine, and the gated rung is found in it", "[case_file]") {
  Sample sample;
  const CaseSpec spec = sample.read(text)[0];
  REQUIRE(spec.spacing.size() == 3);
  CHECK(spec.spacing[0] == Approx(4e-3));
  CHECK(spec.spacing[2] == Approx(1e-3));
  CHECK(spec.smoothing_ratio == std::vector<double>{1.5, 1.2});
  CHECK(spec.metrics[0].spacing_index == 1);
  CHECK(spec.metrics[0].ratio_index == 1);
  CHECK(spec.metrics[0].norm == Norm::relative);
  CHECK(spec.metrics[0].norm_words == "L2 relative");
  CHECK(std::isinf(spec.metrics[0].band->high));
}

TEST_CASE("A metric may be there for some parameter values only", "[case_file]") {
  Sample sample;
  for (const CaseSpec& spec : sample.read(text)) CHECK(spec.metrics.size() == (spec.id.ends_with("1d") ? 1u : 2u));
  CHECK(sample.message(replaced(text, "when = { dimension", "when = { height")).find("metric[1].when.height: ") !=
        std::string::npos);
}

TEST_CASE("Overrides change the named cases only, win over the sweep, and are recorded", "[case_file]") {
  Sample sample;
  const std::vector<CaseSpec> cases =
      sample.read(text, {{"parameters.kernel=wendland_c2", "resolution.h_over_dx=[1.2, 2.0]"}, {"slab/cubic-spline-1d"}});
  int changed = 0;
  for (const CaseSpec& spec : cases) {
    const bool is_named = spec.id == "slab/cubic-spline-1d";
    CHECK(spec.overrides.empty() != is_named);
    CHECK(spec.smoothing_ratio[1] == (is_named ? 2.0 : 1.2));
    if (is_named) changed += spec.parameters_json.find("wendland_c2") != std::string::npos ? 1 : 0;
  }
  CHECK(changed == 1);
}

TEST_CASE("What a band or an order cannot be is refused", "[case_file]") {
  Sample sample;
  const auto contains = [](const std::string& message, const char* words) {
    INFO(message);
    CHECK(message.find(words) != std::string::npos);
  };
  contains(sample.message(replaced(text, "band = [1.8, 2.2]", "band = [1.8, inf]")), "found an open end, expected two numbers");
  contains(sample.message(replaced(text, "band = [0.0, inf]", "band = [1.0, 0.0]")), "expected the lower end first, [0, 1]");
  contains(sample.message(replaced(text, "ladder = \"error\"\n", "")),
           "observed_order_of: found \"error\", expected a metric of this case that has a ladder");
  const std::string limit = replaced(text, "observed_order_of", "limit_of");
  contains(sample.message(limit), "limit_of: found \"error\", expected a metric with a ladder of values in the same unit");
  contains(sample.message(replaced(limit, "limit_of = \"error\"", "limit_of = \"width\"")),
           "limit_of: found \"width\", expected a metric of this case that has a ladder");
  contains(sample.message(replaced(limit, "limit_of = \"error\"", "limit_of = \"error\"\nladder = \"value\"")),
           "found a ladder on a metric that is read from another's");
  contains(sample.message(replaced(limit, "limit_of = \"error\"", "limit_of = \"error\"\nobserved_order_of = \"error\"")),
           "found a limit and an observed order in one metric");
  contains(sample.message(replaced(text, "value = [1, 4, 2]", "value = [1, 4]")),
           "at.spacing: found a number that is not in the case's resolution");
  contains(sample.message(replaced(text, "value = [1, 4, 2]", "value = [4, 2]")),
           "found a ladder of 2 spacings, expected at least three");
  contains(sample.message(replaced(text, "norm = \"L2 relative\"", "norm = \"L3 relative\"")),
           "found \"L3 relative\", expected absolute, relative or value");
  contains(sample.message(replaced(text, "value = 2.0, s", "value = 0.0, s")), "the norm is relative to it");
  contains(sample.message(replaced(text, "band = [0.0, inf]", "reported = true\nband = [0.0, inf]")), "expected one of the two");
}

TEST_CASE("Two cases of one name are refused, as is a key in sweep and parameters at once", "[case_file]") {
  Sample sample;
  CHECK(sample.message(replaced(text, "{kernel}-{dimension}d", "{kernel}")).find("found a second case slab/cubic-spline") !=
        std::string::npos);
  CHECK(sample.message(replaced(text, "parameters = {", "parameters = { kernel = \"cubic_spline\","))
            .find("sweep.kernel: found in parameters too") != std::string::npos);
  CHECK(
      sample.message(replaced(text, "{dimension}d", "{dim}d")).find("name: found {dim}, expected a key of the sweep in braces") !=
      std::string::npos);
}

TEST_CASE("A known gap needs a day, a later day and a cause", "[case_file]") {
  Sample sample;
  const auto with_gap = [&](const char* gap) { return sample.message(text + gap); };
  CHECK(with_gap("known_gap = { reason = \"r\", date = 2026-11-22, expires = 2027-05-22 }\n") == "no error");
  CHECK(with_gap("known_gap = { reason = \"r\", date = 2026-11-22, expires = 2026-11-22 }\n").find("expected a later one") !=
        std::string::npos);
  CHECK(with_gap("known_gap = { reason = \"\", date = 2026-11-22, expires = 2027-05-22 }\n").find("expected the cause") !=
        std::string::npos);
  CHECK(with_gap("known_gap = { reason = \"r\", date = \"2026-11-22\", expires = 2027-05-22 }\n")
            .find("expected a date without quotes") != std::string::npos);
}

namespace {

std::string metric_block(const std::string& header, const std::string& name, const std::string& rest) {
  return header + "\nname = \"" + name + "\"\nsymbol = \"x\"\nunit = \"1\"\nclass = \"exact\"\nreference = { source = \"book\" }\n"
         "norm = \"value\"\n" + rest + "\n";
}
const std::string gated = "band = [0.0, 1.0]\nband_why = \"b\"", reported = "reported = true";

std::string sharing_case(const std::string& name, const std::string& sets) {
  return "[[case]]\nname = \"" + name + "\"\nproblem = \"slab\"\ntitle = \"t\"\nwhy = \"w\"\ndescription = \"d\"\ntier = \"quick\"\n"
         "metric_sets = " + sets + "\nparameters = { kernel = \"cubic_spline\", dimension = 2 }\n";
}

}  // namespace

TEST_CASE("Cases share sets of metrics; a later set's and the case's own replace an earlier one's of the same name", "[case_file]") {
  Sample sample;
  const std::string sets = metric_block("[[metric-set.all]]", "one", gated) + metric_block("[[metric-set.all]]", "two", gated) +
                           metric_block("[[metric-set.mild]]", "two", reported);
  const std::string file = "family = \"slab\"\n" + sets + sharing_case("a", R"(["all"])") + sharing_case("b", R"(["all", "mild"])") +
                           sharing_case("c", R"(["all"])") + metric_block("[[case.metric]]", "one", reported) +
                           metric_block("[[case.metric]]", "three", gated);
  const std::vector<CaseSpec> cases = sample.read(file);
  REQUIRE(cases.size() == 3);
  const auto words = [](const CaseSpec& spec) {
    std::string text;
    for (const MetricSpec& metric : spec.metrics) text += metric.name + (metric.band ? " gated, " : " reported, ");
    return text;
  };
  CHECK(words(cases[0]) == "one gated, two gated, ");
  CHECK(words(cases[1]) == "one gated, two reported, ");
  CHECK(words(cases[2]) == "one reported, two gated, three gated, ");
  // A set is an input of the cases that name it.
  const std::string wider = replaced(file, "[0.0, 1.0]", "[0.0, 2.0]");
  CHECK(sample.read(wider)[0].fingerprint != cases[0].fingerprint);
}

TEST_CASE("Sets of metrics that are not there, that no case names or that name a metric twice are refused", "[case_file]") {
  Sample sample;
  const std::string set = metric_block("[[metric-set.all]]", "one", gated), head = "family = \"slab\"\n" + set;
  CHECK(sample.message(head + sharing_case("a", R"(["al"])")).find("no case names") != std::string::npos);
  CHECK(sample.message(head + sharing_case("a", R"(["all", "rest"])")).find("found \"rest\", expected a [[metric-set.NAME]]") !=
        std::string::npos);
  CHECK(sample.message(head + set + sharing_case("a", R"(["all"])")).find("found \"one\" twice in this set") != std::string::npos);
  CHECK(sample.message(head + sharing_case("a", R"(["all"])") + metric_block("[[case.metric]]", "one", reported))
            .find("found a metric that no case takes from this set") != std::string::npos);
  CHECK(sample.message(replaced(head, "norm", "nrom") + sharing_case("a", R"(["all"])")).find("norm") != std::string::npos);
  CHECK(sample.message(replaced(head, "symbol", "extra = 1\nsymbol") + sharing_case("a", R"(["all"])")).find("extra") !=
        std::string::npos);
}
