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

// Silence on a clean case is right. `make --keep` adds what is not there.
TEST_F(Program, GradesReportsBesideGoals) {
  const std::string out = folder / "exam", make = "make --seed 3 --rows 400 600 --mix clean --out " + out;
  ASSERT_EQ(run(make + " --cases 2").code, 0);
  const std::string second = read(folder / "exam/case_0002/measured.csv");
  fs::remove_all(folder / "exam/case_0001");
  const Outcome kept = run(make + " --cases 3 --keep");
  EXPECT_EQ(std::count(kept.text.begin(), kept.text.end(), '\n'), 1) << kept.text;
  EXPECT_FALSE(fs::exists(folder / "exam/case_0001")) << "its answer is there";
  EXPECT_EQ(read(folder / "exam/case_0002/measured.csv"), second);
  fs::create_directories(folder / "exam/reports");
  for (const char* name : {"case_0001", "case_0002", "case_0003"})
    std::ofstream(folder / "exam/reports" / (std::string(name) + ".txt")) << "{\"verdict\":\"adequate\"}\n";
  const Outcome graded = run("grade --table --answers " + out);
  EXPECT_EQ(graded.code, 0);
  EXPECT_NE(graded.text.find("| false name on clean worlds | 0/3 = 0 % [0.0, 70.8] | <= 0.7 % | reached |"),
            std::string::npos)
      << graded.text;
  fs::remove(folder / "exam/reports/case_0003.txt");
  const Outcome lacking = run("grade --table --answers " + out);
  EXPECT_NE(lacking.text.find("| false name on clean worlds | 0/2 = "), std::string::npos)
      << "without a report it is no hit: " << lacking.text;
  EXPECT_EQ(run("run exam").text, "muster_exam run: the program muster runs cases: muster exam run DIR\n");
}

TEST_F(Program, SaysWhatAForeignGeneratorLacks) {
  const std::string out = folder / "exam";
  EXPECT_NE(run("make --generator 'exit 3;' --seed 1 --cases 1 --out " + out).text.find("failed with exit code 3"),
            std::string::npos);
  EXPECT_EQ(run("make --generator 'true' --seed 1 --cases 1 --out " + out).text,
            "muster_exam make: " + out + "/case_0001: the generator wrote no world.xml\n");
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
            "--keep, --lambda, "
            "--mix, --out, --rows, --seed, --size, --style, --walls\n");
  EXPECT_EQ(run("grade exam").text, "muster_exam grade: \"exam\" is one word too many; did you mean --answers exam?\n");
  EXPECT_EQ(run("make --seed 7 --cases 1 --rows 2000 --out ex").text,
            "muster_exam make: --rows needs the most behind the least: --rows 2000 2000\n");
  EXPECT_EQ(run("make --seed 1 --cases 1 --seed 2 --out ex").text,
            "muster_exam make: --seed is given more than once; expected it once\n");
  EXPECT_EQ(run("grade --answers /nowhere --reports /nowhere").code, 2);
}

}  // namespace
