// Prints what muster diagnose reports of the sets of ../shared/data/radio_field beside what is known of them.
// usage: real_sets [SET...]      all of them if none is named. Exit code 1: a cause that must come first does not.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "tests/real_data/field_sets.hpp"

namespace {

using muster::real_data::Known;
using nlohmann::json;

std::string number(const json& value, int decimals) {
  if (!value.is_number()) return "-";
  std::string text(32, '\0');
  text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.*f", decimals, value.get<double>())));
  return text;
}

// "rx_offset radio/phoneA, (step radio/phoneC)": in brackets what held-out data do not confirm.
std::string causes_in_words(const json& report) {
  std::string words;
  for (const json& cause : report.at("causes")) {
    if (cause.at("status") != "named") continue;
    const std::string id = cause.at("id");
    const std::string name = id.substr(id.find('.') + 1) + ' ' + cause.at("label").get<std::string>();
    words += (words.empty() ? "" : ", ") + (cause.at("confirmed").get<bool>() ? name : '(' + name + ')');
  }
  return words.empty() ? "none" : words;
}

std::string judged(const Known& known, const json& report) {
  if (known.first.empty()) return report.at("verdict") == known.verdict_not ? "no" : "-";
  return found_first(known, report) ? "yes" : "no";
}

}  // namespace

int main(int count, char** words) {
  try {
    if (!std::filesystem::exists(muster::real_data::field_data())) {
      std::fprintf(stderr, "real_sets: measured data are not there: %s\n", muster::real_data::field_data().c_str());
      return 2;
    }
    std::printf(
        "| set | known | first | verdict | named (not confirmed) | held out, dB: world | extended | CPU, s | MB |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
    bool as_it_was = true;
    for (const Known& known : muster::real_data::known_sets({words + 1, words + count})) {
      const auto [report, cpu, memory] = muster::real_data::diagnosed(known.set);
      as_it_was = as_it_was && (!known.held || found_first(known, report));
      std::printf("| `%s` | %s | %s | %s | %s | %s | %s | %.1f | %.0f |\n", known.set.c_str(), known.words.c_str(),
                  judged(known, report).c_str(), report.at("verdict").get<std::string>().c_str(),
                  causes_in_words(report).c_str(), number(report.at("base").at("heldout_rmse_db"), 2).c_str(),
                  number(report.at("heldout_rmse_db"), 2).c_str(), cpu, memory);
      std::fflush(stdout);
    }
    return as_it_was ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "real_sets: %s\n", error.what());
    return 2;
  }
}
