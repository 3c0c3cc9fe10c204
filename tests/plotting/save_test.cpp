#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "plotting/figure.hpp"
#include "plotting/raster.hpp"

namespace muster::plotting {
namespace {

namespace fs = std::filesystem;

class Save : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("muster_picture_" + std::to_string(::getpid()));
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
  static std::string content(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
    return names;
  }

  fs::path folder;
  Figure figure{.title = "new", .panels = {{.layers = {Points{.x = {1}, .y = {2}}}}}};
};

TEST_F(Save, WritesThePictureAndNothingElse) {
  save(figure, folder / "a.svg");
  EXPECT_EQ(content(folder / "a.svg"), svg(figure));
  EXPECT_THAT(files(), testing::ElementsAre("a.svg"));
}

// A range without extent was divided by.
TEST_F(Save, ARasterOfOneValueHasTheMiddleOfTheColours) {
  save_png({-50, -50}, 2, {-50, -50}, Map::viridis, 1, folder / "one.png");
  save_png({0.5, 0.5}, 2, {0, 1}, Map::viridis, 1, folder / "middle.png");
  EXPECT_EQ(content(folder / "one.png"), content(folder / "middle.png"));
}

// Renamed, not overwritten: a reader of the old picture keeps all of it.
TEST_F(Save, ReplacesAPictureInOneStep) {
  const fs::path file = folder / "a.svg";
  std::ofstream(file) << "old";
  std::ifstream reader(file);
  save(figure, file);
  std::string seen;
  reader >> seen;
  EXPECT_EQ(seen, "old");
  EXPECT_EQ(content(file), svg(figure));
  EXPECT_THAT(files(), testing::ElementsAre("a.svg"));
}

TEST_F(Save, NamesTheFileThatItCannotWrite) {
  const fs::path file = folder / "none" / "a.svg";
  try {
    save(figure, file);
    FAIL();
  } catch (const fs::filesystem_error& e) {
    EXPECT_EQ(e.path1(), file);
    EXPECT_EQ(e.code(), std::errc::no_such_file_or_directory);
    EXPECT_THAT(e.what(), testing::HasSubstr("cannot write the picture"));
  }
}

TEST_F(Save, LeavesNoRemainsWhereItFails) {
  fs::create_directories(folder / "a.svg" / "full");  // a folder that is not empty cannot be replaced
  EXPECT_THROW(save(figure, folder / "a.svg"), std::runtime_error);
  EXPECT_THAT(files(), testing::ElementsAre("a.svg"));
}

TEST_F(Save, KeepsTheOldPictureWhenTheNewOneIsRefused) {
  std::ofstream(folder / "a.svg") << "old";
  figure.panels[0].layers = {Line{.x = {1, 2}, .y = {1}}};
  EXPECT_THROW(save(figure, folder / "a.svg"), std::invalid_argument);
  EXPECT_EQ(content(folder / "a.svg"), "old");
  EXPECT_THAT(files(), testing::ElementsAre("a.svg"));
}

}  // namespace
}  // namespace muster::plotting
