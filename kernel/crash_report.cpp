#include "crash_report.hpp"

#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <utility>

#include "callback_watch.hpp"

namespace muster {
namespace {

thread_local const RunningCallback* running = nullptr;
bool reports = false;

constexpr int plugin_fault = 3;  // the exit code
constexpr std::initializer_list<int> crashes = {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT};
constexpr std::size_t stack_bytes = 1 << 16;  // of a handler's own: the fault may be an overflow of the thread's

void run_handlers_on(char* stack) {
  stack_t alternate{};
  alternate.ss_sp = stack;
  alternate.ss_size = stack_bytes;
  if (!stack) alternate.ss_flags = SS_DISABLE;
  ::sigaltstack(&alternate, nullptr);
}

// A thread's stack for handlers, for the thread's life, unless it has one, such as a sanitizer's.
class HandlerStack {
 public:
  HandlerStack() {
    stack_t before{};
    if (!reports || ::sigaltstack(nullptr, &before) != 0 || !(before.ss_flags & SS_DISABLE)) return;
    memory_ = std::make_unique<char[]>(stack_bytes);
    run_handlers_on(memory_.get());
  }
  ~HandlerStack() {
    if (memory_) run_handlers_on(nullptr);
  }
  HandlerStack(const HandlerStack&) = delete;
  HandlerStack& operator=(const HandlerStack&) = delete;

 private:
  std::unique_ptr<char[]> memory_;
};

// Only what is async-signal-safe (POSIX 2.4.3) may be called here: the line is put together without allocation.
class Line {
 public:
  Line& operator<<(const char* text) {
    for (; *text && size_ < sizeof text_; ++text) text_[size_++] = *text;
    return *this;
  }
  Line& operator<<(int64_t number) {
    char digits[24];
    std::size_t at = sizeof digits;
    digits[--at] = '\0';
    do digits[--at] = static_cast<char>('0' + number % 10);
    while (number /= 10);
    return *this << digits + at;
  }
  void write() const {
    for (std::size_t from = 0; from < size_;) {
      const auto written = ::write(STDERR_FILENO, text_ + from, size_ - from);
      if (written <= 0) return;
      from += static_cast<std::size_t>(written);
    }
  }

 private:
  char text_[2048];
  std::size_t size_ = 0;
};

}  // namespace

const char* words_of_signal(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "a segmentation fault (SIGSEGV)";
    case SIGBUS:
      return "a bus error (SIGBUS)";
    case SIGILL:
      return "an illegal instruction (SIGILL)";
    case SIGFPE:
      return "an arithmetic fault (SIGFPE)";
    case SIGABRT:
      return "an abort (SIGABRT)";
    case SIGKILL:
      return "a kill from outside (SIGKILL)";
    case SIGTERM:
      return "a request to end (SIGTERM)";
    default:
      return "a signal";
  }
}

RunningCallback::RunningCallback(const char* title, const char* callback, int64_t tick, double time, bool may_wait)
    : title_(title), callback_(callback), tick_(tick), time_(time), may_wait_(may_wait), outer_(running) {
  static thread_local const HandlerStack own;
  running = this;
  note();
}

RunningCallback::~RunningCallback() {
  running = outer_;
  if (outer_)
    outer_->note();
  else
    note_callback({});
}

void RunningCallback::note() const { note_callback({may_wait_ ? nullptr : title_, callback_, tick_, time_}); }

void write_crash(int signal) {
  const RunningCallback* in = running;
  Line line;
  if (in) {
    line << "muster: error: " << in->title_ << ": " << in->callback_ << " crashed";
    if (in->tick_ >= 0) line << " at tick " << in->tick_;
    line << ": " << words_of_signal(signal)
         << " in the plugin; a debugger shows where, and the line of a plugin built with "
            "-D CMAKE_BUILD_TYPE=Debug: gdb -ex run --args muster ...\n";
  } else {
    line << "muster: error: crashed outside of every callback: " << words_of_signal(signal)
         << ", in a thread that a plugin has started, in what a library does when it is unloaded, or in muster itself; "
            "muster run --isolate all names a plugin whose thread it is, and a debugger shows where: "
            "gdb -ex run --args muster ...\n";
  }
  line.write();
}

bool write_exit() {
  const RunningCallback* in = running;
  if (!in || !reports) return false;
  Line line;
  line << "muster: error: " << in->title_ << ": " << in->callback_ << " failed";
  if (in->tick_ >= 0) line << " at tick " << in->tick_;
  line << ": the plugin ends the whole process by exit(); expected it to throw, or to report and return\n";
  line.write();
  return true;
}

namespace {

[[noreturn]] void end_at_once(int code) {
  for (;;) ::syscall(SYS_exit_group, code);
}

void tell_exit() {
  if (write_exit()) end_at_once(plugin_fault);
}

[[noreturn]] void end_told(int code) { end_at_once(write_exit() ? plugin_fault : code); }

}  // namespace

void report_crashes() {
  static char stack[stack_bytes];
  run_handlers_on(stack);
  if (!std::exchange(reports, true)) {
    std::atexit(tell_exit);
    std::at_quick_exit(tell_exit);
    ::pthread_atfork(nullptr, nullptr, [] { running = nullptr; });  // a plugin's child may end as it likes
  }
  for (const int signal : crashes) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if ((before.sa_flags & SA_SIGINFO) || before.sa_handler != SIG_DFL) continue;
    struct sigaction action {};
    action.sa_handler = [](int caught) {
      write_crash(caught);
      ::raise(caught);  // by default again: the process ends with its signal, when the handler returns
    };
    action.sa_flags = static_cast<int>(SA_ONSTACK | SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
}

void leave_crashes_to_parent() {
  reports = false;
  for (const int signal : crashes) std::signal(signal, SIG_DFL);
}

}  // namespace muster

// In the place of libc's for plugins, since the program's own functions come first: no handler of exit() runs for
// these.
extern "C" {
[[gnu::visibility("default")]] void _exit(int code) { muster::end_told(code); }
[[gnu::visibility("default")]] void _Exit(int code) noexcept { muster::end_told(code); }
}
