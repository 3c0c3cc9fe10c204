// muster plugin-check CAUSE: whether a diagnosis finds an author's cause, and nothing where there is nothing.
#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "diagnosis/causes/cause_candidates.hpp"
#include "diagnosis/pipeline/cause_self_test.hpp"
#include "diagnosis/pipeline/declared_law_check.hpp"
#include "installation.hpp"
#include "text/json.hpp"
#include "text/temporary_folder.hpp"
#include "verbs.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;
using diagnosis::CauseSelfTest;
using diagnosis::HiddenCase;

constexpr double goal_found = 0.95,
                 goal_false = 0.01;          // shares; a check fails only beyond what chance does once in 1,000
constexpr double largest_difference = 1e-6;  // dB

// Worlds in which nothing is hidden, by the program that makes exams: their truth shares no code with any cause.
std::vector<fs::path> clean_worlds(int count, uint64_t seed, const std::vector<int>& rows, const fs::path& folder) {
  if (rows[0] > rows[1])
    throw Error(Exit::invalid_input, "muster plugin-check: --rows: " + std::to_string(rows[0]) + " is above " +
                                         std::to_string(rows[1]) + "; expected FROM TO");
  const std::string program = (installation().parts / "muster_exam").string();
  std::vector<std::string> words{program,
                                 "make",
                                 "--mix",
                                 "clean",
                                 "--seed",
                                 std::to_string(seed),
                                 "--cases",
                                 std::to_string(count),
                                 "--rows",
                                 std::to_string(rows[0]),
                                 std::to_string(rows[1]),
                                 "--out",
                                 folder.string()};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  ::posix_spawn_file_actions_init(&quiet);
  ::posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, program.c_str(), &quiet, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&quiet);
  if (failed) throw Error(Exit::io, program + " cannot be started: " + std::strerror(failed));
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  if (status != 0) throw Error(Exit::io, program + " could not make the worlds");
  std::vector<fs::path> result;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().rfind("case_", 0) == 0) result.push_back(entry.path());
  }
  std::sort(result.begin(), result.end());
  return result;
}

// The fewest successes of `trials`, each of probability p, that chance still brings once in 1,000: the binomial's
// quantile.
int least(int trials, double p) {
  double up_to = 0;
  for (int k = 0; k < trials; ++k) {
    up_to += std::exp(std::lgamma(trials + 1) - std::lgamma(k + 1) - std::lgamma(trials - k + 1) + k * std::log(p) +
                      (trials - k) * std::log1p(-p));
    if (up_to >= 0.001) return k;
  }
  return trials;
}

int least_found(const CauseSelfTest& check) { return least(check.tested(), goal_found); }
int most_false(const CauseSelfTest& check) { return check.tested() - least(check.tested(), 1 - goal_false); }

// What it falls short in, in words; empty: it passes.
std::string shortfall(const CauseSelfTest& check) {
  std::string words;
  const auto add = [&](bool fails, const std::string& what) {
    if (fails) words += (words.empty() ? "" : "; ") + what;
  };
  if (check.tested() == 0) return "the data of none of these worlds can speak of it";
  add(check.found() < least_found(check),
      fmt::format("found in {}, expected at least {} of {}", check.found(), least_found(check), check.tested()));
  add(check.false_names() > most_false(check), fmt::format("named on {} clean worlds, expected at most {} of {}",
                                                           check.false_names(), most_false(check), check.tested()));
  add(!(check.difference() < largest_difference),
      fmt::format("executed {:.2g} dB off, expected within {:.0e} dB", check.difference(), largest_difference));
  return words;
}

void print(const CauseSelfTest& check, double lambda) {
  for (const HiddenCase& c : check.cases) {
    const std::string world = c.world.filename().string();
    if (!c.why_not.empty())
      fmt::print("{}  not tested: {}\n", world, c.why_not);
    else if (!c.alone)
      fmt::print("{}  hidden {}, named {}\n", world, c.where, c.named.empty() ? "nothing" : c.named);
    if (c.named_on_clean) fmt::print("{}  named where nothing was hidden\n", world);
  }
  const int n = check.tested();
  fmt::print("{}\n", check.id);
  if (n == 0) return;
  const auto alone = std::count_if(check.cases.begin(), check.cases.end(), [](const HiddenCase& c) { return c.alone; });
  fmt::print("  found            {} of {} at lambda {} (goal {:.0f} %, at least {}), {} of them with nothing besides\n",
             check.found(), n, lambda, 100 * goal_found, least_found(check), alone);
  fmt::print("  named on clean   {} of {} (goal at most {:.0f} %, at most {})\n", check.false_names(), n,
             100 * goal_false, most_false(check));
  fmt::print("  executed         within {:.2g} dB of what the search adds (at most {:.0e})\n", check.difference(),
             largest_difference);
  fmt::print("  looks like       ");
  int shown = 0;
  for (const auto& [other, share] : check.alike()) {
    if (share < 0.25 || shown == 5) break;
    fmt::print("{}{} {:.0f} %", shown++ ? ", " : "", other, 100 * share);
  }
  fmt::print("{}\n", shown ? " of its energy explained" : "no other cause: none explains a quarter of it");
}

Json json_of(const CauseSelfTest& check) {
  Json cases = Json::array(), alike = Json::object();
  for (const HiddenCase& c : check.cases)
    cases.push_back({{"world", c.world.filename().string()},
                     {"not_tested", c.why_not},
                     {"hidden", c.where},
                     {"lambda", c.lambda},
                     {"named", c.named},
                     {"found", c.found},
                     {"alone", c.alone},
                     {"named_on_clean", c.named_on_clean},
                     {"difference_db", c.difference}});
  for (const auto& [other, share] : check.alike()) alike[other] = share;
  return {{"cause", check.id},
          {"passes", shortfall(check).empty()},
          {"tested", check.tested()},
          {"found", check.found()},
          {"least_found", least_found(check)},
          {"false_names", check.false_names()},
          {"most_false_names", most_false(check)},
          {"difference_db", check.difference()},
          {"alike", alike},
          {"cases", cases}};
}

// Of a cause that shifts no level.
int report_law(const std::string& id, const std::vector<diagnosis::DeclarationCheck>& checks, bool json) {
  std::string failed;
  Json list = Json::array();
  for (const auto& check : checks) {
    if (!check.fine) failed += (failed.empty() ? "" : "; ") + check.what + ' ' + check.found;
    list.push_back({{"what", check.what}, {"found", check.found}, {"passes", check.fine}});
  }
  if (json) {
    fmt::print("{}\n", Json{{"cause", id}, {"passes", failed.empty()}, {"checks", list}}.dump());
  } else {
    fmt::print("{}\n", id);
    for (const auto& check : checks) fmt::print("  {:16} {}\n", check.what, check.found);
    fmt::print("{}\n", failed.empty() ? "passed" : "failed: " + failed);
  }
  return static_cast<int>(failed.empty() ? Exit::done : Exit::check_failed);
}

}  // namespace

int run_plugin_check(const Arguments& arguments) {
  CommandLine line(
      "plugin-check",
      "Hides a cause in measurements of worlds that are otherwise as their file says, and diagnoses them; the same\n"
      "worlds without it; the simulator against the search; and what else explains it. Of a law, a clip or a burst it\n"
      "checks what is declared: its density, and the simulator's draws in one world. Ends with 1 if it falls short.\n"
      "Example: muster plugin-check effect.antenna_rx --worlds 10");
  std::string id;
  std::vector<std::string> plugins;
  int worlds = 20;
  double lambda = 60;
  uint64_t seed = 1;
  std::vector<int> rows{2000, 3000};
  bool json = false;
  line.option("cause", id, "the cause's id, such as effect.drift").required();
  line.option("--plugins", plugins, "a folder of plugins, looked in first");
  line.option("--worlds", worlds, "how many").within(1, 10000).shows_default();
  line.option("--rows", rows, "readings of a world: from, to").takes(2).within(500, 100000);
  line.option("--lambda", lambda, "strength: twice the expected log-likelihood ratio").within(1., 1e6).shows_default();
  line.option("--seed", seed, "of worlds and places").shows_default();
  line.flag("--json", json, "print the result as JSON");
  line.parse(arguments);
  const TemporaryFolder scratch;
  const diagnosis::Cause cause = diagnosis::cause_on(plugin_path(plugins), id);
  const bool shifts = diagnosis::shifts_levels(cause);
  const auto made = clean_worlds(shifts ? worlds : 1, seed, rows, scratch.path());
  if (!shifts) return report_law(id, diagnosis::check_declared_law(cause, made.front(), plugin_path(plugins)), json);
  CauseSelfTest check;
  {
    Progress progress("plugin-check");
    check = diagnosis::self_test_cause(id, made, plugin_path(plugins), {lambda, seed, scratch.path()},
                                       [&](double share) { progress.at(share); });
  }
  const std::string why = shortfall(check);
  if (json) {
    fmt::print("{}\n", json_of(check).dump());
  } else {
    print(check, lambda);
    fmt::print("{}\n", why.empty() ? "passed" : "failed: " + why);
  }
  return static_cast<int>(why.empty() ? Exit::done : Exit::check_failed);
}

}  // namespace muster::cli
