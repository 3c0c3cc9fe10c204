// muster VERB ...: finds the verb, runs it, and turns errors into one line and an exit code.
#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <system_error>

#include "declared_pages.hpp"
#include "kernel/callback_watch.hpp"
#include "kernel/crash_report.hpp"
#include "text/names.hpp"
#include "verbs.hpp"

namespace {

using namespace muster;
using namespace muster::cli;

constexpr const char* summary =
    "simulates teams of robots that move, sense and talk by radio, and holds them against measurements";

void print_usage(std::FILE* to) {
  fmt::print(to, "muster VERB ...: {}\n\n", summary);
  for (const auto& verb : verbs()) fmt::print(to, "  {:<10} {}\n", verb.name, verb.summary);
  fmt::print(to,
             "\nmuster VERB --help says more.  Example: muster run worlds/connectivity --json\n"
             "muster --man prints all of it as a page for man, muster --completion bash what bash completes.\n");
}

std::vector<DeclaredVerb> declared_verbs() {
  std::vector<DeclaredVerb> result;
  for (const auto& verb : verbs()) {
    result.push_back(verb.help ? declared_by_help(verb.name, "muster_exam", verb.help()) : declared(verb.run));
    result.back().summary = verb.summary;
  }
  return result;
}

int print_completion(const Arguments& words) {
  if (words.size() != 2 || words[1] != "bash") {
    const std::string given = words.size() > 1 ? "there is no " + quote(words[1]) + "; " : "";
    throw Error(Exit::invalid_input, "--completion: " + given + "expected one shell, bash");
  }
  return fmt::print("{}", bash_completion(declared_verbs())), 0;
}

// "run, swap, compare": the verbs that have an option which another has not.
std::string verbs_with(const UnknownOption& e) {
  std::string with;
  for (const auto& verb : verbs()) {
    if (verb.help) continue;  // it declares its options elsewhere
    for (const DeclaredOption& option : declared(verb.run).options) {
      if (std::find(option.names.begin(), option.names.end(), e.option) != option.names.end())
        with += (with.empty() ? "" : ", ") + std::string(verb.name);
    }
  }
  return with;
}

// What verbs of others are here, as they are to be typed.
struct Habit {
  const char *verb, *what, *command;
};
constexpr Habit habits[] = {{"view", "to watch a run", "muster run {} --view"},
                            {"gui", "to watch a run", "muster run {} --view"},
                            {"watch", "to watch a run", "muster run {} --view"},
                            {"visualize", "to watch a run", "muster run {} --view"},
                            {"rviz", "to watch a run", "muster run {} --view"},
                            {"record", "to record a run for Foxglove and ROS 2", "muster run {} --mcap run.mcap"},
                            {"set", "to set a parameter", "muster run {} --set INSTANCE/NAME=VALUE"},
                            {"step", "to run some seconds alone", "muster run {} --until SECONDS"},
                            {"resume", "to go on from a state", "muster run {} --restore FILE"},
                            {"restore", "to go on from a state", "muster run {} --restore FILE"},
                            {"save", "to save the state at the end", "muster run {} --save FILE"}};

[[noreturn]] void refuse_verb(const Arguments& words, const std::vector<std::string>& names) {
  for (const Habit& habit : habits) {
    if (words[0] != habit.verb) continue;
    if (words.size() > 1 && std::filesystem::exists(std::filesystem::path(words[1]) / "run.json"))
      throw Error(Exit::invalid_input, fmt::format("there is no verb {}; {} is the record of a run: muster report {} "
                                                   "makes its page, {}/run.html (muster --help lists the verbs)",
                                                   quote(words[0]), quote(words[1]), words[1], words[1]));
    const std::string world = words.size() > 1 && !words[1].starts_with("-") ? words[1] : "WORLD";
    throw Error(Exit::invalid_input,
                fmt::format("there is no verb {}; {}: {} (muster --help lists the verbs)", quote(words[0]), habit.what,
                            fmt::format(fmt::runtime(habit.command), world)));
  }
  if (std::filesystem::exists(words[0]))  // a world, whose verb was left out
    throw Error(Exit::invalid_input, "there is no verb " + quote(words[0]) + ", which is a " +
                                         (std::filesystem::is_directory(words[0]) ? "folder" : "file") +
                                         "; did you mean muster run " + words[0] + "? muster --help lists the verbs");
  throw Error(Exit::invalid_input, "there is no verb " + quote(words[0]) + "; " + suggest(words[0], names));
}

int run(const Arguments& words) {
  if (words.empty()) return print_usage(stderr), static_cast<int>(Exit::invalid_input);
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") return print_usage(stdout), 0;
  if (words[0] == "--version") return fmt::print("muster {}\n", MUSTER_VERSION), 0;
  if (words[0] == "--man") return fmt::print("{}", manual_page(declared_verbs(), summary, MUSTER_VERSION)), 0;
  if (words[0] == "--completion") return print_completion(words);
  std::vector<std::string> names;
  for (const auto& verb : verbs()) {
    names.emplace_back(verb.name);
    if (words[0] != verb.name) continue;
    try {
      return verb.run({words.begin() + 1, words.end()});
    } catch (const UnknownOption& e) {
      const std::string others = e.is_guess ? verbs_with(e) : "";
      throw others.empty() ? static_cast<const Error&>(e) : e.of_others(others);
    }
  }
  refuse_verb(words, names);
}

int fail(Exit code, const std::string& message) {
  fmt::print(stderr, "muster: error: {}\n", message);
  return static_cast<int>(code);
}

// A reader that has read enough, such as `head`, is no news to the user.
int unwritten(int reason) {
  return reason == EPIPE ? static_cast<int>(Exit::io) : fail(Exit::io, "standard output cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  keep_standard_error();
  report_crashes();
  watch_callbacks();
  std::signal(SIGXFSZ, SIG_IGN);  // a file beyond `ulimit -f` is an error of writing
  std::signal(SIGPIPE, SIG_IGN);  // a reader that has gone is an error of writing, not a silent end
  std::signal(SIGCHLD, SIG_DFL);  // whoever started this may ignore it: then nobody is told how a child has ended
  int code = 0;
  try {
    code = run({argv + 1, argv + argc});
  } catch (const Helped&) {
  } catch (const Error& e) {
    code = fail(e.exit(), e.what());
  } catch (const std::bad_alloc&) {
    code = fail(Exit::internal, "out of memory");
  } catch (const std::filesystem::filesystem_error& e) {
    code = fail(Exit::io, e.path1().string() + ": " + e.code().message());
  } catch (const std::exception& e) {
    const auto* system = dynamic_cast<const std::system_error*>(&e);
    if (std::ferror(stdout)) return unwritten(system ? system->code().value() : 0);
    code = fail(Exit::internal, e.what());
  }
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) return unwritten(errno);
  return code;
}
