#include "harness/python_command.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <unistd.h>

#include <fmt/format.h>

#include "harness/provenance.hpp"

namespace furrow {

int become_python(const PythonCommand& command, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"/usr/bin/python3", "-P", "-m", command.module, command.name};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  setenv("PYTHONPATH", project_root().c_str(), 1);
  setenv("PYTHONDONTWRITEBYTECODE", "1", 1);
  setenv("FURROW_PROGRAM", std::filesystem::read_symlink("/proc/self/exe").c_str(), 1);
  execv(argv.front(), argv.data());
  throw std::runtime_error(fmt::format("{} cannot be started: {}", words.front(), std::strerror(errno)));
}

}  // namespace furrow
