#include "sweep_workers.hpp"

#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <thread>
#include <vector>

#include "text/text_file.hpp"
#include "verbs.hpp"

namespace muster::cli {
namespace {

constexpr auto pause = std::chrono::milliseconds(20);  // between looks at the children

[[noreturn]] void be_child(pid_t parent, const std::function<Exit()>& work) {
  // Of a parent that is killed, nothing goes on; it may be gone already.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(static_cast<int>(Exit::interrupted));
  ::setpgid(0, 0);  // Ctrl-C is the parent's, who passes it on once: a second one would end this at once
  Exit code = Exit::internal;
  try {
    code = work();
  } catch (const Error& e) {
    code = e.exit();
    fmt::print(stderr, "muster: error: {}\n", e.what());
  } catch (const std::exception& e) {
    fmt::print(stderr, "muster: error: {}\n", e.what());
  }
  std::fflush(nullptr);
  ::_exit(static_cast<int>(code));
}

Exit code_of(int status) {
  if (WIFEXITED(status)) return static_cast<Exit>(WEXITSTATUS(status));
  if (WIFSIGNALED(status))
    fmt::print(stderr, "muster: warning: a worker was ended by signal {} ({})\n", WTERMSIG(status),
               ::strsignal(WTERMSIG(status)));
  return Exit::done;
}

}  // namespace

Exit in_processes(int count, const std::function<Exit()>& work, const std::function<void()>& meanwhile) {
  std::fflush(nullptr);  // what is in a buffer is to be printed once
  const pid_t parent = ::getpid();
  std::vector<pid_t> children;
  for (int i = 0; i < count; ++i) {
    const pid_t child = ::fork();
    if (child == 0) be_child(parent, work);
    if (child < 0 && children.empty()) throw Error(Exit::io, "a worker cannot be started: " + system_message(errno));
    if (child > 0) children.push_back(child);
  }
  Exit result = Exit::done;
  bool passed_on = false;
  while (!children.empty()) {
    for (std::size_t i = children.size(); i-- > 0;) {
      int status = 0;
      const pid_t ended = ::waitpid(children[i], &status, WNOHANG);
      if (ended < 0 && errno != EINTR)
        throw Error(Exit::internal, "how a worker has ended is not known: " + system_message(errno));
      if (ended != children[i]) continue;
      children.erase(children.begin() + static_cast<std::ptrdiff_t>(i));
      const Exit code = code_of(status);
      if (result == Exit::done) result = code;
    }
    if (interrupted() && !passed_on) {
      for (const pid_t child : children) ::kill(child, SIGINT);
      passed_on = true;
    }
    if (meanwhile) meanwhile();
    std::this_thread::sleep_for(pause);
  }
  return result;
}

Exit work_on_table(const std::filesystem::path& folder, const sweep::Share& share, int count, const std::string& what,
                   const std::string& unit, const std::function<Exit()>& work) {
  Progress progress(what);
  std::unique_ptr<sweep::JobTable> watched;  // a connection made after the forks
  auto looked = std::chrono::steady_clock::now();
  return in_processes(count, work, [&] {
    const auto now = std::chrono::steady_clock::now();
    if (now - looked < std::chrono::seconds(1)) return;
    looked = now;
    if (!watched) watched = std::make_unique<sweep::JobTable>(folder);
    const auto counts = watched->counts(share);
    progress.at(fmt::format("{} of {} {}", counts.done, counts.all, unit));
  });
}

}  // namespace muster::cli
