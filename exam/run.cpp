#include "exam/run.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>

#include "exam/simulated/simulator.hpp"

extern char** environ;

namespace muster::exam {
namespace {

namespace fs = std::filesystem;

// Quotes any text as one shell word.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + '\'';
}

// In one pass, so that a slot's name in a value is no slot: a folder may be called anything.
std::string filled(const std::string& command, const std::map<std::string, fs::path>& values) {
  std::string result;
  for (std::size_t at = 0; at < command.size();) {
    const auto slot = std::find_if(values.begin(), values.end(), [&](const auto& each) {
      return command.compare(at, each.first.size(), each.first) == 0;
    });
    result += slot == values.end() ? command.substr(at, 1) : quoted(slot->second.string());
    at += slot == values.end() ? 1 : slot->first.size();
  }
  return result;
}

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

std::vector<fs::path> cases_in(const fs::path& exam) {
  if (!fs::is_directory(exam))
    throw std::invalid_argument(exam.string() + ": there is no such folder; expected one that muster exam make wrote");
  std::vector<fs::path> result;
  for (const auto& entry : fs::directory_iterator(exam))
    if (entry.is_directory() && entry.path().filename().string().rfind("case_", 0) == 0) result.push_back(entry.path());
  if (result.empty())
    throw std::invalid_argument(exam.string() + ": has no folder case_...; expected one that muster exam make wrote");
  std::sort(result.begin(), result.end());
  return result;
}

class Runner {
 public:
  explicit Runner(const RunOrder& order) : order_(order), cases_(cases_in(order.exam)) {
    fs::create_directories(order.reports);
    const fs::path costs = order.reports / "costs.csv";
    const bool is_new = !fs::exists(costs);
    costs_.open(costs, std::ios::app);
    if (is_new) costs_ << "case,cpu[s],memory[MB],code\n";
    if (!costs_) throw std::runtime_error("cannot write " + costs.string());
  }

  RunOutcome run() {
    for (const fs::path& folder : cases_) {
      const std::string name = folder.filename().string();
      if (fs::exists(report(name))) {
        ++outcome_.kept;
        continue;
      }
      if (static_cast<int>(running_.size()) >= order_.jobs) wait_for_one();
      start(folder, name);
    }
    while (!running_.empty()) wait_for_one();
    if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\x1b[K");
    std::sort(outcome_.failed.begin(), outcome_.failed.end());
    return outcome_;
  }

 private:
  fs::path report(const std::string& name) const { return order_.reports / (name + ".txt"); }
  fs::path part(const std::string& name) const { return order_.reports / (name + ".part"); }
  fs::path errors(const std::string& name) const { return order_.reports / (name + ".err"); }

  void start(const fs::path& folder, const std::string& name) {
    const std::string command = filled(order_.command, {{"{world}", folder},
                                                        {"{data}", folder / "measured.csv"},
                                                        {"{second}", folder / "second.csv"},
                                                        {"{answer}", order_.exam / "answers" / (name + ".json")},
                                                        {"{out}", order_.reports / name}});
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, part(name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, errors(name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const char* const words[] = {"/bin/sh", "-c", command.c_str(), nullptr};
    pid_t process = 0;
    const int error = posix_spawn(&process, words[0], &files, nullptr, const_cast<char* const*>(words), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error) throw std::runtime_error(fmt::format("cannot start /bin/sh: {}", std::strerror(error)));
    running_[process] = name;
  }

  void wait_for_one() {
    int status = 0;
    rusage used{};
    const pid_t process = wait4(-1, &status, 0, &used);
    if (process < 0) throw std::runtime_error(fmt::format("cannot wait for a command: {}", std::strerror(errno)));
    const auto entry = running_.find(process);
    if (entry == running_.end()) return;
    const std::string name = entry->second;
    running_.erase(entry);
    finish(name, WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), used);
    if (isatty(STDERR_FILENO)) fmt::print(stderr, "\rexam {}/{}", outcome_.ran + outcome_.kept, cases_.size());
  }

  void finish(const std::string& name, int code, const rusage& used) {
    ++outcome_.ran;
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    costs_ << fmt::format("{},{:.2f},{:.0f},{}\n", name, seconds(used.ru_utime) + seconds(used.ru_stime),
                          static_cast<double>(used.ru_maxrss) / 1024, code)
           << std::flush;
    if (code == 0) {
      fs::rename(part(name), report(name));
      if (fs::file_size(errors(name)) == 0) fs::remove(errors(name));
      return;
    }
    outcome_.failed.push_back(fmt::format("{}: exit code {}: {}", name, code, first_line(errors(name))));
    fs::remove(part(name));
  }

  RunOrder order_;
  std::vector<fs::path> cases_;
  std::ofstream costs_;
  std::map<pid_t, std::string> running_;
  RunOutcome outcome_;
};

}  // namespace

std::string default_command() {
  return quoted(simulated::simulator_program().string()) + " diagnose {world} --data {data} --json";
}

RunOutcome run_cases(const RunOrder& order) { return Runner(order).run(); }

}  // namespace muster::exam
