#include "tests/real_data/field_sets.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <stdexcept>

#include "tests/real_data/tables.hpp"

namespace muster::real_data {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Known known_of(const std::string& set, const Json& of) {
  return {set,
          of.at("known"),
          of.value("first", ""),
          of.value("count", std::size_t{1}),
          of.value("held", false),
          of.value("never", ""),
          of.value("verdict_not", "")};
}

double seconds(const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); }

[[noreturn]] void run_program(int out, const fs::path& folder) {
  dup2(out, STDOUT_FILENO);
  const std::string world = (folder / "world.xml").string(), data = (folder / "measured.csv").string();
  execl(MUSTER_PROGRAM, MUSTER_PROGRAM, "diagnose", world.c_str(), "--data", data.c_str(), "--json", nullptr);
  _exit(127);
}

}  // namespace

fs::path field_data() { return radio_data().parent_path() / "radio_field"; }

std::vector<Known> known_sets(const std::vector<std::string>& names) {
  std::ifstream in(fs::path(MUSTER_SOURCE_DIR) / "tests" / "real_data" / "radio_field.json");
  const Json all = Json::parse(in);
  for (const std::string& name : names)
    if (!all.contains(name)) throw std::runtime_error("there is no set " + name);
  std::vector<Known> result;
  for (const auto& [set, of] : all.items()) {
    if (names.empty() || std::find(names.begin(), names.end(), set) != names.end()) result.push_back(known_of(set, of));
  }
  return result;
}

// By fork and wait4: the figures of this one child.
Run diagnosed(const std::string& set) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) run_program(ends[1], field_data() / set);
  close(ends[1]);
  std::string text;
  std::array<char, 4096> part{};
  for (ssize_t n; (n = read(ends[0], part.data(), part.size())) > 0;) text.append(part.data(), static_cast<size_t>(n));
  close(ends[0]);
  int status = 0;
  rusage used{};
  if (child < 0 || wait4(child, &status, 0, &used) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error(set + ": muster diagnose fails");
  return {nlohmann::json::parse(text), seconds(used.ru_utime) + seconds(used.ru_stime),
          static_cast<double>(used.ru_maxrss) / 1024};
}

bool found_first(const Known& known, const nlohmann::json& report) {
  const nlohmann::json& causes = report.at("causes");
  if (known.first.empty() || causes.size() < known.count) return false;
  const std::regex pattern(known.first);
  return std::all_of(
      causes.begin(), causes.begin() + static_cast<std::ptrdiff_t>(known.count), [&](const nlohmann::json& cause) {
        const std::string name = cause.at("id").get<std::string>() + ' ' + cause.at("label").get<std::string>();
        return std::regex_match(name, pattern);
      });
}

}  // namespace muster::real_data
