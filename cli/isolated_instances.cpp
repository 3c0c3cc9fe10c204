#include "isolated_instances.hpp"

#include <utility>

#include "run_options.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::cli {
namespace {

AfterCrash policy_of(const std::string& word, const std::string& instance) {
  if (word == "stop") return AfterCrash::stop;
  if (word == "restart") return AfterCrash::restart;
  if (word == "without") return AfterCrash::without;
  throw Error(Exit::invalid_input, "--isolate: " + instance + ": there is no " + quote(word) + "; " +
                                       suggest(word, {"stop", "restart", "without"}));
}

}  // namespace

Isolations isolations_of(const std::vector<std::string>& given, const std::optional<std::string>& limit) {
  constexpr double least = 0.01, most = 86'400;  // [s]
  Isolation how;
  if (limit) {
    const double seconds = real_of(*limit, "--isolate-limit", "s");
    if (!(seconds >= least && seconds <= most))
      throw Error(Exit::invalid_input, "--isolate-limit: " + *limit + " s is out of bounds; expected " +
                                           print_real(least) + " to " + print_real(most) + " s");
    how.limit = std::chrono::milliseconds(static_cast<int64_t>(seconds * 1000));
  }
  Isolations result;
  for (const std::string& word : given) {
    const auto sign = word.find('=');
    const std::string instance = word.substr(0, sign);
    if (instance.empty())
      throw Error(Exit::invalid_input,
                  "--isolate: " + quote(word) + " names no instance; expected such as physics, physics=restart or all");
    how.after = sign == word.npos ? AfterCrash::stop : policy_of(word.substr(sign + 1), instance);
    if (!result.emplace(instance == "all" ? "*" : instance, how).second)
      throw Error(Exit::invalid_input, "--isolate: " + instance + " is named twice");
  }
  return result;
}

}  // namespace muster::cli
