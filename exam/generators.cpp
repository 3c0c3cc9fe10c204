#include "exam/generators.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <tuple>

#include "exam/case_spec.hpp"
#include "exam/field_survey/survey_case.hpp"
#include "exam/files.hpp"
#include "exam/foreign_generator.hpp"
#include "exam/simulated/simulated_case.hpp"
#include "exam/walls.hpp"
#include "exam/write.hpp"

namespace muster::exam {
namespace {

void set_sizes(Syllabus& syllabus, const Arguments& arguments) {
  if (arguments.contains("--lambda") && arguments.contains("--size"))
    throw std::invalid_argument("--lambda and --size exclude one another; expected one of them");
  if (const auto at = arguments.find("--lambda"); at != arguments.end()) {
    const std::vector<std::string> limits = listed(at->second[0]);
    if (limits.empty() || limits.size() > 2)
      throw std::invalid_argument("--lambda needs a number, or the least and the most as L,M");
    syllabus.least_lambda = number("--lambda", limits.front(), 0.1, 1e6);
    syllabus.most_lambda = number("--lambda", limits.back(), syllabus.least_lambda, 1e6);
  }
  if (const auto at = arguments.find("--size"); at != arguments.end()) {
    const std::map<std::string, std::pair<double, double>> sizes{
        {"weak", {12, 30}}, {"medium", {30, 100}}, {"strong", {100, 400}}};
    const auto size = sizes.find(at->second[0]);
    if (size == sizes.end())
      throw std::invalid_argument("a size is weak, medium or strong, not \"" + at->second[0] + "\"");
    std::tie(syllabus.least_lambda, syllabus.most_lambda) = size->second;
  }
}

// Two limits of the number of readings.
std::pair<double, double> rows_in(const std::vector<std::string>& words) {
  const double least = number("--rows", words[0], 200.0, 200000.0), most = number("--rows", words[1], 200.0, 200000.0);
  if (least > most)
    throw std::invalid_argument(
        fmt::format("--rows: {} is above {}; expected the least and the most", words[0], words[1]));
  return {least, most};
}

Syllabus syllabus_of(const Arguments& arguments) {
  Syllabus syllabus;
  syllabus.seed = number<std::uint64_t>("--seed", required(arguments, "--seed"), 0, ~std::uint64_t{0});
  if (const auto at = arguments.find("--mix"); at != arguments.end() && at->second[0] != "mixed")
    syllabus.kinds = listed(at->second[0]);
  const std::set<std::string> kinds{"clean", "one", "two", "three", "outside", "each"};
  for (const std::string& kind : syllabus.kinds)
    if (!kinds.contains(kind))
      throw std::invalid_argument("--mix: a kind is clean, one, two, three, outside or each, not \"" + kind + "\"");
  if (const auto at = arguments.find("--rows"); at != arguments.end()) {
    std::tie(syllabus.least_rows, syllabus.most_rows) = rows_in(at->second);
  }
  if (const auto at = arguments.find("--effects"); at != arguments.end()) syllabus.effects = listed(at->second[0]);
  for (const std::string& id : syllabus.effects) recipe(id);
  if (const auto at = arguments.find("--walls"); at != arguments.end()) {
    syllabus.walls = read_file(at->second[0]);
    try {
      syllabus.corridor = plan_of_walls(syllabus.walls).has_corridor;
    } catch (const std::runtime_error& e) {
      throw std::invalid_argument(at->second[0] + ": " + e.what());
    }
  }
  set_sizes(syllabus, arguments);
  return syllabus;
}

std::uint64_t seed_in(const Arguments& arguments) {
  return number<std::uint64_t>("--seed", required(arguments, "--seed"), 0, ~std::uint64_t{0});
}

// Options that a generator has no use for.
void refuse(const Arguments& arguments, const std::string& generator, const std::vector<std::string>& options) {
  for (const std::string& option : options)
    if (arguments.contains(option))
      throw std::invalid_argument(fmt::format("{} is not for --generator {}{}", option, generator,
                                              option == "--style" ? "; expected --generator field beside it" : ""));
}

std::vector<std::string> listed_in(const Arguments& arguments, const std::string& option, const std::string& what,
                                   const std::vector<std::string>& known) {
  const auto at = arguments.find(option);
  if (at == arguments.end()) return {};
  std::vector<std::string> result = listed(at->second[0]);
  for (const std::string& word : result) one_of(option + ": a " + what, word, known);
  return result;
}

template <class Kinds>
std::vector<std::string> ids_of(const Kinds& kinds) {
  std::vector<std::string> ids;
  for (const auto& kind : kinds) ids.emplace_back(kind.id);
  return ids;
}

using MakeOne = std::function<std::string(int number)>;  // returns what it made, in words

MakeOne drawn(const Arguments& arguments, const std::filesystem::path& out) {
  refuse(arguments, "drawn", {"--style"});
  return [out, syllabus = syllabus_of(arguments)](int i) {
    const Case made = make_case(name_of(i), seed_of(syllabus, i), draw_order(syllabus, i));
    write_case(made, out);
    return fmt::format("{}: {} readings", made.name, made.measured.size());
  };
}

MakeOne field(const Arguments& arguments, const std::filesystem::path& out) {
  refuse(arguments, "field", {"--rows", "--lambda", "--size", "--walls"});
  survey::Request request;
  request.seed = seed_in(arguments);
  request.kinds = listed_in(arguments, "--mix", "kind", {"clean", "one", "two", "three", "four"});
  request.effects = listed_in(arguments, "--effects", "effect of the field", ids_of(survey::kinds()));
  if (const auto at = arguments.find("--style"); at != arguments.end()) {
    one_of("--style: a style", at->second[0], survey::styles());
    request.style = at->second[0];
  }
  return [out, request](int i) {
    const survey::Made made = survey::make(request, i);
    survey::write(made, out);
    return fmt::format("{}: {} readings, {}", made.name, made.rssi.size(), made.campaign.style);
  };
}

MakeOne simulated_runs(const Arguments& arguments, const std::filesystem::path& out) {
  refuse(arguments, "run", {"--style", "--walls"});
  simulated::Request request;
  request.program = simulated::simulator_program();
  request.seed = seed_in(arguments);
  request.kinds = listed_in(arguments, "--mix", "kind", {"clean", "one", "two", "three", "each"});
  request.effects = listed_in(arguments, "--effects", "cause", ids_of(simulated::cause_kinds()));
  Syllabus sizes;
  set_sizes(sizes, arguments);
  request.least_lambda = sizes.least_lambda;
  request.most_lambda = sizes.most_lambda;
  if (const auto at = arguments.find("--rows"); at != arguments.end()) {
    std::tie(request.least_rows, request.most_rows) = rows_in(at->second);
  }
  return [out, request](int i) {
    const simulated::Made made = simulated::make(request, i);
    simulated::write(made, out);
    return fmt::format("{}: {} readings", made.name, made.measured.size());
  };
}

MakeOne foreign(const Arguments& arguments, const std::filesystem::path& out, const std::string& command) {
  refuse(arguments, "COMMAND", {"--style", "--walls", "--rows", "--lambda", "--size", "--mix", "--effects"});
  return [out, command, seed = seed_in(arguments)](int i) {
    make_foreign_case({command, seed, i, out});
    return fmt::format("{}: made", name_of(i));
  };
}

}  // namespace

const Arguments& options_of_generators() {
  static const Arguments options{{"--seed", {"a number"}},
                                 {"--generator", {"drawn, run, field or a command"}},
                                 {"--cases", {"a number"}},
                                 {"--mix", {"kinds"}},
                                 {"--rows", {"the least", "the most"}},
                                 {"--lambda", {"a number"}},
                                 {"--size", {"a size"}},
                                 {"--effects", {"ids"}},
                                 {"--style", {"a style"}},
                                 {"--first", {"a number"}},
                                 {"--walls", {"a file"}}};
  return options;
}

std::vector<std::string> effects_of_generator(const Arguments& arguments) {
  const auto at = arguments.find("--generator");
  const std::string generator = at == arguments.end() ? "drawn" : at->second[0];
  one_of("--generator: a generator with a list", generator, {"drawn", "run", "field"});
  if (generator == "run") return ids_of(simulated::cause_kinds());
  const auto marked = [](const char* id, bool in_vocabulary) {
    return std::string(id) + (in_vocabulary ? "" : "  (outside the vocabulary)");
  };
  std::vector<std::string> result;
  if (generator == "field")
    for (const survey::Kind& k : survey::kinds()) result.push_back(marked(k.id, k.in_vocabulary));
  else
    for (const Recipe& r : recipes()) result.push_back(marked(r.id, r.in_vocabulary));
  return result;
}

void make_cases(const Arguments& arguments, const std::filesystem::path& out, bool keep) {
  const int cases = number("--cases", required(arguments, "--cases"), 1, 1000000);
  const int first = arguments.contains("--first") ? number("--first", arguments.at("--first")[0], 1, 1000000) : 1;
  const auto at = arguments.find("--generator");
  const std::string generator = at == arguments.end() ? "drawn" : at->second[0];
  const auto mix = arguments.find("--mix");
  if (mix != arguments.end() && mix->second[0] == "clean" && arguments.contains("--effects"))
    throw std::invalid_argument(
        "--effects has no effect with --mix clean, whose cases hide none; expected --mix one beside it, or no "
        "--effects");
  const MakeOne make_one = generator == "drawn"   ? drawn(arguments, out)
                           : generator == "field" ? field(arguments, out)
                           : generator == "run"   ? simulated_runs(arguments, out)
                                                  : foreign(arguments, out, generator);
  for (int i = first; i < first + cases; ++i)
    if (!keep || !std::filesystem::exists(out / "answers" / (name_of(i) + ".json"))) fmt::print("{}\n", make_one(i));
}

}  // namespace muster::exam
