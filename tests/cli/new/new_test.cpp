// muster new: each kind is written whole under the name that is asked for, or refused in one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const fs::path templates = fs::path(MUSTER_SOURCE_DIR) / "templates";

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(New, EachKindIsWrittenWithoutTheNameOfItsSkeleton) {
  const ProgramFolder folder;
  int kinds = 0;
  for (const auto& entry : fs::directory_iterator(templates)) {
    if (!entry.is_directory()) continue;
    const std::string kind = entry.path().filename().string(), name = "my_" + kind;
    SCOPED_TRACE(kind);
    const auto outcome = folder.muster({"new", kind, name});
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("wrote " + name + ": CMakeLists.txt, README.md, "));
    EXPECT_EQ(files_in(folder.path() / name), files_in(entry.path()));
    for (const auto& file : fs::directory_iterator(folder.path() / name)) {
      EXPECT_THAT(file.path().filename().string(), Not(HasSubstr("skeleton")));
      EXPECT_THAT(contents(file.path()), Not(HasSubstr("keleton"))) << file.path();
    }
    ++kinds;
  }
  EXPECT_EQ(kinds, 6);
}

TEST(New, TheNameStandsInFilesIdsAndTypes) {
  const ProgramFolder folder;
  const auto outcome = folder.muster({"new", "radio", "range_loss2", "--in", "own/parts"});
  ASSERT_EQ(outcome.exit, 0) << outcome.err;
  const fs::path made = folder.path() / "own/parts/range_loss2";
  const std::string source = contents(made / "radio_range_loss2.cpp");
  EXPECT_THAT(source, HasSubstr("struct RangeLoss2Term {"));
  EXPECT_THAT(source, HasSubstr("id = \"radio.range_loss2/1\""));
  EXPECT_THAT(contents(made / "world.xml"), HasSubstr("<radio.range_loss2 "));
  EXPECT_THAT(contents(made / "CMakeLists.txt"), HasSubstr("muster_plugin(radio_range_loss2 radio_range_loss2.cpp)"));
  EXPECT_THAT(outcome.out, HasSubstr("next, in own/parts/range_loss2:\n  cmake -B build -D muster_DIR=" MUSTER_BUILD_DIR
                                     " && cmake --build build && ctest --test-dir build\n"));
}

TEST(New, AnUnknownKindIsRefusedWithTheNearestOne) {
  const ProgramFolder folder;
  expect_error(folder.muster({"new", "radoi", "mine"}), 2,
               "muster new: kind: there is no \"radoi\"; expected one of cause, controller, radio, robot, sensor, "
               "world; did you mean \"radio\"?; see muster new --help");
  EXPECT_FALSE(fs::exists(folder.path() / "mine"));
}

TEST(New, ANameThatHasItsKindAlready) {
  const ProgramFolder folder;
  for (const std::string name : {"control.follow", "control_follow", "controller.follow", "ControlFollow"})
    expect_error(
        folder.muster({"new", "controller", name}), 2,
        "\"" + name +
            "\" has its kind in it, which is put before the name; expected muster new controller follow, which "
            "makes control.follow");
  expect_error(folder.muster({"new", "radio", "radio.range_loss"}), 2,
               "\"radio.range_loss\" has its kind in it, which is put before the name; expected muster new radio "
               "range_loss, which makes radio.range_loss");
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(New, ANameThatNoPluginCanHaveIsRefusedWithTheNearestOne) {
  const ProgramFolder folder;
  const std::string expected =
      " is no name of a plugin; expected a small letter, then small letters, digits and _, at most 60 in all";
  const std::string long_name(61, 'a');
  for (const auto& [name, nearest] : std::vector<std::pair<std::string, std::string>>{
           {"My-Model", "my_model"},
           {"RangeLoss", "range_loss"},
           {"2nd", "nd"},
           {"../up", "up"},
           {"a b", "a_b"},
           {long_name, long_name.substr(1)},
       }) {
    SCOPED_TRACE(name);
    const std::string shown = name == long_name ? name.substr(0, 60) : name;
    const auto outcome = folder.muster({"new", "sensor", name});
    EXPECT_EQ(outcome.exit, 2);
    EXPECT_THAT(outcome.err, HasSubstr(expected + "; did you mean \"" + nearest + "\"?\n"));
    EXPECT_THAT(outcome.err, testing::StartsWith("muster: error: \"" + shown));
  }
  expect_error(folder.muster({"new", "sensor", "..."}), 2, "\"...\"" + expected);
  EXPECT_EQ(files_in(folder.path()), 0u);
}

TEST(New, ANameThatAPluginHasIsRefused) {
  const ProgramFolder folder;
  expect_error(folder.muster({"new", "radio", "multiwall"}), 2,
               "there is a plugin radio.multiwall already; expected a new name, such as \"multiwall_2\"");
  EXPECT_EQ(folder.muster({"new", "sensor", "multiwall"}).exit, 0) << "sensors.multiwall is another id";
}

TEST(New, AFolderThatIsThereStaysAsItIs) {
  const ProgramFolder folder;
  fs::create_directory(folder.path() / "mine");
  folder.write("mine/world.xml", "mine\n");
  expect_error(folder.muster({"new", "world", "mine"}), 2, "mine: exists already; expected a new folder");
  EXPECT_EQ(contents(folder.path() / "mine/world.xml"), "mine\n");
  EXPECT_EQ(files_in(folder.path() / "mine"), 1u);
}

}  // namespace
}  // namespace muster::test
