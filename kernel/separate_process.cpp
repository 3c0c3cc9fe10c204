#include "separate_process.hpp"

#include <fmt/format.h>
#include <immintrin.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <system_error>
#include <thread>

#include "crash_report.hpp"

namespace muster {
namespace {

using Clock = std::chrono::steady_clock;  // wall-clock time, not the simulated one: the copy may hang
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr std::size_t page = 4096;  // [bytes] before the memory of the calls

// A number that only grows and for which the other process waits. It looks at it for a moment, for a sleep and its
// wake-up take longer than most steps, and then sleeps.
struct Counter {
  std::atomic<uint32_t> count{0}, sleepers{0};

  void grow() {
    count.fetch_add(1);
    if (sleepers.load()) ::syscall(SYS_futex, &count, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
  }
  // True once it is no longer `old`; false after some time.
  bool wait(uint32_t old, milliseconds most) {
    static const bool has_cores = std::thread::hardware_concurrency() > 1;
    for (const auto end = Clock::now() + microseconds(has_cores ? 50 : 0); Clock::now() < end;) {
      for (int i = 0; i < 32; ++i) {
        if (count.load(std::memory_order_acquire) != old) return true;
        _mm_pause();
      }
    }
    const timespec time{most.count() / 1000, most.count() % 1000 * 1'000'000};
    ++sleepers;
    if (count.load() == old) ::syscall(SYS_futex, &count, FUTEX_WAIT, old, &time, nullptr, 0);
    --sleepers;
    return count.load() != old;
  }
};

}  // namespace

struct SeparateProcess::Gate {
  alignas(64) Counter called;
  alignas(64) Counter answered;
};

SeparateProcess::Gate& SeparateProcess::gate() const { return *static_cast<Gate*>(mapped_); }

std::byte* SeparateProcess::memory() const { return static_cast<std::byte*>(mapped_) + page; }

SeparateProcess::SeparateProcess(std::size_t bytes, const Serve& serve) : bytes_(bytes) {
  static_assert(sizeof(Gate) <= page && std::atomic<uint32_t>::is_always_lock_free);
  const auto fails = [](const char* what) { throw std::system_error(errno, std::generic_category(), what); };
  mapped_ = ::mmap(nullptr, page + bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped_ == MAP_FAILED) fails("mmap");
  new (mapped_) Gate;
  std::fflush(nullptr);  // or the copy would write what is buffered here again, if it calls exit()
  const pid_t parent = ::getpid();
  child_ = ::fork();
  if (child_ == 0) serve_for_ever(serve, parent);
  if (child_ > 0) return;
  const int error = errno;
  ::munmap(mapped_, page + bytes);
  errno = error;
  fails("fork");
}

SeparateProcess::~SeparateProcess() {
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) continue;
  }
  ::munmap(mapped_, page + bytes_);
}

void SeparateProcess::serve_for_ever(const Serve& serve, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  leave_crashes_to_parent();
  std::signal(SIGTERM, SIG_DFL);
  for (const int signal : {SIGINT, SIGHUP}) std::signal(signal, SIG_IGN);  // meant for the parent, which ends this
  for (uint32_t served = 0;; ++served) {
    while (!gate().called.wait(served, milliseconds(60'000))) continue;
    serve(memory());
    gate().answered.grow();
  }
}

std::string SeparateProcess::how_it_ended(int status) {
  child_ = 0;
  if (WIFSIGNALED(status)) return std::string("ended with ") + words_of_signal(WTERMSIG(status));
  return fmt::format("ended with exit({})", WEXITSTATUS(status));
}

std::string SeparateProcess::call(milliseconds limit) {
  if (child_ <= 0) return "has ended";
  const uint32_t before = gate().answered.count.load();
  const auto began = Clock::now();
  gate().called.grow();
  for (milliseconds most{1}; !gate().answered.wait(before, most); most = std::min(2 * most, milliseconds(20))) {
    int status = 0;
    const pid_t ended = ::waitpid(child_, &status, WNOHANG);
    if (ended == child_) return how_it_ended(status);
    if (ended < 0 && errno == ECHILD) {  // where SIGCHLD is ignored, nobody is told how
      child_ = 0;
      return "has ended";
    }
    if (Clock::now() - began < limit) continue;
    ::kill(child_, SIGKILL);
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) continue;
    child_ = 0;
    return fmt::format("had not returned after {} s and was ended", static_cast<double>(limit.count()) / 1000);
  }
  return "";
}

}  // namespace muster
