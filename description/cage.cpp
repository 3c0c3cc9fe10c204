#include "description/cage.hpp"

#include <seccomp.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <initializer_list>

namespace muster::description {
namespace {

void limit(int resource, rlim_t value) {
  const rlimit both{value, value};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

// Every other call fails with EPERM. On systems without such filters, the resource limits remain.
[[maybe_unused]] void allow_memory_and_exit() {
  scmp_filter_ctx filter = ::seccomp_init(SCMP_ACT_ERRNO(EPERM));
  if (!filter) return;
  for (const int call :
       {SCMP_SYS(brk), SCMP_SYS(mmap), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(mprotect), SCMP_SYS(madvise),
        SCMP_SYS(futex), SCMP_SYS(getrandom), SCMP_SYS(clock_gettime), SCMP_SYS(sched_yield), SCMP_SYS(rt_sigreturn),
        SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(tgkill),
        SCMP_SYS(exit), SCMP_SYS(exit_group)})
    ::seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
  ::seccomp_load(filter);
  ::seccomp_release(filter);
}

}  // namespace

void enter_cage(const CageLimits& limits) {
  limit(RLIMIT_CPU, limits.cpu);
  limit(RLIMIT_FSIZE, 0);
  limit(RLIMIT_CORE, 0);
  for (const int number : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU, SIGALRM, SIGINT, SIGTERM})
    std::signal(number, SIG_DFL);
  ::alarm(static_cast<unsigned>(2 * limits.cpu));                    // for a child that sleeps instead of computing
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these reserve terabytes, and open pipes
  limit(RLIMIT_AS, limits.memory);
  limit(RLIMIT_NOFILE, 0);  // open files stay open; no more can be opened
  allow_memory_and_exit();
#endif
}

}  // namespace muster::description
