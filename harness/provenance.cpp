#include "harness/provenance.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <sstream>
#include <thread>

#include <fmt/format.h>

namespace furrow {
namespace {

// Standard output of a shell command; empty when it cannot be run.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>/dev/null").c_str(), "r"), pclose);
  std::string text;
  std::array<char, 4096> buffer{};
  while (pipe && fgets(buffer.data(), static_cast<int>(buffer.size()), pipe.get())) text += buffer.data();
  return text;
}

std::string trimmed(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  return text.substr(std::min(text.find_first_not_of(" \t"), text.size()));
}

std::string quoted(const std::filesystem::path& path) {
  std::string result = "'";
  for (const char c : path.string()) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string cpu() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name")) return trimmed(line.substr(line.find(':') + 1));
  return "unknown";
}

Json packages() {
  std::ifstream in(project_root() / "packages.txt");
  std::string names;
  for (std::string line; std::getline(in, line);) {
    const std::string name = trimmed(line.substr(0, line.find('#')));
    if (!name.empty()) names += " " + name;
  }
  Json result = Json::object();
  std::istringstream versions(output_of("dpkg-query -W -f='${Package} ${Version}\\n'" + names));
  for (std::string name, version; versions >> name >> version;) result[name] = version;
  return result;
}

std::string program_hash() {
  std::ifstream in("/proc/self/exe", std::ios::binary);
  std::uint64_t hash = 14695981039346656037ULL;
  std::array<char, 1 << 16> buffer{};
  while (in.read(buffer.data(), buffer.size()) || in.gcount() > 0)
    for (std::streamsize i = 0; i < in.gcount(); ++i)
      hash = (hash ^ static_cast<unsigned char>(buffer[static_cast<std::size_t>(i)])) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

std::string formatted_time(const char* format, bool utc) {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  utc ? gmtime_r(&now, &parts) : localtime_r(&now, &parts);
  std::array<char, 64> text{};
  std::strftime(text.data(), text.size(), format, &parts);
  return text.data();
}

}  // namespace

std::filesystem::path project_root() { return FURROW_SOURCE_DIR; }

Json provenance(int threads, std::uint64_t particle_order) {
  const std::string git = "git -c safe.directory=" + quoted(project_root()) + " -C " + quoted(project_root()) + " ";
  const std::string commit = trimmed(output_of(git + "rev-parse HEAD"));
  return {
      {"commit", commit.empty() ? "unknown" : commit},
      {"dirty", commit.empty() || !trimmed(output_of(git + "status --porcelain")).empty()},
      {"compiler", FURROW_COMPILER},
      {"flags", trimmed(FURROW_FLAGS)},
      {"threads", threads},
      {"particle_order", particle_order},
      {"cpu", cpu()},
      {"cores", std::thread::hardware_concurrency()},
      {"packages", packages()},
      {"program", program_hash()},
      {"started", time_for_records()},
  };
}

std::string short_commit(const Json& provenance) {
  const std::string commit = provenance.at("commit");
  return commit == "unknown" ? "uncommitted" : commit.substr(0, 8);
}

std::string time_for_names() { return formatted_time("%Y%m%d-%H%M%S", false); }
std::string time_for_records() { return formatted_time("%Y-%m-%dT%H:%M:%SZ", true); }

}  // namespace furrow
