#include "process_guard.hpp"

#include <clocale>
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

}  // namespace

ProcessGuard::ProcessGuard() : c_locale_(c_locale()), folder_(folder()), signals_(signals()) {}

std::string ProcessGuard::what() const {
  std::string result = float_.what();
  const auto add = [&result](const std::string& words) { result += (result.empty() ? "" : ", ") + words; };
  if (c_locale() != c_locale_)
    add("changes the locale to " + c_locale());
  else if (std::locale() != locale_)
    add("changes the global std::locale");
  if (folder() != folder_) add("changes the working directory to " + folder().string());
  if (!same(signals(), signals_)) add("changes the signal mask");
  return result;
}

void ProcessGuard::restore() const noexcept {
  if (float_.changed()) float_.restore();
  if (std::locale() != locale_) std::locale::global(locale_);
  if (c_locale() != c_locale_) std::setlocale(LC_ALL, c_locale_.c_str());
  std::error_code gone;
  if (!folder_.empty() && folder() != folder_) std::filesystem::current_path(folder_, gone);
  ::pthread_sigmask(SIG_SETMASK, &signals_, nullptr);
}

}  // namespace muster
