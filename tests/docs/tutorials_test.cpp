// Runs the commands of a tutorial and compares what they print with what the page shows: each block of `sh` that a
// block of `text` follows. In the page `...` on a line of its own is any number of lines, and inside a line any text.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/folder.hpp"

namespace muster::test {
namespace {

namespace fs = std::filesystem;

using Lines = std::vector<std::string>;

struct Example {
  int line = 0;  // of the page, where the commands begin
  std::string commands{};
  Lines expected{};
};

Lines lines_of(const std::string& text) {
  Lines result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

// Blocks of `sh`, each with the block of `text` that follows before any other; commands without one are run for what
// they write.
std::vector<Example> examples_of(const fs::path& page) {
  std::ifstream in(page);
  EXPECT_TRUE(in) << page;
  std::vector<Example> result;
  std::string kind;  // of the block around a line
  bool awaits_output = false;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const bool fence = line.rfind("```", 0) == 0;
    if (fence && !kind.empty()) {
      awaits_output = kind == "sh";
      kind.clear();
    } else if (fence) {
      kind = line.substr(3).empty() ? "plain" : line.substr(3);
      if (kind == "sh") result.push_back({number, {}, {}});
    } else if (kind == "sh") {
      result.back().commands += line + '\n';
    } else if (kind == "text" && awaits_output) {
      result.back().expected.push_back(line);
    }
  }
  return result;
}

// Whether a line fits a pattern in which `...` is any text.
bool fits(const std::string& pattern, const std::string& line) {
  const auto gap = pattern.find("...");
  if (gap == pattern.npos) return pattern == line;
  if (line.compare(0, gap, pattern, 0, gap) != 0) return false;
  const std::string rest = pattern.substr(gap + 3);
  for (std::size_t at = gap; at <= line.size(); ++at)
    if (fits(rest, line.substr(at))) return true;
  return false;
}

// Whether lines from `at` on fit the patterns from `first` on; `furthest` is the first pattern that no try got past.
bool fit(const Lines& patterns, std::size_t first, const Lines& lines, std::size_t at, std::size_t& furthest) {
  furthest = std::max(furthest, first);
  if (first == patterns.size()) return at == lines.size();
  if (patterns[first] == "...") {
    for (std::size_t next = at; next <= lines.size(); ++next)
      if (fit(patterns, first + 1, lines, next, furthest)) return true;
    return false;
  }
  return at < lines.size() && fits(patterns[first], lines[at]) && fit(patterns, first + 1, lines, at + 1, furthest);
}

// Lines but those by which a long diagnosis says how far it is: how long it takes is the machine's.
Lines without_progress(Lines lines) {
  static const std::regex progress("diagnose: .* \\([0-9]+ s\\)");
  std::erase_if(lines, [](const std::string& line) { return std::regex_match(line, progress); });
  return lines;
}

std::string output_of(const fs::path& folder, const std::string& commands) {
  std::ofstream(folder / "commands.sh") << commands;
  const std::string call = "cd '" + folder.string() + "' && sh commands.sh 2>&1 </dev/null";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(::popen(call.c_str(), "r"), ::pclose);
  std::string result;
  char bytes[4096];
  while (const auto got = std::fread(bytes, 1, sizeof bytes, pipe.get())) result.append(bytes, got);
  return result;
}

// Lines but those that say that the page of a run was written, or why not: a build without npm has no page.
Lines without_the_page(Lines lines) {
  lines.erase(std::remove_if(lines.begin(), lines.end(),
                             [](const std::string& line) { return line.find("run.html") != line.npos; }),
              lines.end());
  return lines;
}

class Tutorial : public testing::TestWithParam<std::string> {};

TEST_P(Tutorial, PrintsWhatThePageShows) {
  const fs::path source = MUSTER_SOURCE_DIR;
  // The root of the project as a reader has it after a build.
  const Folder root;
  for (const char* name : {"docs", "worlds"}) fs::create_directory_symlink(source / name, root.path() / name);
  fs::create_directories(root.path() / "build" / "samples");
  fs::create_directory_symlink(MUSTER_BUILD_DIR, root.path() / "build" / "release");
  fs::create_directory_symlink(MUSTER_SAMPLES_DIR, root.path() / "build" / "samples" / "plugins");

  const auto examples = examples_of(source / "docs" / "tutorials" / (GetParam() + ".md"));
  ASSERT_GE(examples.size(), 3u);
  for (const Example& example : examples) {
    if (example.commands.rfind("cmake ", 0) == 0) continue;  // Samples.BuildOnTheirOwn does that
    SCOPED_TRACE(GetParam() + ".md:" + std::to_string(example.line));
    const std::string out = output_of(root.path(), example.commands);
    std::size_t furthest = 0;
    const bool no_page = fs::exists(fs::path(MUSTER_BUILD_DIR) / "viewer" / "page.missing");
    const Lines all = without_progress(lines_of(out)),
                expected = no_page ? without_the_page(example.expected) : example.expected,
                printed = no_page ? without_the_page(all) : all;
    if (fit(expected, 0, printed, 0, furthest)) continue;
    ADD_FAILURE() << (furthest < expected.size() ? "missing: " + expected[furthest] : "more than is shown")
                  << "\nprinted:\n"
                  << out;
  }
}

Lines tutorials() {
  Lines result;
  std::istringstream names(MUSTER_TUTORIALS);
  for (std::string name; names >> name;) result.push_back(name);
  return result;
}

INSTANTIATE_TEST_SUITE_P(Docs, Tutorial, testing::ValuesIn(tutorials()), [](const auto& of) { return of.param; });

}  // namespace
}  // namespace muster::test
