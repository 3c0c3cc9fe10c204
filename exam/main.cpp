// muster_exam: makes sealed cases for a diagnosis, and grades its reports.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <stdexcept>

#include "exam/case_spec.hpp"
#include "exam/field_survey/survey_case.hpp"
#include "exam/files.hpp"
#include "exam/follow_up.hpp"
#include "exam/grading/grade.hpp"
#include "exam/run.hpp"
#include "exam/walls.hpp"
#include "exam/write.hpp"

namespace {

using namespace muster::exam;

constexpr const char* usage = R"(muster_exam: sealed cases for radio diagnosis

  muster_exam make --seed S --cases N --out DIR [--mix clean,one,two,three,outside | mixed | each] [--rows MIN MAX]
                   [--lambda L[,M] | --size weak|medium|strong] [--effects ID,ID...] [--first N] [--walls FILE]
      "each": every effect in turn, those outside the vocabulary among them; "mixed", as without --mix: all but three.
      --walls: the floor plan of all cases, a table as worlds refer to (walls.csv); without it each case draws its own.
      writes DIR/case_0001/{world.xml, walls.csv, measured.csv, second.csv} ... and DIR/answers/case_0001.json ...
  muster_exam run DIR [--reports DIR] [--command COMMAND] [--jobs N]
      runs a diagnosis over the cases, by default muster diagnose {world} --data {data} --json; what it prints becomes
      DIR/reports/case_0001.txt ..., what it cost DIR/reports/costs.csv. Cases that have a report are left alone.
      Slots of COMMAND: {world}, {data}, {second} (the other readings), {answer} (for follow alone), {out} (a folder of
      its own)
  muster_exam grade --answers DIR [--reports DIR] [--json | --table]
      holds reports (DIR/reports/case_0001.txt, or .json, or case_0001/diagnosis.json) against the answers; --table
      sets them beside the goals
  muster_exam follow DIR/answers/case_0001.json --plan FILE --out FILE
      makes the measurement that a diagnosis advises (advised.csv of muster diagnose --out): the case's readings with
      those at the plan's places and times behind them
  muster_exam effects
      lists the effects that can be hidden

The same under the program muster: muster exam make ...
Example: muster exam make --seed 7 --cases 40 --out exam
         muster exam run exam --jobs 2
         muster exam grade --answers exam
)";

using Arguments = std::map<std::string, std::vector<std::string>>;

// Parses options among the known ones, each with its values; "" holds the words outside any option.
Arguments parsed(int argc, char** argv, const Arguments& known) {
  Arguments result;
  for (int i = 2; i < argc; ++i) {
    const std::string option = argv[i];
    if (option[0] != '-' && known.contains("")) {
      result[""].push_back(option);
      continue;
    }
    const auto spec = known.find(option);
    if (spec == known.end()) throw std::invalid_argument("no option is called " + option);
    auto& values = result[option];
    for (std::size_t k = 0; k < spec->second.size(); ++k) {
      if (++i >= argc) throw std::invalid_argument(option + " needs " + spec->second[k]);
      values.push_back(argv[i]);
    }
  }
  return result;
}

template <class Number>
Number number(const std::string& text, Number least, Number most) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= least && value <= most))
    throw std::invalid_argument(fmt::format("\"{}\" is not a number from {} to {}", text, least, most));
  return value;
}

std::vector<std::string> listed(const std::string& text) {
  std::vector<std::string> result(1);
  for (const char c : text) {
    if (c == ',')
      result.emplace_back();
    else
      result.back() += c;
  }
  return result;
}

void one_of(const std::string& what, const std::string& given, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), given) == known.end())
    throw std::invalid_argument(fmt::format("a {} is {}, not \"{}\"", what, fmt::join(known, ", "), given));
}

const std::string& required(const Arguments& arguments, const std::string& option) {
  const auto at = arguments.find(option);
  if (at == arguments.end()) throw std::invalid_argument(option + " is missing");
  return at->second[0];
}

void set_sizes(Syllabus& syllabus, const Arguments& arguments) {
  if (arguments.contains("--lambda") && arguments.contains("--size"))
    throw std::invalid_argument("--lambda and --size exclude one another");
  if (const auto at = arguments.find("--lambda"); at != arguments.end()) {
    const std::vector<std::string> limits = listed(at->second[0]);
    if (limits.empty() || limits.size() > 2)
      throw std::invalid_argument("--lambda needs a number, or the least and the most as L,M");
    syllabus.least_lambda = number(limits.front(), 0.1, 1e6);
    syllabus.most_lambda = number(limits.back(), syllabus.least_lambda, 1e6);
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

Syllabus syllabus_of(const Arguments& arguments) {
  Syllabus syllabus;
  syllabus.seed = number<std::uint64_t>(required(arguments, "--seed"), 0, ~std::uint64_t{0});
  if (const auto at = arguments.find("--mix"); at != arguments.end() && at->second[0] != "mixed")
    syllabus.kinds = listed(at->second[0]);
  const std::set<std::string> kinds{"clean", "one", "two", "three", "outside", "each"};
  for (const std::string& kind : syllabus.kinds)
    if (!kinds.contains(kind))
      throw std::invalid_argument("a kind is clean, one, two, three, outside or each, not \"" + kind + "\"");
  if (const auto at = arguments.find("--rows"); at != arguments.end()) {
    syllabus.least_rows = number(at->second[0], 200.0, 200000.0);
    syllabus.most_rows = number(at->second[1], syllabus.least_rows, 200000.0);
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

// Cases as somebody measures who knows nothing of the diagnosis.
void make_field_cases(const Arguments& arguments, int first, int cases) {
  for (const char* option : {"--rows", "--lambda", "--size", "--walls"})
    if (arguments.contains(option)) throw std::invalid_argument(fmt::format("{} is not for --generator field", option));
  survey::Request request;
  request.seed = number<std::uint64_t>(required(arguments, "--seed"), 0, ~std::uint64_t{0});
  if (const auto at = arguments.find("--mix"); at != arguments.end()) request.kinds = listed(at->second[0]);
  for (const std::string& kind : request.kinds) one_of("kind", kind, {"clean", "one", "two", "three", "four"});
  if (const auto at = arguments.find("--style"); at != arguments.end()) request.style = at->second[0];
  if (!request.style.empty()) one_of("style", request.style, survey::styles());
  if (const auto at = arguments.find("--effects"); at != arguments.end()) request.effects = listed(at->second[0]);
  std::vector<std::string> ids;
  for (const survey::Kind& kind : survey::kinds()) ids.emplace_back(kind.id);
  for (const std::string& id : request.effects) one_of("effect of the field", id, ids);
  const std::string& out = required(arguments, "--out");
  for (int i = first; i < first + cases; ++i) {
    const survey::Made made = survey::make(request, i);
    survey::write(made, out);
    fmt::print("{}: {} readings, {}\n", made.name, made.rssi.size(), made.campaign.style);
  }
}

int make(int argc, char** argv) {
  const Arguments arguments = parsed(argc, argv,
                                     {{"--seed", {"a number"}},
                                      {"--generator", {"drawn or field"}},
                                      {"--style", {"a style"}},
                                      {"--cases", {"a number"}},
                                      {"--out", {"a folder"}},
                                      {"--mix", {"kinds"}},
                                      {"--rows", {"the least", "the most"}},
                                      {"--lambda", {"a number"}},
                                      {"--size", {"a size"}},
                                      {"--effects", {"ids"}},
                                      {"--first", {"a number"}},
                                      {"--walls", {"a file"}}});
  const int cases = number(required(arguments, "--cases"), 1, 1000000);
  const int first = arguments.contains("--first") ? number(arguments.at("--first")[0], 1, 1000000) : 1;
  const auto generator = arguments.find("--generator");
  if (generator != arguments.end()) one_of("generator", generator->second[0], {"drawn", "field"});
  if (generator != arguments.end() && generator->second[0] == "field") {
    make_field_cases(arguments, first, cases);
    return 0;
  }
  if (arguments.contains("--style")) throw std::invalid_argument("--style is for --generator field");
  const Syllabus syllabus = syllabus_of(arguments);
  const std::string& out = required(arguments, "--out");
  for (int i = first; i < first + cases; ++i) {
    const Case made = make_case(name_of(i), seed_of(syllabus, i), draw_order(syllabus, i));
    write_case(made, out);
    fmt::print("{}: {} readings\n", made.name, made.measured.size());
  }
  return 0;
}

// The given folder, or "reports" in the exam's.
std::filesystem::path reports_of(const Arguments& arguments, const std::filesystem::path& exam) {
  const auto at = arguments.find("--reports");
  return at == arguments.end() ? exam / "reports" : std::filesystem::path(at->second[0]);
}

int run(int argc, char** argv) {
  const Arguments arguments = parsed(
      argc, argv, {{"", {}}, {"--reports", {"a folder"}}, {"--command", {"a command"}}, {"--jobs", {"a number"}}});
  const auto given = arguments.find("");
  if (given == arguments.end() || given->second.size() != 1)
    throw std::invalid_argument("expected one folder, as make wrote it");
  RunOrder order{given->second[0], reports_of(arguments, given->second[0]), "", 1};
  if (const auto at = arguments.find("--command"); at != arguments.end()) order.command = at->second[0];
  if (order.command.empty()) order.command = default_command();
  if (const auto at = arguments.find("--jobs"); at != arguments.end()) order.jobs = number(at->second[0], 1, 1000);
  const RunOutcome outcome = run_cases(order);
  fmt::print("{} cases run, {} had a report, {} failed\n", outcome.ran, outcome.kept, outcome.failed.size());
  for (const std::string& words : outcome.failed) fmt::print("{}\n", words);
  return outcome.failed.empty() ? 0 : 1;
}

int run_grade(int argc, char** argv) {
  const Arguments arguments =
      parsed(argc, argv, {{"--answers", {"a folder"}}, {"--reports", {"a folder"}}, {"--json", {}}, {"--table", {}}});
  const std::string& answers = required(arguments, "--answers");
  const Grades grades = grade(answers, reports_of(arguments, answers));
  fmt::print("{}", arguments.contains("--json")    ? as_json(grades)
                   : arguments.contains("--table") ? as_table(grades)
                                                   : as_text(grades));
  return grades.missing.empty() ? 0 : 1;
}

int follow(int argc, char** argv) {
  const Arguments arguments = parsed(argc, argv, {{"", {}}, {"--plan", {"a file"}}, {"--out", {"a file"}}});
  const auto given = arguments.find("");
  if (given == arguments.end() || given->second.size() != 1)
    throw std::invalid_argument("expected one answer, as make wrote it");
  const std::vector<PlannedReadings> asked = read_plan(read_file(required(arguments, "--plan")));
  write_file(required(arguments, "--out"), followed_csv(read_case(given->second[0]), asked));
  return 0;
}

int list_effects() {
  for (const Recipe& r : recipes()) fmt::print("{}{}\n", r.id, r.in_vocabulary ? "" : "  (outside the vocabulary)");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool asks =
      std::any_of(argv + 1, argv + argc, [](const std::string& word) { return word == "--help" || word == "-h"; });
  const std::string verb = argc > 1 && !asks ? argv[1] : "--help";
  try {
    if (verb == "make") return make(argc, argv);
    if (verb == "run") return run(argc, argv);
    if (verb == "grade") return run_grade(argc, argv);
    if (verb == "follow") return follow(argc, argv);
    if (verb == "effects") return list_effects();
    fmt::print("{}", usage);
    return verb == "--help" ? 0 : 2;
  } catch (const std::invalid_argument& e) {
    fmt::print(stderr, "muster_exam {}: {}\n", verb, e.what());
    return 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "muster_exam {}: {}\n", verb, e.what());
    return 74;
  }
}
