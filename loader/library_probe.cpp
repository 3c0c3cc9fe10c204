#include "library_probe.hpp"

#include <cxxabi.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/core/demangle.hpp>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string_view>
#include <system_error>
#include <typeinfo>

#include "elf.hpp"

namespace muster {
namespace {

// Reports of the child: a packet is one of these and a text. All but the first end a trial.
enum Report : char { progress = 'p', refused = 'r', threw = 't', left = 'x', done = 'd' };

constexpr std::size_t longest = 4096;  // [bytes] of a packet: longer messages are cut

// In the child only: handlers of std::terminate and exit() take no arguments.
int report_to = -1;

void report(Report kind, std::string_view text) noexcept {
  std::array<char, longest> packet;
  packet[0] = kind;
  const std::size_t size = text.copy(packet.data() + 1, packet.size() - 1);
  if (::send(report_to, packet.data(), size + 1, MSG_NOSIGNAL) < 0) ::_exit(1);  // the parent has ended
}

[[noreturn]] void leave(Report kind, std::string_view text) noexcept {
  report(kind, text);
  ::_exit(0);  // neither destructors nor buffered output of the parent
}

// "std::runtime_error: no licence", of the exception that is being handled.
std::string exception_text() {
  try {
    throw;
  } catch (const std::exception& e) {
    return fmt::format("{}: {}", boost::core::demangle(typeid(e).name()), e.what());
  } catch (...) {
    const std::type_info* type = __cxxabiv1::__cxa_current_exception_type();
    return type ? boost::core::demangle(type->name()) : "an exception";
  }
}

[[noreturn]] void on_terminate() {
  if (!std::current_exception()) leave(threw, "");
  leave(threw, exception_text());
}

// Hides the child's effects: its output, its crash, and its handlers of the parent's signals.
void seclude() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGPIPE, SIGALRM}) std::signal(signal, SIG_DFL);
  for (const int signal : {SIGINT, SIGTERM})
    std::signal(signal, SIG_IGN);  // meant for the parent, which ends the child
  const int null = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(null, standard);
  std::set_terminate(on_terminate);
  std::atexit([] { leave(left, ""); });
}

void run(const Probe::Body& body, const std::string& what) noexcept {
  try {
    body(what, [](const char* text) { report(progress, text); });
  } catch (const Refusal& refusal) {
    leave(refused, refusal.what());
  } catch (...) {
    leave(threw, exception_text());
  }
  report(done, "");
}

[[noreturn]] void run_child(int line, const Probe::Body& body) noexcept {
  report_to = line;
  seclude();
  std::array<char, longest> packet;
  for (ssize_t size; (size = ::recv(line, packet.data(), packet.size(), 0)) > 0;)
    run(body, std::string(packet.data(), static_cast<std::size_t>(size)));
  ::_exit(0);
}

using Clock = std::chrono::steady_clock;  // wall-clock time, not the simulated one: the child may hang

enum class Heard { packet, end, silence };

// The child's next packet, or its end, or silence until the deadline.
Heard listen(int line, Clock::time_point deadline, std::string& said) {
  for (;;) {
    const auto rest = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd wait{line, POLLIN, 0};
    const int ready = ::poll(&wait, 1, std::max(static_cast<int>(rest.count()), 0));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return Heard::silence;
    said.resize(longest);
    const ssize_t size = ::recv(line, said.data(), said.size(), 0);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return Heard::end;
    said.resize(static_cast<std::size_t>(size));
    return Heard::packet;
  }
}

std::string words_of(Report last, const std::string& text, const std::string& during) {
  if (last == refused) return text;
  if (last == left) return "calls exit() while " + during;
  if (last == threw && text.empty()) return "calls std::terminate() while " + during;
  if (last == threw) return fmt::format("throws while {}: {}", during, text);
  return "";
}

std::string how_it_ended(int status, const std::string& during) {
  if (!WIFSIGNALED(status)) return "ends the process while " + during + "; it is corrupted or faulty";
  const char* name = ::sigabbrev_np(WTERMSIG(status));
  return fmt::format("crashes while {} (SIG{}); it is corrupted or faulty", during, name ? name : "?");
}

}  // namespace

void Probe::start() {
  stop();
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category(), "socketpair");
  child_ = ::fork();
  if (child_ == 0) {
    ::close(ends[0]);
    run_child(ends[1], body_);
  }
  const int error = errno;
  ::close(ends[1]);
  line_ = ends[0];
  if (child_ > 0) return;
  child_ = 0;
  throw std::system_error(error, std::generic_category(), "fork");
}

// Ends the child if it is still alive; returns how it ended.
int Probe::stop() {
  int status = 0;
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
  }
  if (line_ >= 0) ::close(line_);
  child_ = 0;
  line_ = -1;
  return status;
}

std::string Probe::ask(const std::string& what) {
  std::string during = "it begins", said;
  ::send(line_, what.data(), what.size(), MSG_NOSIGNAL);  // if the child is gone, listen() finds that out
  const Clock::time_point deadline = Clock::now() + limit_;
  for (;;) {
    const Heard heard = listen(line_, deadline, said);
    if (heard == Heard::end) return how_it_ended(stop(), during);
    if (heard == Heard::silence) {
      stop();
      return fmt::format("hangs while {}: it took over {} s", during, static_cast<double>(limit_.count()) / 1000);
    }
    const Report kind = static_cast<Report>(said[0]);
    const std::string text = said.substr(1);
    if (kind != progress) return words_of(kind, text, during);
    during = text;
  }
}

std::string Probe::try_out(const std::string& what) {
  const bool fresh = child_ == 0;
  if (fresh) start();
  std::string words = ask(what);
  if (!words.empty() && !fresh) {
    start();
    words = ask(what);
  }
  if (!words.empty()) stop();
  return words;
}

}  // namespace muster
