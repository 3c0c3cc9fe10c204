// Verbs that look at worlds and plugins run cleanly on all of them; and the kernel names none of them.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <cstdio>
#include <regex>
#include <sstream>

#include "tests/cli/errors/program.hpp"
#include "world_runs.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Outcome expect_clean(const std::vector<std::string>& words) {
  auto outcome = run_muster(words);
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  return outcome;
}

class EveryWorldsVerbs : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Verbs, EveryWorldsVerbs, testing::ValuesIn(worlds()), test_name);

TEST_P(EveryWorldsVerbs, CheckAndGraph) {
  const std::string folder = place_of(GetParam());
  EXPECT_THAT(expect_clean({"check", folder}).out, HasSubstr("nothing is wrong"));
  EXPECT_THAT(expect_clean({"check", folder, "--json"}).out, StartsWith("{"));
  EXPECT_THAT(expect_clean({"graph", folder}).out, HasSubstr("at once:"));
  EXPECT_THAT(expect_clean({"graph", folder, "--dot"}).out, StartsWith("digraph muster {"));
  EXPECT_THAT(expect_clean({"graph", folder, "--json"}).out, StartsWith("["));
}

TEST_P(EveryWorldsVerbs, CompareFindsNoDifferenceBetweenAWorldAndItself) {
  const std::string folder = place_of(GetParam());
  const World world = read_world(folder, standard());
  const auto until = fmt::format("{}", static_cast<double>(std::min(world.ticks, most_ticks)) * world.dt);
  EXPECT_THAT(expect_clean({"compare", folder, folder, "--until", until}).out,
              HasSubstr("B against A: no difference, to t = "));
}

TEST(Plugins, AreAllListedAndDescribed) {
  std::istringstream list(expect_clean({"plugins"}).out);
  int count = 0;
  for (std::string line; std::getline(list, line); ++count) {
    ASSERT_THAT(line, testing::Not(StartsWith("-"))) << "a file on the plugin path cannot be loaded";
    const std::string id = line.substr(0, line.find(' '));
    EXPECT_THAT(expect_clean({"describe", id.substr(0, id.find('/'))}).out, HasSubstr(id));
    EXPECT_THAT(expect_clean({"describe", id, "--json"}).out, HasSubstr('"' + id + '"'));
  }
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(MUSTER_PLUGINS_DIR))
    files += entry.path().extension() == ".so";
  EXPECT_EQ(count, files);
}

TEST(Elements, AreAllDescribed) {
  for (const auto& element : standard().elements) {
    const std::string out = expect_clean({"describe", element.name}).out;
    for (const auto& attribute : element.attributes) {
      EXPECT_THAT(out, HasSubstr(std::string("    ") + attribute.param.name + ' ')) << element.name;
      EXPECT_THAT(out, HasSubstr(attribute.param.help)) << element.name;
    }
    EXPECT_THAT(expect_clean({"describe", element.name, "--json"}).out, StartsWith("{"));
  }
}

// Row 29 of the requirements.
TEST(Verbs, RunSaysHowFastItWent) {
  const std::string out = expect_clean({"run", place_of("connectivity/lasers.xml"), "--until", "1"}).out;
  EXPECT_TRUE(std::regex_search(out, std::regex("\n  [0-9.]+ times real time\n"))) << out;
}

TEST(Verbs, EachHasHelpWithAnExample) {
  const std::string usage = expect_clean({"--help"}).out;
  const std::regex verb("\n  ([a-z-]+) +");
  int count = 0;
  for (std::sregex_iterator it(usage.begin(), usage.end(), verb), end; it != end; ++it, ++count)
    EXPECT_THAT(expect_clean({(*it)[1], "--help"}).out, HasSubstr("Example: muster " + (*it)[1].str()));
  EXPECT_GE(count, 9);
}

TEST(Kernel, NamesNoPhysicsNoRadioAndNoRobot) {
  std::FILE* pipe = ::popen("nm --demangle " MUSTER_KERNEL_LIBRARY " 2>/dev/null", "r");
  ASSERT_NE(pipe, nullptr);
  std::string line;
  int lines = 0, named = 0;
  const std::regex foreign("simbody|simtk|physics|radio|robot|scarab|wall", std::regex::icase);
  for (int c; (c = std::fgetc(pipe)) != EOF;) {
    if (c != '\n') {
      line += static_cast<char>(c);
      continue;
    }
    ++lines, named += line.find("muster::") != line.npos;
    EXPECT_FALSE(std::regex_search(line, foreign)) << line;
    line.clear();
  }
  EXPECT_EQ(::pclose(pipe), 0);
  EXPECT_GT(named, 100) << "of " << lines << " lines: nm has not seen the kernel";
}

}  // namespace
}  // namespace muster::test
