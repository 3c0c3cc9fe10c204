#include <fmt/core.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "installation.hpp"
#include "text/names.hpp"
#include "text/near_file.hpp"
#include "verbs.hpp"

namespace muster::cli {

namespace {
// For a path that is no folder.
std::string remedy(const std::filesystem::path& path) {
  std::error_code none;
  if (std::filesystem::is_regular_file(path, none)) {
    const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
    return ", but a file; expected its folder, " + quote(folder);
  }
  if (path.string().find(';') != std::string::npos) return "; expected folders with ':' between them";
  return "; expected one" + near_file(path);
}
}  // namespace

Library::SearchPath plugin_path(const std::vector<std::string>& given) {
  Library::SearchPath result;
  const auto add = [&](const std::string& folder, const char* from) {
    if (!std::filesystem::is_directory(folder))
      throw Error(Exit::invalid_input, std::string(from) + ": " + quote(folder) + " is no folder" + remedy(folder));
    result.emplace_back(folder);
  };
  for (const auto& folder : given) add(folder, "--plugins");
  if (const char* variable = std::getenv("MUSTER_PLUGIN_PATH")) {
    std::string rest = variable;
    for (std::size_t colon; !rest.empty(); rest = colon == rest.npos ? "" : rest.substr(colon + 1)) {
      colon = rest.find(':');
      if (colon != 0) add(rest.substr(0, colon), "MUSTER_PLUGIN_PATH");
    }
  }
  result.push_back(installation().parts / "plugins");
  return result;
}

Progress::Progress(std::string what) : what_(std::move(what)) {
  const char* terminal = std::getenv("TERM");
  shown_ = isatty(STDERR_FILENO) && terminal && std::string(terminal) != "dumb";
}

Progress::~Progress() {
  if (shown_ && last_ >= 0) fmt::print(stderr, "\r\x1b[K");
}

void Progress::at(double share) {
  const int percent = static_cast<int>(share * 100);
  if (!shown_ || percent == last_) return;
  last_ = percent;
  fmt::print(stderr, "\r{} {:3}% [{:<40}]", what_, percent,
             std::string(static_cast<std::size_t>(percent) * 40 / 100, '='));
  std::fflush(stderr);
}

void Progress::at(const std::string& now) {
  using std::chrono::seconds;
  const auto time = std::chrono::steady_clock::now();
  const auto lasted = std::chrono::duration_cast<seconds>(time - begun_).count();
  if (shown_) {
    last_ = 0;
    fmt::print(stderr, "\r\x1b[K{}: {}", what_, now);
    std::fflush(stderr);
  } else if (time - spoken_ >= seconds(30)) {
    spoken_ = time;
    fmt::print(stderr, "{}: {} ({} s)\n", what_, now, lasted);
  }
}

void Progress::tell_if_endless(double share) {
  using Seconds = std::chrono::duration<double>;
  constexpr double after = 2, hour = 3600, long_rest = 6 * hour;  // s
  if (first_share_ < 0) first_share_ = share;                     // of a run that goes on from a snapshot
  if (told_ || ++asked_ % 64 != 0) return;
  const double lasted = Seconds(std::chrono::steady_clock::now() - begun_).count();
  const double done = share - first_share_;
  if (lasted < after || !(done > 0)) return;
  told_ = true;
  const double hours = lasted * (1 - share) / done / hour;
  if (hours < long_rest / hour) return;
  const std::string rest = hours < 48          ? fmt::format("{:.0f} hours", hours)
                           : hours < 2 * 8766. ? fmt::format("{:.0f} days", hours / 24)
                                               : fmt::format("{:.0f} years", hours / 8766);
  fmt::print(stderr, "{}muster: note: {} takes another {} at this pace; Ctrl-C ends it with all records whole\n",
             shown_ ? "\r\x1b[K" : "", what_, rest);
  last_ = -1;
}

void expect_channel(const Simulation& run) {
  if (!run.board().find("link/*/ends"))
    throw Error(Exit::invalid_input, run.world().file.string() +
                                         ": the world has no radio channel; expected one, such as <radio.multiwall/>");
}

namespace {
volatile std::sig_atomic_t stop = 0;
}

bool interrupted() { return stop != 0; }
void watch_interrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) {
    stop = 1;
    static constexpr char note[] =
        "\nmuster: note: interrupted; it ends after the present step, and a second Ctrl-C "
        "ends it at once\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, note, sizeof note - 1);
  };
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second Ctrl-C ends at once
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
  struct sigaction hangup {};
  sigaction(SIGHUP, nullptr, &hangup);
  if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup asked for it to be ignored
}

}  // namespace muster::cli
