// The manual page and what bash completes have all that the verbs declare.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

std::vector<std::string> verbs() {
  std::vector<std::string> result;
  std::istringstream lines(run_muster({"--help"}).out);
  const std::regex row("^  ([a-z-]+) .*");
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, found, row)) result.push_back(found[1]);
  }
  return result;
}

// Options that a verb's own help names at the beginning of a line.
std::set<std::string> options_of(const std::string& verb) {
  std::set<std::string> result;
  std::istringstream lines(run_muster({verb, "--help"}).out);
  const std::regex row("^  (?:-[a-z],)?(--[a-z-]+).*");
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, found, row)) result.insert(found[1]);
  }
  return result;
}

// An option, and not the beginning or the end of a longer one.
auto has_word(const std::string& option) { return testing::ContainsRegex("(^|[^a-z-])" + option + "([^a-z-]|$)"); }

// What bash offers for the last word.
std::string completed(const std::vector<std::string>& words) {
  Surroundings around;
  around.wrapper = {"bash", "-c",
                    "source <(\"$0\" --completion bash); COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _muster; "
                    "echo \"${COMPREPLY[*]}\""};
  const auto outcome = run_muster(words, around);
  EXPECT_EQ(outcome.err, "");
  return outcome.out;
}

TEST(ManualPage, HasEveryVerbAndOption) {
  const auto outcome = run_muster({"--man"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const std::string page = std::regex_replace(outcome.out, std::regex("\\\\-"), "-");
  const auto all = verbs();
  ASSERT_GE(all.size(), 22u);
  std::size_t options = 0;
  for (const auto& verb : all) {
    SCOPED_TRACE(verb);
    const auto begin = page.find(".SH MUSTER " + verb + "\n");
    ASSERT_NE(begin, page.npos);
    const std::string section = page.substr(begin, page.find("\n.SH ", begin) - begin);
    const auto own = options_of(verb);
    for (const auto& option : own) EXPECT_THAT(section, has_word(option));
    options += own.size();
  }
  EXPECT_GE(options, 80u);
}

TEST(Completion, OffersVerbsOptionsAndChoices) {
  EXPECT_EQ(completed({"muster", "pro"}), "probe\n");
  EXPECT_EQ(completed({"muster", "run", "--wor"}), "--workers\n");
  EXPECT_EQ(completed({"muster", "new", "c"}), "cause controller\n");
  EXPECT_EQ(completed({"muster", "fit", "world", "--average", ""}), "dB power\n");
  EXPECT_EQ(completed({"muster", "exam", "m"}), "make\n");
  EXPECT_EQ(completed({"muster", "exam", "make", "--la"}), "--lambda\n");
}

TEST(Completion, OffersFilesElsewhere) {
  const ProgramFolder folder;
  folder.write("office.xml", "");
  Surroundings around;
  around.wrapper = {"bash", "-c",
                    "source <(\"$0\" --completion bash); COMP_WORDS=(muster run off); COMP_CWORD=2; _muster; "
                    "echo \"${COMPREPLY[*]}\""};
  EXPECT_EQ(folder.muster({}, around).out, "office.xml\n");
}

TEST(Completion, HasEveryOptionOfEveryVerb) {
  const auto all = verbs();
  ASSERT_GE(all.size(), 22u);
  for (const auto& verb : all) {
    if (verb == "exam") continue;  // its help groups them
    const std::string offered = completed({"muster", verb, "--"});
    for (const auto& option : options_of(verb)) EXPECT_THAT(offered, has_word(option)) << verb;
  }
}

TEST(Completion, AnotherShellIsRefused) {
  expect_error(run_muster({"--completion", "fish"}), 2, "--completion: there is no \"fish\"; expected one shell, bash");
  expect_error(run_muster({"--completion"}), 2, "--completion: expected one shell, bash");
}

}  // namespace
}  // namespace muster::test
