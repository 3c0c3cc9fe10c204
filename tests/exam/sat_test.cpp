// Exams of the generators field and run, made, diagnosed by the program, and graded.
#include <gtest/gtest.h>

#include <regex>

#include "command.hpp"
#include "tests/folder.hpp"

namespace muster::exam {
namespace {

// The table of grades; every case must have got a report.
std::string sat(const std::string& options) {
  const test::Folder folder;
  const std::string exam = (folder / "exam").string();
  const Outcome run = run_command(std::string(MUSTER_PROGRAM) + " exam run " + exam + " " + options + " --command '" +
                                  MUSTER_PROGRAM + " diagnose {world} --data {data} --json'");
  EXPECT_EQ(run.code, 0) << run.text;
  const Outcome graded = run_command(std::string(MUSTER_EXAM) + " grade --table --answers " + exam);
  EXPECT_EQ(graded.code, 0) << graded.text;
  return graded.text;
}

TEST(Sat, AFlatWithoutItsWallIsNotAdequate) {
  const std::string table = sat("--generator field --style flat --mix one --seed 5 --cases 3");
  EXPECT_NE(table.find("| adequate beside an effect of lambda >= 100 | 0/3"), std::string::npos) << table;
  EXPECT_NE(table.find("| unmapped_wall / lambda >= 50 |"), std::string::npos) << table;
}

TEST(Sat, WorldsOfTheSimulatorAreGraded) {
  const std::string clean = sat("--generator run --mix clean --rows 1000 1500 --seed 5 --cases 2");
  EXPECT_TRUE(std::regex_search(clean, std::regex(R"(\| false name on clean worlds \| [0-2]/2 = )"))) << clean;
  const std::string planted =
      sat("--generator run --mix one --effects tx_offset --lambda 300 --rows 1000 1500 --seed 5 --cases 2");
  EXPECT_NE(planted.find("| tx_offset / lambda >= 50 | "), std::string::npos) << planted;
}

}  // namespace
}  // namespace muster::exam
