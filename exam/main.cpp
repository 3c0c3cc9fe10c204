// muster_exam: makes sealed cases for a diagnosis, and grades its reports. muster exam run (cli/exam_run.cpp) runs
// them.
#include <fmt/format.h>

#include <algorithm>

#include "exam/files.hpp"
#include "exam/follow_up.hpp"
#include "exam/generators.hpp"
#include "exam/grading/grade.hpp"
#include "exam/planned_readings.hpp"

namespace {

using namespace muster::exam;

constexpr const char* usage = R"(muster_exam: sealed cases for radio diagnosis

  muster_exam make --seed S --cases N --out DIR [--generator drawn|run|field|COMMAND] [--mix KIND,KIND...]
                   [--rows MIN MAX] [--lambda L[,M] | --size weak|medium|strong] [--effects ID,ID...] [--first N]
                   [--walls FILE] [--style STYLE] [--keep]
      --generator drawn: the exam's own plans, fields and effects (without --generator)
                  run: the simulator's own readings over such plans, with cause plugins planted in its worlds
                  field: as people measure: a flat, a mesh, a walk, a drive (--style flat|mesh|walk|drive: one of them)
                  COMMAND: anybody's, called as COMMAND SEED NUMBER FOLDER: docs/how-to/bring_your_own_exam.md
      --mix: drawn has clean, one, two, three, outside, each and mixed, run clean, one, two, three and each, field
      clean, one, two, three and four. "each": every effect in turn; "mixed", as without --mix: all but three.
      --rows, --lambda, --size: of drawn and run. --walls: of drawn, the floor plan of all cases, a table as worlds refer
      to (walls.csv); without it each case draws its own. --keep: cases that DIR has are left alone.
      writes DIR/case_0001/{world.xml, measured.csv}, walls.csv and second.csv where the generator has them, ... and
      DIR/answers/case_0001.json ...
  muster_exam run DIR [--reports DIR] [--command COMMAND] [--jobs N] [--generator ... as make, with --seed and --cases]
      runs a diagnosis over the cases, by default muster diagnose {world} --data {data} --json; what it prints becomes
      DIR/reports/case_0001.txt ..., what it cost DIR/reports/costs.csv. Cases that have a report are left alone.
      Slots of COMMAND: {world}, {data}, {second} (the other readings), {answer} (for follow alone), {out} (a folder of
      its own). With --generator the cases are made first, but for those in DIR. Several such commands may share an
      exam, one that was killed goes on where it was. By the program muster alone: muster exam run DIR
  muster_exam grade --answers DIR [--reports DIR] [--json | --table]
      holds reports (DIR/reports/case_0001.txt, or .json, or case_0001/diagnosis.json) against the answers; --table
      sets them beside the goals
  muster_exam follow DIR/answers/case_0001.json --plan FILE --out FILE
      makes the measurement that a diagnosis advises (advised.csv of muster diagnose --out): the case's readings with
      those at the plan's places and times behind them
  muster_exam effects [--generator drawn|run|field]
      lists the effects that can be hidden

The same under the program muster: muster exam make ...
Example: muster exam make --seed 7 --cases 40 --out exam
         muster exam run exam --jobs 2
         muster exam grade --answers exam
)";

int make(int argc, char** argv) {
  Arguments known = options_of_generators();
  known["--out"] = {"a folder"};
  known["--keep"] = {};
  const Arguments arguments = parsed(argc, argv, known);
  make_cases(arguments, required(arguments, "--out"), arguments.contains("--keep"));
  return 0;
}

// The given folder, or "reports" in the exam's.
std::filesystem::path reports_of(const Arguments& arguments, const std::filesystem::path& exam) {
  const auto at = arguments.find("--reports");
  return at == arguments.end() ? exam / "reports" : std::filesystem::path(at->second[0]);
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

int list_effects(int argc, char** argv) {
  for (const std::string& id : effects_of_generator(parsed(argc, argv, {{"--generator", {"drawn, run or field"}}})))
    fmt::print("{}\n", id);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const bool asks =
      std::any_of(argv + 1, argv + argc, [](const std::string& word) { return word == "--help" || word == "-h"; });
  const std::string verb = argc > 1 && !asks ? argv[1] : "--help";
  try {
    if (verb == "make") return make(argc, argv);
    if (verb == "run") {
      fmt::print(stderr, "muster_exam run: the program muster runs cases: muster exam run DIR\n");
      return 2;
    }
    if (verb == "grade") return run_grade(argc, argv);
    if (verb == "follow") return follow(argc, argv);
    if (verb == "effects") return list_effects(argc, argv);
    if (verb != "--help") {
      fmt::print(stderr, "muster_exam: there is no \"{}\"; {}\n", verb,
                 expected(verb, {"make", "run", "grade", "follow", "effects"}));
      return 2;
    }
    fmt::print("{}", usage);
    return 0;
  } catch (const std::invalid_argument& e) {
    fmt::print(stderr, "muster_exam {}: {}\n", verb, e.what());
    return 2;
  } catch (const std::exception& e) {
    fmt::print(stderr, "muster_exam {}: {}\n", verb, e.what());
    return 74;
  }
}
