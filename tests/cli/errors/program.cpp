#include "program.hpp"

#include <fcntl.h>
#include <linux/capability.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/sanitized.hpp"

namespace muster::test {
namespace {

constexpr double most_seconds = sanitized ? 600 : 60;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Ends {
  int reader = -1, writer = -1;
};

Ends make_ends(bool terminal) {
  Ends ends;
  int both[2];
  if (terminal ? ::openpty(&ends.reader, &ends.writer, nullptr, nullptr, nullptr) != 0 : ::pipe(both) != 0)
    throw std::runtime_error("no pipe");
  if (!terminal) ends = {both[0], both[1]};
  ::fcntl(ends.reader, F_SETFD, FD_CLOEXEC);
  return ends;
}

// In the child, between fork and exec.
[[noreturn]] void become(const std::vector<std::string>& words, const Surroundings& around, int out, int err) {
  for (const auto& variable : around.environment) {
    const auto equals = variable.find('=');
    if (equals == std::string::npos)
      ::unsetenv(variable.c_str());
    else
      ::setenv(variable.substr(0, equals).c_str(), variable.substr(equals + 1).c_str(), 1);
  }
  if (!around.folder.empty() && ::chdir(around.folder.c_str()) != 0) ::_exit(126);
  const int in = ::open("/dev/null", O_RDONLY);
  if (!around.standard_output.empty()) out = ::open(around.standard_output.c_str(), O_WRONLY | O_CREAT, 0666);
  ::dup2(in, STDIN_FILENO), ::dup2(out, STDOUT_FILENO), ::dup2(err, STDERR_FILENO);
  ::close_range(3, ~0u, 0);
  if (around.bound_by_permissions && ::geteuid() == 0 && ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE) != 0) ::_exit(126);
  std::vector<char*> argv;
  for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  ::execvp(argv[0], argv.data());
  ::_exit(127);
}

// Reads both streams until the program has closed them.
void listen(int process, int out, int err, const Surroundings& around, Outcome& result) {
  const auto start = Clock::now();
  pollfd streams[] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
  std::string* texts[] = {&result.out, &result.err};
  bool told = !around.meanwhile;
  while (streams[0].fd >= 0 || streams[1].fd >= 0) {
    if (seconds_since(start) > most_seconds) {
      ::kill(process, SIGKILL);
      ADD_FAILURE() << "still runs after " << most_seconds << " s";
      return;
    }
    if (::poll(streams, 2, 1000) <= 0) continue;
    for (int i = 0; i < 2; ++i) {
      if (!streams[i].revents) continue;
      char bytes[4096];
      const auto got = ::read(streams[i].fd, bytes, sizeof bytes);
      if (got > 0)
        texts[i]->append(bytes, static_cast<std::size_t>(got));
      else
        streams[i].fd = -1;  // of a terminal, the end is an error
    }
    if (!told && !(result.out.empty() && result.err.empty())) told = true, around.meanwhile(process);
  }
}

}  // namespace

Outcome run_muster(const std::vector<std::string>& words, const Surroundings& around) {
  std::vector<std::string> all = around.wrapper;
  all.push_back(MUSTER_PROGRAM);
  all.insert(all.end(), words.begin(), words.end());
  const Ends out = make_ends(false), err = make_ends(around.terminal);
  Outcome result;
  const auto start = Clock::now();
  const pid_t process = ::fork();
  if (process == 0) become(all, around, out.writer, err.writer);
  ::close(out.writer), ::close(err.writer);
  listen(process, out.reader, err.reader, around, result);
  int status = 0;
  struct rusage usage {};
  ::wait4(process, &status, 0, &usage);
  ::close(out.reader), ::close(err.reader);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  result.wall_seconds = seconds_since(start);
  result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.peak_kilobytes = usage.ru_maxrss;
  result.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

Outcome ProgramFolder::muster(const std::vector<std::string>& words, Surroundings around) const {
  if (around.folder.empty()) around.folder = path();
  return run_muster(words, around);
}

void ProgramFolder::expect_refused(const std::string& world, const std::string& message, int exit) const {
  write("world.xml", world);
  expect_error(muster({"check", "world.xml", "--plugins", MUSTER_TOYS}), exit, message);
}

std::string world_of(const std::string& elements) {
  return R"(<world name="w" dt="0.1" until="1">)" + elements + "</world>";
}

void expect_error(const Outcome& outcome, int exit, const std::string& message) {
  EXPECT_EQ(outcome.exit, exit);
  EXPECT_EQ(outcome.err, "muster: error: " + message + "\n");
}

}  // namespace muster::test
