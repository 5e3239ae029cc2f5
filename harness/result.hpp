// Results: what one case leaves behind, as result.json (harness/schema/result-1.json).
#pragma once

#include <deque>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "harness/case.hpp"
#include "harness/case_file.hpp"
#include "harness/gate.hpp"
#include "harness/provenance.hpp"

namespace furrow {

struct Cost {
  double wall = 0.0, cpu = 0.0;          ///< s
  long steps = 0, particles = 0, particle_steps = 0;
  long peak_rss = 0;                     ///< bytes
};

/// What a case shows beside its metrics. Paths of files are relative to the case's folder.
struct Shown {
  std::deque<Table> tables;
  std::deque<Figure> figures;
  std::vector<std::string> notes;
  std::set<std::string> modules;
  std::string history;
  std::vector<std::string> snapshots;
};

/// The result of a case; numbers that are not finite become null.
Json result_json(const CaseSpec& spec, const CaseVerdict& verdict, const Shown& shown, const Cost& cost, const Json& provenance);

/// Writes text beside the final name and renames it: a killed run leaves the old file or the new one. Throws std::runtime_error.
void write_whole(const std::filesystem::path& file, const std::string& text);
void write_json(const std::filesystem::path& file, const Json& json);

/// Parses a JSON file; null when it is missing or no JSON.
Json read_json(const std::filesystem::path& file);

/// JUnit of a run: a test suite for each case, a test case for each metric. Reported metrics appear as skipped.
std::string junit_xml(const std::vector<Json>& results);

}  // namespace furrow
