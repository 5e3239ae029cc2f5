// Reading of metrics from a case file: blocks [[case.metric]] and the sets [[metric-set.NAME]] that cases of a file share.
// Format: harness/case_file.hpp.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/case_file.hpp"

namespace furrow {

/// `source`, when the bibliography has it.
/// @throws InputError with the nearest known key
std::string known_source(const Parameters& at, std::string_view key, const std::string& source, const Bibliography& bibliography);

/// Metrics that cases of a file share, by the name of their set.
using MetricSets = std::map<std::string, std::vector<Parameters>>;
/// @throws InputError for a set that no case names, and for a metric that is twice in a set
MetricSets read_metric_sets(const Parameters& root);

struct MetricBlock {
  Parameters at;
  bool shared;   ///< from a set
};
/// Metrics of the sets that a case names, in their order, then its own. Of one name, a later set's and the case's own stand in
/// the place of an earlier set's.
std::vector<MetricBlock> metric_blocks(const Parameters& at, const MetricSets& sets);

/// Whether the metric's [when] holds for the case's parameters.
bool applies(const Parameters& at, const Parameters& parameters);

/// One metric of a case whose resolution has been read.
MetricSpec read_metric(const Parameters& at, const Bibliography& bibliography, const CaseSpec& spec);

/// What one metric says of another: names are its own, ladders have rungs, limits and orders a ladder. `blocks` are where
/// spec.metrics were read.
void check_metrics(const std::vector<Parameters>& blocks, const CaseSpec& spec);

}  // namespace furrow
