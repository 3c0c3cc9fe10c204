#include "exam/foreign_generator.hpp"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>
#include <vector>

#include "exam/case_spec.hpp"
#include "exam/files.hpp"
#include "exam/simulated/planted_cause.hpp"

namespace muster::exam {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// Levenshtein's distance.
int edits(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row.back();
}

std::string nearest_cause(const std::string& id) {
  const auto& all = simulated::cause_kinds();
  return std::min_element(all.begin(), all.end(),
                          [&](const auto& a, const auto& b) { return edits(id, a.id) < edits(id, b.id); })
      ->id;
}

bool is_cause(const std::string& id) {
  const auto& all = simulated::cause_kinds();
  return std::any_of(all.begin(), all.end(), [&](const auto& k) { return k.id == id; });
}

[[noreturn]] void refuse(const std::string& file, const std::string& key, const std::string& words) {
  throw std::runtime_error(fmt::format("{}: {}: {}", file, key, words));
}

void check_effect(ordered_json& effect, const std::string& key, const std::string& file) {
  if (!effect.is_object()) refuse(file, key, "expected an object with \"id\" and \"lambda\"");
  static const std::vector<std::string> known{"id",   "lambda", "in_vocabulary", "rows", "parameters",
                                              "also", "class",  "covariates",    "acts", "wanted_lambda"};
  for (const auto& [name, value] : effect.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse(file, key + "." + name, fmt::format("unknown; expected one of {}", fmt::join(known, ", ")));
  if (!effect.contains("id") || !effect["id"].is_string()) refuse(file, key + ".id", "expected a name");
  if (!effect.contains("lambda") || !effect["lambda"].is_number() || effect["lambda"].get<double>() < 0)
    refuse(file, key + ".lambda", "expected a number from 0, twice the expected log-likelihood ratio");
  if (!effect.contains("in_vocabulary")) effect["in_vocabulary"] = true;
  if (!effect["in_vocabulary"].is_boolean()) refuse(file, key + ".in_vocabulary", "expected true or false");
  const std::string id = effect["id"];
  if (effect["in_vocabulary"].get<bool>() && !is_cause(id))
    refuse(file, key + ".id",
           fmt::format("no cause is called \"{}\"; did you mean \"{}\"? An effect without a name in muster has "
                       "\"in_vocabulary\": false",
                       id, nearest_cause(id)));
  for (const char* list : {"rows", "also", "class", "covariates"}) {
    ordered_json& of = effect[list];
    if (of.is_null()) of = ordered_json::array();
    if (!of.is_array() || !std::all_of(of.begin(), of.end(), [](const auto& v) { return v.is_string(); }))
      refuse(file, key + "." + list, "expected a list of names");
  }
  for (const char* list : {"also", "class"}) {
    for (const std::string other : effect[list]) {
      if (!is_cause(other))
        refuse(file, key + "." + list,
               fmt::format("no cause is called \"{}\"; did you mean \"{}\"?", other, nearest_cause(other)));
    }
  }
  ordered_json& parameters = effect["parameters"];
  if (parameters.is_null()) parameters = ordered_json::array();
  if (!parameters.is_array()) refuse(file, key + ".parameters", "expected a list");
  for (const ordered_json& p : parameters)
    if (!p.is_object() || !p.contains("name") || !p["name"].is_string() || !p.contains("value") ||
        !p["value"].is_number())
      refuse(file, key + ".parameters", "expected {\"name\": a name, \"value\": a number} in each place");
}

}  // namespace

std::string full_answer(const std::string& text, const std::string& case_name, const std::string& file) {
  ordered_json answer;
  try {
    answer = ordered_json::parse(text);
  } catch (const ordered_json::parse_error& e) {
    throw std::runtime_error(fmt::format("{}: not JSON: {}", file, e.what()));
  }
  if (!answer.is_object()) throw std::runtime_error(file + ": expected an object with \"effects\"");
  if (answer.value("format", "muster_exam/1") != "muster_exam/1") refuse(file, "format", "expected \"muster_exam/1\"");
  if (!answer.contains("effects") || !answer["effects"].is_array())
    refuse(file, "effects", "expected a list, empty for a clean case");
  ordered_json& effects = answer["effects"];
  for (std::size_t i = 0; i < effects.size(); ++i) check_effect(effects[i], fmt::format("effects[{}]", i), file);
  constexpr const char* words[] = {"clean", "one", "two", "three", "four"};
  if (effects.size() >= std::size(words)) refuse(file, "effects", "expected four or fewer");
  const std::string count = words[effects.size()];
  const bool outside = effects.size() == 1 && !effects[0]["in_vocabulary"].get<bool>();
  answer["format"] = "muster_exam/1";
  answer["case"] = case_name;
  answer["kind"] = outside ? "outside" : count;
  return answer.dump(1) + "\n";
}

void make_foreign_case(const ForeignOrder& order) {
  const std::string name = name_of(order.number);
  const fs::path folder = order.exam / name;
  fs::create_directories(folder);
  fs::create_directories(order.exam / "answers");
  std::string word;  // the folder as one word of the shell
  for (const char c : folder.string()) word += c == '\'' ? "'\\''" : std::string(1, c);
  const std::string command = fmt::format("{} {} {} '{}' 1>&2", order.command, order.seed, order.number, word);
  const int status = std::system(command.c_str());
  if (status != 0)
    throw std::runtime_error(fmt::format("{}: the generator failed with exit code {}: {}", name,
                                         WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), command));
  for (const char* file : {"world.xml", "measured.csv", "answer.json"})
    if (!fs::is_regular_file(folder / file))
      throw std::runtime_error(fmt::format("{}: the generator wrote no {}", folder.string(), file));
  const fs::path written = folder / "answer.json";
  const std::string answer = full_answer(read_file(written), name, written.string());
  fs::remove(written);  // an examinee sees the folder
  write_file(order.exam / "answers" / (name + ".json"), answer);
}

}  // namespace muster::exam
