// The schema for editors and muster check agree: on every world of the tree, and on worlds with one fault each.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>

#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Schema : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ProgramFolder;
    const auto outcome = folder_->muster({"schema", "-o", "muster.xsd"});
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }
  static void TearDownTestSuite() { delete folder_; }

  // Exit code of xmllint: 0 takes it, 3 refuses it, others are faults of the schema.
  static int validated(const fs::path& file) {
    const std::string words = "xmllint --nonet --noout --schema " + folder_->at("muster.xsd") + ' ' + file.string() +
                              " > " + folder_->at("xmllint.log") + " 2>&1";
    const int status = std::system(words.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  static std::string log() { return folder_->read("xmllint.log"); }

  static void expect_refused_by_both(const std::string& world) {
    folder_->write("world.xml", world);
    EXPECT_EQ(validated(folder_->at("world.xml")), 3) << world << '\n' << log();
    const auto outcome = folder_->muster({"check", "world.xml"});
    EXPECT_TRUE(outcome.exit == 2 || outcome.exit == 3) << world << '\n' << outcome.out;  // 3: no such plugin
  }
  static void expect_taken_by_both(const std::string& world) {
    folder_->write("world.xml", world);
    EXPECT_EQ(validated(folder_->at("world.xml")), 0) << world << '\n' << log();
    const auto outcome = folder_->muster({"check", "world.xml"});
    EXPECT_EQ(outcome.exit, 0) << world << '\n' << outcome.err;
  }

  static ProgramFolder* folder_;
};
ProgramFolder* Schema::folder_ = nullptr;

std::vector<fs::path> worlds_of_the_tree() {
  std::vector<fs::path> result;
  for (const char* root : {"worlds", "docs/samples", "tests/viewer/gallery"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(MUSTER_SOURCE_DIR) / root)) {
      if (entry.path().extension() == ".xml" && contents(entry.path()).find("<world") != std::string::npos)
        result.push_back(entry.path());
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

TEST_F(Schema, TakesEveryWorldOfTheTree) {
  int taken = 0;
  for (const auto& file : worlds_of_the_tree()) {
    const auto outcome = run_muster({"check", file.string()});
    if (outcome.err.find(".so not found") != std::string::npos) continue;  // its plugin is not built here
    EXPECT_EQ(validated(file), 0) << log();
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    ++taken;
  }
  EXPECT_GE(taken, 10);
}

// A world that is in order, of which each test changes one thing.
std::string changed(const std::string& from, const std::string& to) {
  std::string world =
      R"(<world name="w" dt="0.1" until="1" seed="2"><material name="brick" loss="4"/>)"
      R"(<wall name="w1" from="0 0" to="4 0" height="2.5" material="brick"/>)"
      R"(<door name="d1" wall="w1" at="1" state="open"/><station name="base" at="1 1 1"/>)"
      R"(<robot name="r" at="0 1 0"/><robots.drive/><physics.simbody name="body"/>)"
      R"(<radio.multiwall l0="40"/><network.ideal/><control.beacon radio="base"/><control.steady every="2" robot="r" v="0.5"/>)"
      R"(<swap at="0.5" instance="body"><physics.planar/></swap>)"
      R"(<at t="0.5"><set path="door/d1/state" value="closed"/><leave robot="r"/></at>)"
      R"(<at when="robot/r/pose/x above 1"><robot name="late" at="0 2 0"/><control.steady name="late" robot="late" v="1"/>)"
      R"(<remove instance="late"/></at>)"
      R"(<record table="robot/*/pose" every="2"/></world>)";
  const auto at = world.find(from);
  EXPECT_NE(at, world.npos) << from;
  return world.replace(at, from.size(), to);
}

TEST_F(Schema, RefusesWhatACheckRefuses) {
  expect_taken_by_both(changed("<world", "<world"));
  const std::pair<const char*, const char*> faults[] = {
      {" until=\"1\"", ""},
      {"until=\"1\"", "until=\"soon\""},
      {"until=\"1\"", "until=\"-1\""},
      {"until=\"1\"", "until=\"1\" unto=\"1\""},
      {"dt=\"0.1\"", "dt=\"0\""},
      {"dt=\"0.1\"", "dt=\"INF\""},
      {"seed=\"2\"", "seed=\"-2\""},
      {"seed=\"2\"", "seed=\"2.5\""},
      {"loss=\"4\"", "loss=\"400\""},
      {"loss=\"4\"", "loss=\"NaN\""},
      {"loss=\"4\"", "loss=\"4 dB\""},
      {" loss=\"4\"", ""},
      {"loss=\"4\"", "los=\"4\""},
      {"from=\"0 0\"", "from=\"0\""},
      {"from=\"0 0\"", "from=\"0 0 0\""},
      {"from=\"0 0\"", "from=\"0, 0\""},
      {"from=\"0 0\"", "from=\"0 1e9\""},
      {"name=\"w1\"", "name=\"w 1\""},
      {"state=\"open\"", "state=\"ajar\""},
      {"<door", "<window name=\"w2\"/><door"},
      {"<robots.drive/>", "<robot name=\"r\" at=\"1 1 0\"/><robots.drive/>"},
      {"<robots.drive/>", "<robots.drift/>"},
      {"<robots.drive/>", "<robots.drive reach=\"1\"/>"},
      {"every=\"2\" robot", "every=\"0\" robot"},
      {"every=\"2\" robot", "every=\"two\" robot"},
      {"l0=\"40\"", "l0=\"-40000\""},
      {"robot=\"r\" v", "v"},
      {"v=\"0.5\"", "v=\"fast\""},
      {"v=\"0.5\"", "v=\"11\""},
      {"<swap at=\"0.5\"", "<swap"},
      {"<at t=\"0.5\"", "<at t=\"soon\""},
      {"<leave robot=\"r\"/>", "<leave robots=\"r\"/>"},
      {"<leave robot=\"r\"/>", "<go robot=\"r\"/>"},
      {"name=\"late\" at", "name=\"r\" at"},
      {"name=\"late\" at", "name=\"late\" in"},
      {"<remove instance=\"late\"/>", "<remove/>"},
      {"<remove instance=\"late\"/>", "<door name=\"d2\" wall=\"w1\" at=\"3\"/>"},
      {"<swap at=\"0.5\"", "<swap at=\"half\""},
      {"<physics.planar/>", "<physics.planar/><physics.planar/>"},
      {" table=\"robot/*/pose\"", ""},
      {"table=\"robot/*/pose\"", "table=\"robot/*/pose\" each=\"1\""},
      {"<network.ideal/>", "<network.ideal><station at=\"0 0 0\"/></network.ideal>"},
  };
  for (const auto& [from, to] : faults) expect_refused_by_both(changed(from, to));
  expect_refused_by_both("<scene until=\"1\"/>");
}

TEST_F(Schema, KnowsWhatPluginsDeclare) {
  const std::string schema = folder_->read("muster.xsd");
  EXPECT_THAT(schema, HasSubstr("<xs:attribute name=\"n\" default=\"2\"")) << "of radio.multiwall";
  EXPECT_THAT(schema, HasSubstr("<xs:element name=\"control.steady\"><xs:annotation><xs:documentation>asks a robot for "
                                "one forward speed and turn rate"));
  EXPECT_THAT(schema, HasSubstr("<xs:enumeration value=\"closed\"/><xs:enumeration value=\"open\"/>"));
}

TEST_F(Schema, GoesToStandardOutputWithoutAFile) {
  const auto outcome = folder_->muster({"schema"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_EQ(outcome.out, folder_->read("muster.xsd"));
  folder_->write("mine", "");
  std::filesystem::create_hard_link(folder_->path() / "mine", folder_->path() / "linked.xsd");
  EXPECT_EQ(folder_->muster({"schema", "-o", "linked.xsd"}).exit, 0);
  EXPECT_EQ(folder_->read("mine"), "") << "a new file takes the name; the old one is not written over";
  std::filesystem::create_directory(folder_->path() / "folder");
  expect_error(folder_->muster({"schema", "-o", "folder"}), 2,
               "--out: folder is a folder; expected another file to write");
  expect_error(folder_->muster({"schema", "-o", "no/where.xsd"}), 74,
               "no/where.xsd: cannot be written: No such file or directory");
}

}  // namespace
}  // namespace muster::test
