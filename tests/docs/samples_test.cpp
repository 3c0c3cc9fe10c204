// The samples of plugin_api/README.md and of the tutorials: they are the files that the build compiles, they are as
// short as is said, and they run.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "kernel/simulation.hpp"

namespace muster {
namespace {

const std::filesystem::path source = MUSTER_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return (std::ostringstream() << in.rdbuf()).str();
}

// The fenced blocks that follow a line "`file`:", by file.
std::map<std::string, std::string> quoted_files(const std::string& markdown) {
  std::map<std::string, std::string> result;
  std::istringstream lines(markdown);
  std::string line, file;
  bool inside = false;
  while (std::getline(lines, line)) {
    const bool fence = line.rfind("```", 0) == 0;
    if (fence && inside) {
      inside = false;
      file.clear();
    } else if (fence && !file.empty()) {
      inside = true;
      result[file];
    } else if (inside) {
      result[file] += line + '\n';
    } else if (line.size() > 3 && line.front() == '`' && line.substr(line.size() - 2) == "`:") {
      file = line.substr(1, line.size() - 3);
    }
  }
  return result;
}

int lines_with_text(const std::string& text) {
  std::istringstream lines(text);
  int result = 0;
  for (std::string line; std::getline(lines, line);) result += line.find_first_not_of(" \t") != std::string::npos;
  return result;
}

// Pages that show samples whole.
std::vector<std::filesystem::path> pages() {
  std::vector<std::filesystem::path> result = {source / "plugin_api" / "README.md"};
  for (const char* folder : {"tutorials", "how-to"}) {
    for (const auto& entry : std::filesystem::directory_iterator(source / "docs" / folder))
      result.push_back(entry.path());
  }
  return result;
}

TEST(Samples, OfThePagesAreTheFilesThatAreBuilt) {
  std::set<std::string> shown;
  std::string all_pages;
  for (const auto& page : pages()) {
    const std::string text = text_of(page);
    all_pages += text;
    for (const auto& [file, quoted] : quoted_files(text)) {
      EXPECT_EQ(quoted, text_of(source / file)) << page << " shows " << file;
      shown.insert(file);
    }
  }
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source / "docs" / "samples")) {
    const std::string file = std::filesystem::relative(entry.path(), source);
    if (!entry.is_regular_file() || entry.path().filename().string().front() == '.') continue;
    // A table of data may be too long for a page.
    const bool table = entry.path().extension() == ".csv";
    EXPECT_TRUE(shown.count(file) || (table && all_pages.find(file) != all_pages.npos)) << "no page shows " << file;
  }
}

// Row 27 of the requirements.
TEST(Samples, ARadioTermTakes25LinesAControllerTakes20ACause40AndALaw50) {
  EXPECT_LE(lines_with_text(text_of(source / "docs/samples/radio_one_slope.cpp")), 25);
  EXPECT_LE(lines_with_text(text_of(source / "docs/samples/control_keep_in_touch.cpp")), 20);
  EXPECT_LE(lines_with_text(text_of(source / "docs/samples/cause_dipole.cpp")), 40);
  EXPECT_LE(lines_with_text(text_of(source / "docs/samples/cause_restless_gain.cpp")), 50);
}

Simulation readme_world() {
  Options options;
  options.search_path = {MUSTER_SAMPLES_DIR, MUSTER_PLUGINS_DIR};
  return Simulation(read_world(source / "docs/samples/world.xml", standard()), standard(), options);
}

double apart(const Simulation& world) {
  const TableView pose = world.table("robot/*/pose");
  return std::hypot(pose.at(0, 0) - pose.at(1, 0), pose.at(0, 1) - pose.at(1, 1), pose.at(0, 2) - pose.at(1, 2));
}

// Level falls to the network's -65 dBm at 10 m, as -40 - 25 log10 d says. At 0.6 m/s away from each other the two are
// there after a little more than 3 s; then nothing is heard, and they turn on the spot.
TEST(Samples, RunAsTheReadmeSays) {
  Simulation world = readme_world();
  while (world.time() < 2.5) world.step();
  EXPECT_LT(apart(world), 10);
  EXPECT_GT(apart(world), 9);
  EXPECT_NEAR(world.table("link/*/level").at(0, 0), -40 - 25 * std::log10(apart(world)), 1e-9);
  const TableView traffic = world.table("radio/east/traffic");
  EXPECT_EQ(traffic.at(0, 0), static_cast<double>(world.tick()));  // asked in every tick, and delivered
  EXPECT_EQ(traffic.at(0, 1), static_cast<double>(world.tick()));
  EXPECT_EQ(world.table("robot/east/command").at(0, 0), 0.3);
  while (world.time() < 6) world.step();
  EXPECT_NEAR(apart(world), 10, 0.1);
  EXPECT_EQ(world.table("robot/east/command").at(0, 0), 0);
  EXPECT_EQ(world.table("robot/east/command").at(0, 1), 0.5);
}

TEST(Samples, ParametersOfTheTermAreFreeToAFit) {
  Simulation world = readme_world();
  for (const char* path : {"radio.one_slope/l0", "radio.one_slope/n"}) {
    EXPECT_TRUE(world.parameter(path).declared->flags & MUSTER_FREE) << path;
  }
  world.set_parameter("radio.one_slope/l0", 30);
  world.step();
  EXPECT_NEAR(world.table("link/*/level").at(0, 0), -30 - 25 * std::log10(apart(world)), 1e-9);
}

}  // namespace
}  // namespace muster
