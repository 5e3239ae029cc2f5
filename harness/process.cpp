#include "harness/process.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

namespace furrow {
namespace {

volatile std::sig_atomic_t interrupt_flag = 0;

void on_interrupt(int) { interrupt_flag = 1; }
void on_child(int) {}   // only there so that poll() wakes up

[[noreturn]] void become(const std::vector<char*>& arguments, const std::vector<char*>& environment, int log, int pipe,
                         pid_t parent) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);   // nothing runs on when the testbed itself is killed
  if (getppid() != parent) _exit(127);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  dup2(pipe, 3);
  if (pipe == 3) fcntl(3, F_SETFD, 0);
  execve(arguments.front(), arguments.data(), environment.data());
  _exit(127);
}

std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> result;
  for (std::string& s : strings) result.push_back(s.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_with(const std::map<std::string, std::string>& changes) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text(*entry);
    if (!changes.contains(text.substr(0, text.find('=')))) result.push_back(text);
  }
  for (const auto& [name, value] : changes) result.push_back(name + "=" + value);
  return result;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_interrupt;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  action.sa_handler = on_child;
  sigaction(SIGCHLD, &action, nullptr);
}

bool interrupted() { return interrupt_flag != 0; }

Child::Child(const std::vector<std::string>& arguments, const std::map<std::string, std::string>& environment,
             const std::filesystem::path& log)
    : start_(std::chrono::steady_clock::now()) {
  const int log_file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (log_file < 0)
    throw std::runtime_error(fmt::format("{}: cannot be opened for writing: {}", log.string(), std::strerror(errno)));
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) {
    ::close(log_file);
    throw std::runtime_error(fmt::format("no pipe for a case: {}", std::strerror(errno)));
  }
  std::vector<std::string> argument_texts = arguments, environment_texts = environment_with(environment);
  const std::vector<char*> argv = pointers(argument_texts), envp = pointers(environment_texts);
  const pid_t parent = getpid();
  pid_ = ::fork();
  if (pid_ == 0) become(argv, envp, log_file, ends[1], parent);
  const int error = errno;
  ::close(log_file);
  ::close(ends[1]);
  pipe_ = ends[0];
  if (pid_ < 0) {
    ::close(pipe_);
    throw std::runtime_error(fmt::format("no process for a case: {}", std::strerror(error)));
  }
  setpgid(pid_, pid_);
}

Child::Child(Child&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      pipe_(std::exchange(other.pipe_, -1)),
      pending_(std::move(other.pending_)),
      how_(std::move(other.how_)),
      start_(other.start_),
      cpu_seconds_(other.cpu_seconds_),
      peak_rss_(other.peak_rss_) {}

Child::~Child() {
  if (pid_ > 0) {
    kill();
    int status = 0;
    while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {}
  }
  if (pipe_ >= 0) ::close(pipe_);
}

std::string Child::last_line() {
  char buffer[4096];
  for (ssize_t n = ::read(pipe_, buffer, sizeof buffer); n > 0; n = ::read(pipe_, buffer, sizeof buffer))
    pending_.append(buffer, static_cast<std::size_t>(n));
  const std::size_t end = pending_.rfind('\n');
  if (end == std::string::npos) return {};
  const std::size_t before = end == 0 ? std::string::npos : pending_.rfind('\n', end - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  std::string line = pending_.substr(begin, end - begin);
  pending_.erase(0, end + 1);
  return line;
}

void Child::kill() {
  if (pid_ > 0 && ::kill(-pid_, SIGKILL) != 0) ::kill(pid_, SIGKILL);
}

bool Child::ended() {
  if (pid_ < 0) return true;
  int status = 0;
  rusage usage{};
  if (::wait4(pid_, &status, WNOHANG, &usage) != pid_) return false;
  ::kill(-pid_, SIGKILL);   // whatever it has started itself
  pid_ = -1;
  cpu_seconds_ = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                 1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  peak_rss_ = usage.ru_maxrss * 1024;
  if (WIFSIGNALED(status)) how_ = fmt::format("killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  else if (WEXITSTATUS(status) != 0) how_ = fmt::format("exit code {}", WEXITSTATUS(status));
  return true;
}

double Child::seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

void wait_for_any(const std::vector<const Child*>& children, double seconds) {
  std::vector<pollfd> polled;
  for (const Child* child : children) polled.push_back({child->pipe(), POLLIN, 0});
  ::poll(polled.data(), polled.size(), static_cast<int>(1000.0 * seconds));
}

}  // namespace furrow
