// Provenance: what a result was made from, so that it can be made again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace furrow {

using Json = nlohmann::ordered_json;

/// The folder of the project that this program was built from.
std::filesystem::path project_root();

/// Commit, dirty tree, compiler, flags, CPU, threads, order of particles (RunOptions), package versions, start time, and the hash of
/// the running program itself.
Json provenance(int threads, std::uint64_t particle_order);

/// Short commit for names: "1a2b3c4d", "uncommitted" outside a repository.
std::string short_commit(const Json& provenance);

/// "20261122-141709" (local time) for names, "2026-11-22T14:17:09Z" for records.
std::string time_for_names();
std::string time_for_records();

}  // namespace furrow
