#include <gmock/gmock.h>

#include <algorithm>
#include <csignal>
#include <thread>

#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

constexpr const char* silent = R"(echo '{"verdict":"adequate","causes":[],"unexplained":[]}')";

// Cases whose files hold nothing that these commands read.
class ExamFolder : public ProgramFolder {
 public:
  explicit ExamFolder(int cases) {
    for (int i = 1; i <= cases; ++i) write(name(i) + "/measured.csv", "of case " + std::to_string(i) + "\n");
  }
  static std::string name(int i) { return "exam/case_000" + std::to_string(i); }
  Outcome run(const std::string& command, const std::vector<std::string>& more = {},
              const Surroundings& around = {}) const {
    std::vector<std::string> words{"exam", "run", "exam", "--command", command};
    words.insert(words.end(), more.begin(), more.end());
    return muster(words, around);
  }
  // Lines of a file, in order.
  std::vector<std::string> lines(const std::string& file) const {
    std::istringstream in(read(file));
    std::vector<std::string> result;
    for (std::string line; std::getline(in, line);) result.push_back(line);
    std::sort(result.begin(), result.end());
    return result;
  }
};

TEST(ExamRun, GoesOnWhereACommandFailed) {
  const ExamFolder folder(3);
  const std::string command = R"(case {world} in *2) if test ! -f mended; then echo broken >&2; exit 65; fi;; esac; )";
  Outcome sat = folder.run(command + silent);
  EXPECT_EQ(sat.exit, 1) << sat.err;
  EXPECT_EQ(sat.out, "3 cases run, 0 had a report, 1 failed\ncase_0002: exit code 65: broken\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "exam/reports/case_0002.txt"));
  EXPECT_THAT(folder.read("exam/reports/costs.csv"), testing::MatchesRegex("case,cpu.s.,memory.MB.,code\n"
                                                                           "case_0001,[0-9.]+,[0-9]+,0\n"
                                                                           "case_0002,[0-9.]+,[0-9]+,65\n"
                                                                           "case_0003,[0-9.]+,[0-9]+,0\n"));
  folder.write("mended", "");
  sat = folder.run(command + silent, {"--jobs", "2"});
  EXPECT_EQ(sat.exit, 0) << sat.err;
  EXPECT_EQ(sat.out, "1 case run, 2 had a report, 0 failed\n");
  EXPECT_EQ(sat.err, "");
  // A report that is gone is made again; one that was there before the table stays.
  std::filesystem::remove(folder / "exam/reports/case_0003.txt");
  folder.write("exam/case_0004/measured.csv", "one more\n");
  folder.write("exam/reports/case_0004.txt", "by hand\n");
  sat = folder.run(command + silent);
  EXPECT_EQ(sat.out, "1 case run, 3 had a report, 0 failed\n");
  EXPECT_EQ(folder.read("exam/reports/case_0004.txt"), "by hand\n");
}

// A case that failed is mended, and its report is of what it is now. One that is gone is no case, and no failure.
TEST(ExamRun, KnowsCasesAsTheyAre) {
  const ExamFolder folder(2);
  const std::string command = "grep -v broken {data}";
  folder.write("exam/case_0002/measured.csv", "broken\n");
  EXPECT_EQ(folder.run(command).exit, 1);
  folder.write("exam/case_0002/measured.csv", "mended\n");
  for (int k = 0; k < 2; ++k) {
    const Outcome sat = folder.run(command);
    EXPECT_EQ(sat.exit, 0) << sat.err;
    EXPECT_EQ(sat.err, "");
  }
  std::filesystem::remove_all(folder / "exam/case_0001");
  std::filesystem::remove_all(folder / "exam/reports/case_0001.txt");
  const Outcome sat = folder.run(command);
  EXPECT_EQ(sat.out, "0 cases run, 1 had a report, 0 failed\n") << sat.err;
  // Without its reports another command's are the first.
  std::filesystem::remove(folder / "exam/reports/case_0002.txt");
  for (int k = 0; k < 2; ++k) EXPECT_EQ(folder.run("cat {data}").err, "");
}

// Whoever had failed cases done again by two commands had one of them done twice.
TEST(ExamRun, CommandsShareWhatFailed) {
  const ExamFolder folder(4);
  EXPECT_EQ(folder.run("false").exit, 1);
  std::vector<Outcome> sat(2);
  std::vector<std::thread> commands;
  for (Outcome& each : sat)
    commands.emplace_back([&] { each = folder.run("sleep 0.3; echo {world} >> ends; " + std::string(silent)); });
  for (std::thread& each : commands) each.join();
  for (const Outcome& each : sat) EXPECT_TRUE(each.exit == 0 || each.exit == 1) << each.err;
  EXPECT_EQ(folder.lines("ends").size(), 4u);
}

TEST(ExamRun, MixesNoReportsOfOtherCases) {
  const ExamFolder folder(2);
  ASSERT_EQ(folder.run(silent).exit, 0);
  const Outcome other = folder.run("cat {data}");
  EXPECT_EQ(other.exit, 0);
  EXPECT_EQ(other.err,
            std::string("muster: note: exam/reports: reports of another command are there: ") + silent + "\n");
  folder.write("exam/case_0002/measured.csv", "another\n");
  expect_error(folder.run(silent), 2,
               "exam/case_0002: is not what it was when exam/reports/case_0002.txt was made of it; expected another "
               "folder for the reports (--reports)");
  EXPECT_EQ(folder.run("cat {data}", {"--reports", "others"}).exit, 0);
  EXPECT_EQ(folder.read("others/case_0002.txt"), "another\n");
}

// Ends of cases are told in a file that all of them write to.
const std::string slow = "sleep 0.3; echo {world} >> ends; ";

TEST(ExamRun, AKilledRunGoesOnAndDoesNoCaseTwice) {
  const ExamFolder folder(6);
  const auto killed_when = [&](std::size_t ends) {
    Surroundings around;
    around.wrapper = {"/bin/sh", "-c", "echo begun; exec \"$0\" \"$@\""};
    around.meanwhile = [&](int process) {
      for (int k = 0; k < 2000 && (!std::filesystem::exists(folder / "ends") || folder.lines("ends").size() < ends);
           ++k)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ::kill(process, SIGKILL);
    };
    EXPECT_EQ(folder.run(slow + silent, {"--jobs", "2"}, around).exit, 128 + SIGKILL);
  };
  killed_when(1);
  killed_when(3);
  const Outcome sat = folder.run(slow + silent);
  EXPECT_EQ(sat.exit, 0) << sat.err;
  EXPECT_THAT(sat.out, HasSubstr(" 0 failed"));
  const auto ends = folder.lines("ends");
  for (int i = 1; i <= 6; ++i) {
    EXPECT_TRUE(std::filesystem::exists(folder / ("exam/reports/case_000" + std::to_string(i) + ".txt"))) << i;
    // An end that was told just before the kill may have lost its report.
    const auto told = std::count(ends.begin(), ends.end(), ExamFolder::name(i));
    EXPECT_GE(told, 1) << i;
    EXPECT_LE(told, 2) << i;
  }
  EXPECT_LE(ends.size(), 6u + 4u) << "two kills of two workers each";
}

TEST(ExamRun, CommandsShareAnExam) {
  const ExamFolder folder(6);
  std::vector<Outcome> sat(2);
  std::vector<std::thread> commands;
  for (Outcome& each : sat) commands.emplace_back([&] { each = folder.run(slow + silent); });
  for (std::thread& each : commands) each.join();
  // Whoever ends first finds the other's last case to be done still.
  for (const Outcome& each : sat) EXPECT_TRUE(each.exit == 0 || each.exit == 1) << each.err;
  const auto ends = folder.lines("ends");
  ASSERT_EQ(ends.size(), 6u);
  for (int i = 1; i <= 6; ++i) EXPECT_EQ(ends[static_cast<std::size_t>(i - 1)], ExamFolder::name(i));
}

// A slot's name in a folder's is none: what stands there would be read by the shell.
TEST(ExamRun, RunsNoNameOfACase) {
  const ProgramFolder folder;
  const std::string odd = "case_{data}$(touch touched)";
  folder.write("exam/" + odd + "/measured.csv", "");
  const Outcome ran = folder.muster({"exam", "run", "exam", "--command", "printf %s {world}"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "touched"));
  EXPECT_EQ(folder.read("exam/reports/" + odd + ".txt"), "exam/" + odd);
}

// The script of docs/how-to/bring_your_own_exam.md, as a reader would copy it.
std::string example() {
  const std::string page = contents(std::filesystem::path(MUSTER_SOURCE_DIR) / "docs/how-to/bring_your_own_exam.md");
  const std::size_t from = page.find("```sh\n") + 6;
  return page.substr(from, page.find("```", from) - from);
}

TEST(ExamRun, TakesCasesOfAnybodysGenerator) {
  const ProgramFolder folder;
  folder.write("rooms.sh", example());
  // Stands in for a diagnosis: it names what the first case hides, and is silent on all others.
  const std::vector<std::string> words{
      "exam",
      "run",
      "exam",
      "--generator",
      "sh rooms.sh",
      "--seed",
      "4",
      "--cases",
      "2",
      "--command",
      R"(case {world} in *1) echo '{"verdict":"extended","causes":[{"id":"effect.tx_offset","label":"radio/a"}]}';; *) echo '{"verdict":"adequate"}';; esac)"};
  Outcome sat = folder.muster(words);
  EXPECT_EQ(sat.out, "case_0001: made\ncase_0002: made\n2 cases run, 0 had a report, 0 failed\n") << sat.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "exam/case_0001/answer.json"));
  const std::string first = folder.read("exam/case_0001/measured.csv");
  EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 601);
  const Outcome graded = folder.muster({"exam", "grade", "--table", "--answers", "exam"});
  EXPECT_THAT(graded.out, HasSubstr("| top name right, lambda >= 50 | 1/1"));
  EXPECT_THAT(graded.out, HasSubstr("| false name on clean worlds | 0/1"));
  // What is there stays.
  sat = folder.muster(words);
  EXPECT_EQ(sat.out, "0 cases run, 2 had a report, 0 failed\n") << sat.err;
  EXPECT_EQ(folder.read("exam/case_0001/measured.csv"), first);
}

TEST(ExamRun, SaysWhatIsWrong) {
  const ExamFolder folder(1);
  EXPECT_EQ(folder.muster({"exam", "run"}).exit, 2);
  EXPECT_THAT(folder.run(silent, {"--seed", "1"}).err, HasSubstr("--seed has no effect without --generator"));
  EXPECT_THAT(folder.run(silent, {"--job", "1"}).err, HasSubstr("--jobs"));
  expect_error(folder.muster({"exam", "run", "nowhere"}), 2,
               "nowhere: there is no such folder; expected one that muster exam make wrote");
  folder.write("empty/x", "");
  expect_error(folder.muster({"exam", "run", "empty"}), 2,
               "empty: has no folder case_...; expected one that muster exam make wrote");
}

}  // namespace
}  // namespace muster::test
