// Child processes of the runner: each case in one of its own, in a process group of its own.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <sys/types.h>

namespace furrow {

/// True once SIGINT or SIGTERM has arrived; the first call of catch_interrupts() installs the handlers.
void catch_interrupts();
bool interrupted();

/// A running child. Its standard output and error go to a log file, its file descriptor 3 is the pipe to us.
class Child {
 public:
  /// Starts `arguments` (the first is the program's path). Throws std::runtime_error.
  Child(const std::vector<std::string>& arguments, const std::map<std::string, std::string>& environment,
        const std::filesystem::path& log);
  ~Child();   ///< kills what still runs
  Child(Child&& other) noexcept;
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  Child& operator=(Child&&) = delete;

  int pipe() const { return pipe_; }
  /// The last whole line that has come through the pipe since the last call; empty when there is none.
  std::string last_line();
  void kill();
  /// True when it has ended; then `how` says how: empty for exit code 0, else "killed by signal 9 (Killed)", "exit code 1".
  bool ended();
  const std::string& how() const { return how_; }
  double seconds() const;
  double cpu_seconds() const { return cpu_seconds_; }
  long peak_rss() const { return peak_rss_; }   ///< bytes

 private:
  pid_t pid_ = -1;
  int pipe_ = -1;
  std::string pending_, how_;
  std::chrono::steady_clock::time_point start_;
  double cpu_seconds_ = 0.0;
  long peak_rss_ = 0;
};

/// Waits until one of the children says something or ends, at most `seconds`.
void wait_for_any(const std::vector<const Child*>& children, double seconds);

}  // namespace furrow
