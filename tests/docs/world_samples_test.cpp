// Every world that a page shows is one that the program takes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return (std::ostringstream() << in.rdbuf()).str();
}

// The fenced blocks of XML that hold a world; `line` is where each begins, `file` the sample that it shows, if any.
struct Sample {
  int line = 0;
  std::string file{};
  std::string text{};
};

std::vector<Sample> worlds_in(const fs::path& page) {
  std::vector<Sample> result;
  std::istringstream lines(text_of(page));
  bool inside = false;
  int number = 0;
  std::string file;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.size() > 3 && line.front() == '`' && line.ends_with("`:"))
      file = line.substr(1, line.size() - 3);
    else if (line == "```xml")
      result.push_back({number, std::exchange(file, {})}), inside = true;
    else if (line.rfind("```", 0) == 0)
      inside = false;
    else if (inside)
      result.back().text += line + '\n';
  }
  std::erase_if(result, [](const Sample& s) { return s.text.find("<world") == s.text.npos; });
  return result;
}

std::vector<fs::path> pages() {
  std::vector<fs::path> result;
  for (const char* folder :
       {"docs", "plugin_api", "plugins", "worlds", "scene", "description", "medium", "diagnosis", "exam", "peers"}) {
    if (!fs::exists(fs::path(MUSTER_SOURCE_DIR) / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(MUSTER_SOURCE_DIR) / folder)) {
      if (entry.path().extension() == ".md") result.push_back(entry.path());
    }
  }
  for (const char* page : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"})
    result.push_back(fs::path(MUSTER_SOURCE_DIR) / page);
  return result;
}

TEST(Pages, WorldsThatTheyShowAreFine) {
  int count = 0;
  for (const auto& page : pages()) {
    for (const auto& sample : worlds_in(page)) {
      SCOPED_TRACE(page.string() + ":" + std::to_string(sample.line));
      const ProgramFolder folder;
      folder.write("world.xml", sample.text);
      // A sample may refer to files beside it.
      const std::string world =
          sample.file.empty() ? "world.xml" : (fs::path(MUSTER_SOURCE_DIR) / sample.file).string();
      const auto outcome = folder.muster({"check", world, "--plugins", MUSTER_SAMPLES_DIR});
      EXPECT_EQ(outcome.exit, 0) << outcome.err;
      EXPECT_EQ(outcome.out.find("warning"), outcome.out.npos) << outcome.out;
      ++count;
    }
  }
  EXPECT_GE(count, 2) << "README.md and docs/reference/world_file.md show one each";
}

// A link to a file of the tree leads somewhere.
TEST(Pages, LinkToFilesThatAreThere) {
  int count = 0;
  for (const auto& page : pages()) {
    const std::string text = text_of(page);
    for (std::size_t at = text.find("]("); at != text.npos; at = text.find("](", at + 1)) {
      const std::string target = text.substr(at + 2, text.find_first_of(")#", at + 2) - at - 2);
      if (target.empty() || target.find("://") != target.npos || target.find_first_of(" \n`") != target.npos) continue;
      EXPECT_TRUE(fs::exists(page.parent_path() / target)) << page << " links to " << target;
      ++count;
    }
  }
  EXPECT_GE(count, 10);
}

}  // namespace
}  // namespace muster::test
