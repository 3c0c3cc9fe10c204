#include "process_guard.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace muster {
namespace {

std::string c_locale() { return std::setlocale(LC_ALL, nullptr); }

std::filesystem::path folder() {
  std::error_code gone;  // the folder may have been deleted: then the check is skipped
  return std::filesystem::current_path(gone);
}

sigset_t signals() {
  sigset_t result;
  ::sigemptyset(&result);
  ::pthread_sigmask(SIG_SETMASK, nullptr, &result);
  return result;
}

bool same(const sigset_t& a, const sigset_t& b) {
  for (int s = 1; s < NSIG; ++s)
    if (::sigismember(&a, s) != ::sigismember(&b, s)) return false;
  return true;
}

constexpr std::array watched = {SIGINT, SIGTERM, SIGSEGV, SIGABRT, SIGFPE, SIGPIPE};
using Handlers = std::array<struct sigaction, watched.size()>;

Handlers handlers() {
  Handlers result{};
  for (std::size_t i = 0; i < watched.size(); ++i) ::sigaction(watched[i], nullptr, &result[i]);
  return result;
}

bool same(const struct sigaction& a, const struct sigaction& b) {
  if ((a.sa_flags & SA_SIGINFO) != (b.sa_flags & SA_SIGINFO)) return false;
  return (a.sa_flags & SA_SIGINFO) ? a.sa_sigaction == b.sa_sigaction : a.sa_handler == b.sa_handler;
}

std::pair<dev_t, ino_t> identity(int descriptor) {
  struct stat now {};
  return ::fstat(descriptor, &now) == 0 ? std::pair{now.st_dev, now.st_ino} : std::pair{dev_t{}, ino_t{}};
}

// Read where it is told: umask() would have to change it, for a moment in which other threads may make a file.
// None where it cannot be read.
std::optional<mode_t> file_mask() {
  char text[512] = {};
  const int told = ::open("/proc/self/status", O_RDONLY | O_CLOEXEC);
  if (told < 0) return {};
  const auto size = ::read(told, text, sizeof text - 1);
  ::close(told);
  const char* const at = size > 0 ? std::strstr(text, "\nUmask:") : nullptr;
  if (!at) return {};
  const char* first = at + std::strlen("\nUmask:");
  first += std::strspn(first, " \t");
  mode_t mask = 0;
  if (std::from_chars(first, text + size, mask, 8).ec != std::errc{}) return {};
  return mask;
}

bool differ(std::optional<mode_t> a, std::optional<mode_t> b) { return a && b && *a != *b; }

using Limits = std::array<struct rlimit, RLIM_NLIMITS>;

constexpr std::array<const char*, 16> limit_names{"CPU",      "FSIZE",  "DATA",    "STACK", "CORE",  "RSS",
                                                  "NPROC",    "NOFILE", "MEMLOCK", "AS",    "LOCKS", "SIGPENDING",
                                                  "MSGQUEUE", "NICE",   "RTPRIO",  "RTTIME"};
static_assert(limit_names.size() == RLIM_NLIMITS);

Limits limits() {
  Limits result{};
  for (std::size_t i = 0; i < result.size(); ++i) ::getrlimit(static_cast<__rlimit_resource>(i), &result[i]);
  return result;
}

bool same(const struct rlimit& a, const struct rlimit& b) {
  return a.rlim_cur == b.rlim_cur && a.rlim_max == b.rlim_max;
}

std::string octal(mode_t mask) {
  char text[16];
  std::snprintf(text, sizeof text, "%04o", mask);
  return text;
}

}  // namespace

ProcessGuard::ProcessGuard()
    : c_locale_(c_locale()),
      folder_(folder()),
      signals_(signals()),
      handlers_(handlers()),
      standard_{identity(STDOUT_FILENO), identity(STDERR_FILENO)},
      umask_(file_mask()),
      limits_(limits()) {}

std::string ProcessGuard::what() const {
  std::string result = float_.what();
  const auto add = [&result](const std::string& words) { result += (result.empty() ? "" : ", ") + words; };
  if (c_locale() != c_locale_)
    add("changes the locale to " + c_locale());
  else if (std::locale() != locale_)
    add("changes the global std::locale");
  if (folder() != folder_) add("changes the working directory to " + folder().string());
  if (!same(signals(), signals_)) add("changes the signal mask");
  const Handlers now = handlers();
  for (std::size_t i = 0; i < watched.size(); ++i)
    if (!same(now[i], handlers_[i])) add(std::string("takes the handler of SIG") + ::sigabbrev_np(watched[i]));
  if (identity(STDOUT_FILENO) != standard_[0]) add("closes or exchanges the standard output");
  if (identity(STDERR_FILENO) != standard_[1]) add("closes or exchanges the standard error");
  if (const auto mask = file_mask(); differ(mask, umask_)) add("changes the umask to " + octal(*mask));
  const Limits limited = limits();
  for (std::size_t i = 0; i < limited.size(); ++i)
    if (!same(limited[i], limits_[i])) add(std::string("changes the limit RLIMIT_") + limit_names[i]);
  return result;
}

void ProcessGuard::restore() const noexcept {
  if (float_.changed()) float_.restore();
  if (std::locale() != locale_) std::locale::global(locale_);
  if (c_locale() != c_locale_) std::setlocale(LC_ALL, c_locale_.c_str());
  std::error_code gone;
  if (!folder_.empty() && folder() != folder_) std::filesystem::current_path(folder_, gone);
  ::pthread_sigmask(SIG_SETMASK, &signals_, nullptr);
  const Handlers now = handlers();
  for (std::size_t i = 0; i < watched.size(); ++i)
    if (!same(now[i], handlers_[i])) ::sigaction(watched[i], &handlers_[i], nullptr);
  if (differ(file_mask(), umask_)) ::umask(*umask_);
  const Limits limited = limits();
  for (std::size_t i = 0; i < limited.size(); ++i)
    if (!same(limited[i], limits_[i])) ::setrlimit(static_cast<__rlimit_resource>(i), &limits_[i]);
}

}  // namespace muster
