// The program at its command line.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "command.hpp"

namespace {

namespace fs = std::filesystem;

using muster::exam::Outcome;

Outcome run(const std::string& arguments) {
  return muster::exam::run_command(std::string(MUSTER_EXAM) + " " + arguments);
}

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class Program : public testing::Test {
 protected:
  Program() { fs::remove_all(folder); }
  ~Program() override { fs::remove_all(folder); }
  const fs::path folder = fs::temp_directory_path() / ("muster_exam_test_" + std::to_string(getpid()));
};

TEST_F(Program, MakesCasesAndGradesThem) {
  const std::string out = folder / "exam";
  ASSERT_EQ(run("make --seed 3 --cases 3 --rows 400 600 --mix one,clean --out " + out).code, 0);
  for (const char* file : {"case_0001/world.xml", "case_0002/walls.csv", "case_0003/measured.csv",
                           "case_0001/second.csv", "answers/case_0002.json"})
    EXPECT_GT(fs::file_size(folder / "exam" / file), 100u) << file;
  ASSERT_EQ(run("make --seed 3 --first 3 --cases 1 --rows 400 600 --mix one,clean --out " + out + "_third").code, 0);
  EXPECT_EQ(read(folder / "exam/case_0003/measured.csv"), read(folder / "exam_third/case_0003/measured.csv"));
  fs::create_directories(folder / "reports/case_0002");
  const std::string silent = "{\"verdict\":\"adequate\",\"causes\":[],\"unexplained\":[]}\n";
  std::ofstream(folder / "reports/case_0001.json") << silent;
  std::ofstream(folder / "reports/case_0002/diagnosis.json") << silent;
  const Outcome graded = run("grade --json --answers " + out + " --reports " + (folder / "reports").string());
  EXPECT_EQ(graded.code, 1) << graded.text;  // one report is missing
  EXPECT_NE(graded.text.find("\"missing\":[\"case_0003\"]"), std::string::npos) << graded.text;
}

TEST_F(Program, RunsACommandOverTheCasesAndGoesOnWhereItWasStopped) {
  const std::string out = folder / "exam";
  ASSERT_EQ(run("make --seed 3 --cases 3 --rows 400 600 --mix clean --out " + out).code, 0);
  // Fails on the second case: it leaves no report, and the next run has only that one to do.
  const std::string command =
      R"( --command "test -f {data} && case {world} in *2) echo broken >&2; exit 65;; esac; echo '{\"verdict\":\"adequate\"}'")";
  Outcome sat = run("run " + out + command);
  EXPECT_EQ(sat.code, 1);
  EXPECT_EQ(sat.text, "3 cases run, 0 had a report, 1 failed\ncase_0002: exit code 65: broken\n");
  EXPECT_EQ(read(folder / "exam/reports/case_0001.txt"), "{\"verdict\":\"adequate\"}\n");
  sat = run("run " + out + R"( --jobs 2 --command "echo '{\"verdict\":\"adequate\"}'")");
  EXPECT_EQ(sat.text, "1 cases run, 2 had a report, 0 failed\n");
  const Outcome graded = run("grade --table --answers " + out);
  EXPECT_EQ(graded.code, 0);
  EXPECT_NE(graded.text.find("| false name on clean worlds | 0/3 = 0 % [0.0, 70.8] | <= 0.7 % | reached |"),
            std::string::npos)
      << graded.text;
  EXPECT_EQ(run("run").code, 2);
}

// A slot's name in a folder's is none: what stands there would be read by the shell.
TEST_F(Program, RunsNoNameOfACase) {
  const std::string odd = "case_{data}$(touch exam_touched)";
  fs::create_directories(folder / "exam" / odd);
  const Outcome ran = run("run " + (folder / "exam").string() + " --command \"printf %s {world}\"");
  EXPECT_EQ(ran.code, 0) << ran.text;
  EXPECT_FALSE(fs::exists("exam_touched"));
  EXPECT_EQ(read(folder / "exam/reports" / (odd + ".txt")), (folder / "exam" / odd).string());
}

// The script of docs/how-to/bring_your_own_exam.md, as a reader would copy it.
std::string example() {
  const std::string page = read(fs::path(MUSTER_SOURCE_DIR) / "docs/how-to/bring_your_own_exam.md");
  const std::size_t from = page.find("```sh\n") + 6;
  return page.substr(from, page.find("```", from) - from);
}

TEST_F(Program, TakesCasesOfAnybodysGenerator) {
  fs::create_directories(folder);
  std::ofstream(folder / "rooms.sh") << example();
  const std::string generator = " --generator 'sh " + (folder / "rooms.sh").string() + "' --seed 4 --cases 2",
                    out = folder / "exam";
  // Stands in for a diagnosis: it names what the first case hides, and is silent on all others.
  const std::string command =
      R"( --command "case {world} in *1) echo '{\"verdict\":\"extended\",\"causes\":[{\"id\":\"effect.tx_offset\",\"label\":\"radio/a\"}]}';; *) echo '{\"verdict\":\"adequate\"}';; esac")";
  Outcome sat = run("run " + out + generator + command);
  EXPECT_EQ(sat.text, "case_0001: made\ncase_0002: made\n2 cases run, 0 had a report, 0 failed\n");
  EXPECT_FALSE(fs::exists(folder / "exam/case_0001/answer.json"));
  const std::string first = read(folder / "exam/case_0001/measured.csv");
  EXPECT_EQ(std::count(first.begin(), first.end(), '\n'), 601);
  const Outcome graded = run("grade --table --answers " + out);
  EXPECT_NE(graded.text.find("| top name right, lambda >= 50 | 1/1"), std::string::npos) << graded.text;
  EXPECT_NE(graded.text.find("| false name on clean worlds | 0/1"), std::string::npos) << graded.text;
  // What is there stays.
  sat = run("run " + out + generator + command);
  EXPECT_EQ(sat.text, "0 cases run, 2 had a report, 0 failed\n");
  EXPECT_EQ(read(folder / "exam/case_0001/measured.csv"), first);
}

TEST_F(Program, SaysWhatAForeignGeneratorLacks) {
  const std::string out = folder / "exam";
  EXPECT_NE(run("make --generator 'exit 3;' --seed 1 --cases 1 --out " + out).text.find("failed with exit code 3"),
            std::string::npos);
  EXPECT_EQ(run("make --generator 'true' --seed 1 --cases 1 --out " + out).text,
            "muster_exam make: " + out + "/case_0001: the generator wrote no world.xml\n");
  EXPECT_EQ(run("run " + out + " --seed 1").text, "muster_exam run: --seed needs --generator\n");
  EXPECT_EQ(run("run " + out + " --seed 1 --cases 3").text, "muster_exam run: --cases and --seed need --generator\n");
}

TEST_F(Program, MakesCampaignsOfTheField) {
  const std::string out = folder / "exam";
  const Outcome made = run("make --generator field --style flat --mix one --seed 2 --cases 1 --out " + out);
  ASSERT_EQ(made.code, 0) << made.text;
  for (const char* file : {"case_0001/world.xml", "case_0001/measured.csv", "answers/case_0001.json"})
    EXPECT_GT(fs::file_size(folder / "exam" / file), 500u) << file;
  std::ofstream(folder / "plan.csv")
      << "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],tx_yaw[rad],rx_x[m],rx_y[m],rx_z[m],rx_yaw[rad]\n"
         "0,anchor1,rover,1,1,1,0,2,2,1,0\n";
  EXPECT_EQ(run("follow " + out + "/answers/case_0001.json --plan " + (folder / "plan.csv").string() + " --out x").text,
            "muster_exam follow: " + out +
                "/answers/case_0001.json: a case of the generator field; only those of drawn can be followed\n");
  EXPECT_EQ(run("make --generator field --style house --seed 2 --cases 1 --out x").text,
            "muster_exam make: --style: a style is flat, mesh, walk, drive, not \"house\"\n");
  EXPECT_EQ(run("make --generator field --rows 20 30 --seed 2 --cases 1 --out x").code, 2);
}

TEST_F(Program, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(run("make --seed 3 --cases 1").code, 2);
  EXPECT_EQ(run("make --seed 3 --cases 1 --out x --mix some").text,
            "muster_exam make: --mix: a kind is clean, one, two, three, outside or each, not \"some\"\n");
  EXPECT_EQ(run("make --seed 3 --cases 1 --out x --effects ghost").code, 2);
  EXPECT_EQ(run("make --seed 3 --cases 1 --out x --effects effect.step").text,
            "muster_exam make: no effect is called \"effect.step\"; did you mean \"step\"? muster_exam effects lists "
            "them\n");
  EXPECT_EQ(run("make --seed 3 --cases 1 --out x --mix clean --effects step").text,
            "muster_exam make: --effects has no effect with --mix clean, whose cases hide none; expected --mix one "
            "beside it, or no --effects\n");
  EXPECT_EQ(run("make --seed 3x --cases 1 --out x").code, 2);
  EXPECT_EQ(run("make --seed 3 --cases 1 --out x --lambda 1,2,3").text,
            "muster_exam make: --lambda needs a number, or the least and the most as L,M\n");
  EXPECT_EQ(run("make --seed 3 --cases 1 --out x --lambda 60,50").code, 2);
  EXPECT_EQ(run("make --help").text, run("--help").text);
  EXPECT_EQ(run("make --seed 3 --cases 1 --out x --depth 2").text,
            "muster_exam make: there is no option --depth; expected one of --cases, --effects, --first, --generator, "
            "--lambda, "
            "--mix, --out, --rows, --seed, --size, --style, --walls\n");
  EXPECT_EQ(run("grade exam").text, "muster_exam grade: \"exam\" is one word too many; did you mean --answers exam?\n");
  EXPECT_EQ(run("make --seed 7 --cases 1 --rows 2000 --out ex").text,
            "muster_exam make: --rows needs the most behind the least: --rows 2000 2000\n");
  EXPECT_EQ(run("grade --answers /nowhere --reports /nowhere").code, 2);
}

}  // namespace
