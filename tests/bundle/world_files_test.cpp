// Which files a world reads, and where they come to lie in its bundle.
#include "bundle/world_files.hpp"

#include <gmock/gmock.h>

#include "tests/folder.hpp"
#include "text/error.hpp"
#include "text/xml.hpp"

namespace muster::test {
namespace {

using namespace muster::bundle;
using testing::ElementsAre;

struct WorldFilesTest : testing::Test {
  WorldFiles files_of(const std::string& world, const std::string& file = "sites/office/world.xml") {
    return {folder.write(file, world), {folder / "plugins"}};
  }
  static std::vector<std::string> names(const WorldFiles& files) {
    std::vector<std::string> result;
    for (const auto& [name, file] : files.files()) result.push_back(name);
    return result;
  }
  std::string source(const WorldFiles& files, const std::string& name) const {
    return files.files().at(name).source.lexically_relative(folder.path()).string();
  }

  Folder folder;
};

TEST_F(WorldFilesTest, InsideTheWorldsFolderStayWhereTheyAre) {
  folder.write("sites/office/a/way.csv", "");
  folder.write("sites/office/b/way.csv", "");
  folder.write("sites/office/README.md", "");
  folder.write("sites/office/mission.xml", "<mission map=\"b/plan.csv\"/>");
  folder.write("sites/office/b/plan.csv", "");
  const auto files = files_of("<world><x path=\"a/way.csv\"/><x path='b/way.csv' mission=\"mission.xml\"/></world>");
  EXPECT_THAT(names(files), ElementsAre("world/office/a/way.csv", "world/office/b/plan.csv", "world/office/b/way.csv",
                                        "world/office/mission.xml", "world/office/world.xml"));
  for (const auto& [name, file] : files.files()) EXPECT_FALSE(file.text) << name;
}

TEST_F(WorldFilesTest, OutsideOfItAreNamedAnew) {
  folder.write("shared/walls.csv", "");
  folder.write("sites/shared/walls.csv", "");
  folder.write("sites/office/here.csv", "");
  const std::string absolute = folder.at("sites/office/here.csv");
  const auto files = files_of(
      "<world>\n <!-- \xC3\xBC --><walls note=\"\xC3\xBC&amp;\" file=\"../../shared/walls.csv\"/> <walls "
      "file='../shared/walls.csv'/>\n"
      " <x path=\"" +
      absolute + "\"/><y path=\"../../shared/none.csv\"/></world>");
  EXPECT_THAT(names(files), ElementsAre("world/office/here.csv", "world/office/outside/2/shared/walls.csv",
                                        "world/office/outside/shared/walls.csv", "world/office/world.xml"));
  EXPECT_EQ(source(files, "world/office/outside/shared/walls.csv"), "shared/walls.csv");
  EXPECT_EQ(source(files, "world/office/outside/2/shared/walls.csv"), "sites/shared/walls.csv");
  EXPECT_EQ(files.files().at("world/office/outside/2/shared/walls.csv").named, "../shared/walls.csv");
  EXPECT_EQ(files.files().at("world/office/world.xml").text,
            "<world>\n <!-- \xC3\xBC --><walls note=\"\xC3\xBC&amp;\" file=\"outside/shared/walls.csv\"/> <walls "
            "file='outside/2/shared/walls.csv'/>\n"
            " <x path=\"here.csv\"/><y path=\"../../shared/none.csv\"/></world>");
}

TEST_F(WorldFilesTest, GoToAFolderThatTheWorldHasNot) {
  folder.write("sites/office/outside/mine.csv", "");
  folder.write("sites/it's & more/walls.csv", "");
  const auto files = files_of("<world a=\"outside/mine.csv\" b='../it&apos;s &amp; more/walls.csv'/>");
  EXPECT_THAT(names(files), ElementsAre("world/office/outside/mine.csv", "world/office/outside_/it's & more/walls.csv",
                                        "world/office/world.xml"));
  const auto copy = read_xml(folder.write("copy.xml", *files.files().at("world/office/world.xml").text));
  EXPECT_EQ(copy.attribute("b")->value, "outside_/it's & more/walls.csv");
}

TEST_F(WorldFilesTest, OfRobotsAreFoundAsRobotsAre) {
  folder.write("plugins/models/scarab.urdf", "<robot name=\"s\"><mesh filename=\"laser.stl\"/></robot>");
  folder.write("plugins/models/laser.stl", "");
  folder.write("sites/office/scarab.urdf", "<robot/>");
  folder.write("sites/office/own.urdf", "<robot/>");
  folder.write("sites/office/fit.xml", "<robot/>");
  auto files = files_of("<world><robot/></world>");
  files.add_robot("scarab", "", "");
  files.add_robot("own", "", "fit.xml");
  files.add_robot("unknown", "", "");
  EXPECT_THAT(names(files), ElementsAre("plugins/models/laser.stl", "plugins/models/scarab.urdf",
                                        "world/office/fit.xml", "world/office/own.urdf", "world/office/world.xml"));
}

TEST_F(WorldFilesTest, OfPackagesKeepTheNamesOfTheirPackages) {
  const std::string mesh = "<robot name=\"r\"><mesh filename=\"package://arm/meshes/a.stl\"/></robot>";
  folder.write("ros/arm/meshes/a.stl", "");
  folder.write("ros/arm/meshes/other.stl", "");
  folder.write("ros/arm/urdf/arm.urdf", mesh);
  for (const std::string packages : {"../../ros", "../../ros/arm"}) {
    auto files =
        files_of("<world><robot packages=\"" + packages + "\" model=\"../../ros/arm/urdf/arm.urdf\"/></world>");
    files.add_robot("../../ros/arm/urdf/arm.urdf", packages, "");
    const std::string name =
        packages == "../../ros" ? "world/office/outside/ros/arm/meshes/a.stl" : "world/office/outside/arm/meshes/a.stl";
    EXPECT_THAT(names(files), ElementsAre(name, "world/office/outside/urdf/arm.urdf", "world/office/world.xml"));
    EXPECT_EQ(source(files, name), "ros/arm/meshes/a.stl");
    const std::string to = packages == "../../ros" ? "outside/ros" : "outside/arm";
    EXPECT_EQ(files.files().at("world/office/world.xml").text,
              "<world><robot packages=\"" + to + "\" model=\"outside/urdf/arm.urdf\"/></world>");
  }
  folder.write("sites/office/arm/meshes/a.stl", "");
  folder.write("sites/office/arm.urdf", mesh);
  auto files = files_of("<world><robot packages=\".\" model=\"arm.urdf\"/></world>");
  files.add_robot("arm.urdf", ".", "");
  EXPECT_THAT(names(files),
              ElementsAre("world/office/arm.urdf", "world/office/arm/meshes/a.stl", "world/office/world.xml"));
  EXPECT_FALSE(files.files().at("world/office/world.xml").text);
}

TEST_F(WorldFilesTest, OfMujocoLieInItsFolderOfMeshes) {
  folder.write("sites/office/arm.xml",
               "<mujoco><compiler meshdir=\"parts\"/><asset><mesh file=\"a.stl\"/></asset></mujoco>");
  folder.write("sites/office/parts/a.stl", "");
  auto files = files_of("<world><robot model=\"arm.xml\"/></world>");
  EXPECT_THAT(names(files), ElementsAre("world/office/arm.xml", "world/office/parts/a.stl", "world/office/world.xml"));
}

TEST_F(WorldFilesTest, OfDataAndPluginsAreAdded) {
  folder.write("sites/office/measured.csv", "");
  folder.write("lab/measured.csv", "");
  folder.write("plugins/radio_x.so", "");
  auto files = files_of("<world/>");
  files.add_data(folder / "sites/office/measured.csv");
  files.add_data(folder / "lab/measured.csv");
  files.add_plugin(folder / "plugins/radio_x.so");
  EXPECT_THAT(names(files), ElementsAre("plugins/radio_x.so", "world/office/measured.csv",
                                        "world/office/outside/lab/measured.csv", "world/office/world.xml"));
  EXPECT_TRUE(files.has(folder / "plugins/../plugins/radio_x.so"));
  EXPECT_THROW(files.add_data(folder / "none.csv"), Error);
  EXPECT_THROW(files_of("<world"), Error);
}

}  // namespace
}  // namespace muster::test
