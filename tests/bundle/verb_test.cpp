// A bundle comes to the digest of the run that it was made of, without any of its sources; what was changed, and what
// differs on this machine, is told by name.
#include <signal.h>

#include "bundled.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

TEST(Bundle, RunsWithoutItsSources) {
  const BundleFolder folder;
  const std::string expected = folder.digest_of_run({"lab/site"});
  const auto made = folder.told({"lab/site", "--out", "b.tar.zst"});
  EXPECT_EQ(made["digest"], expected);
  fs::rename(folder / "lab", folder / "gone");
  const auto checked = folder.told({"check", "b.tar.zst"});
  EXPECT_EQ(checked["digest"], expected);
  EXPECT_EQ(checked["same"], true);
  EXPECT_EQ(checked["list"], made["list"]);
  EXPECT_THAT(checked["differences"], IsEmpty());
  EXPECT_EQ(folder.told({"check", "b.tar.zst", "--plugins-of-bundle", "--workers", "3"})["digest"], expected);
  // The three tables of one name are three files of the bundle, and each is needed for the digest.
  for (const std::string name : {"a/way.csv", "b/way.csv", "outside/shared/way.csv"})
    EXPECT_THAT(made["files"], testing::Contains("world/site/" + name));
}

// What was unpacked stayed in the folder of temporary files.
TEST(Bundle, ACheckThatIsInterruptedLeavesNothingBehind) {
  const BundleFolder folder;
  ASSERT_EQ(folder.bundle({"lab/site", "--until", "10000", "--out", "b.tar.zst"}).exit, 0);
  fs::create_directory(folder / "tmp");
  Surroundings around;
  around.environment = {"TMPDIR=" + folder.at("tmp")};
  around.meanwhile = [](int process) { ::kill(process, SIGINT); };
  EXPECT_EQ(folder.muster({"bundle", "check", "b.tar.zst"}, around).exit, 130);
  EXPECT_TRUE(fs::is_empty(folder / "tmp"));
}

TEST(Bundle, KeepsSeedEndAndParameters) {
  const BundleFolder folder;
  const std::vector<std::string> options{"lab/site", "--seed", "9", "--until", "1.5", "--set", "radio.multiwall/n=3"};
  auto words = options;
  words.insert(words.end(), {"--out", "b.tar.zst"});
  const auto made = folder.told(words);
  EXPECT_EQ(made["digest"], folder.digest_of_run(options));
  EXPECT_NE(made["digest"], folder.digest_of_run({"lab/site", "--until", "1.5"}));
  EXPECT_EQ(made["ticks"], 15);
  fs::remove_all(folder / "lab");
  const auto checked = folder.told({"check", "b.tar.zst"});
  EXPECT_EQ(checked["digest"], made["digest"]);
  EXPECT_EQ(checked["seed"], 9);
}

TEST(Bundle, ListsWhatMadeItAndWhere) {
  const BundleFolder folder;
  ASSERT_EQ(folder.bundle({"lab/site", "--out", "b.tar.zst"}).exit, 0);
  const auto manifest = folder.manifest_of("b.tar.zst");
  EXPECT_EQ("muster " + manifest.muster + '\n', folder.muster({"--version"}).out);
  EXPECT_FALSE(manifest.machine.architecture.empty());
  EXPECT_THAT(manifest.machine.libc, HasSubstr("glibc 2."));
  EXPECT_THAT(manifest.date, testing::MatchesRegex("20..-..-..T..:..:..Z"));
  // Those included that no element names.
  std::vector<std::string> ids;
  for (const auto& plugin : manifest.plugins) ids.push_back(plugin.id);
  for (const char* id : {"radio.links/", "robots.drive/", "radio.receiver/"})
    EXPECT_THAT(ids, testing::Contains(testing::StartsWith(id)));
}

TEST(Bundle, GoesWithDataThatNoFileNames) {
  const BundleFolder folder;
  folder.write("elsewhere/measured.csv", "rssi[dBm]\n-60\n");
  const auto made = folder.told({"lab/site", "--data", "elsewhere/measured.csv", "--out", "b.tar.zst"});
  ASSERT_EQ(folder.bundle({"check", "b.tar.zst", "--out", "kept"}).exit, 0);
  EXPECT_EQ(folder.read("kept/world/site/outside/elsewhere/measured.csv"), "rssi[dBm]\n-60\n");
  // What is kept is a world like any other.
  EXPECT_EQ(folder.digest_of_run({"kept/world/site"}), made["digest"].get<std::string>());
}

TEST(Bundle, NamesWhatWasChanged) {
  const BundleFolder folder;
  ASSERT_EQ(folder.bundle({"lab/site", "--out", "b.tar.zst"}).exit, 0);
  folder.change("b.tar.zst", "c.tar.zst", [](auto& files) {
    files.at("world/site/a/way.csv")[10] = '8';
    files.at("plugins/physics_planar.so").back() ^= 1;
    files.erase("world/site/outside/shared/walls.csv");
    files["world/site/new.csv"] = "";
  });
  const auto told = folder.told({"check", "c.tar.zst"}, 1);
  EXPECT_EQ(told["changed"], nlohmann::json({"plugins/physics_planar.so", "world/site/a/way.csv"}));
  EXPECT_EQ(told["missing"], nlohmann::json({"world/site/outside/shared/walls.csv"}));
  EXPECT_EQ(told["not_listed"], nlohmann::json({"world/site/new.csv"}));
  EXPECT_TRUE(told["digest"].is_null()) << "what was changed is not run";
  const auto shown = folder.bundle({"check", "c.tar.zst"});
  EXPECT_EQ(shown.exit, 1);
  EXPECT_THAT(shown.out, HasSubstr("  changed: world/site/a/way.csv\n"));
  EXPECT_THAT(shown.out, HasSubstr("  missing: world/site/outside/shared/walls.csv\n"));
  EXPECT_THAT(shown.out, HasSubstr("  not listed: world/site/new.csv\n"));
}

// Each byte of the world that is another is seen, whether or not it changes the run.
TEST(Bundle, SeesABlankThatWasAdded) {
  const BundleFolder folder;
  ASSERT_EQ(folder.bundle({"lab/site", "--out", "b.tar.zst"}).exit, 0);
  folder.change("b.tar.zst", "c.tar.zst", [](auto& files) { files.at("world/site/world.xml") += '\n'; });
  EXPECT_EQ(folder.told({"check", "c.tar.zst"}, 1)["changed"], nlohmann::json({"world/site/world.xml"}));
}

TEST(Bundle, TellsAnotherRevisionAndWhereTheRunsPart) {
  const BundleFolder folder;
  ASSERT_EQ(folder.bundle({"counted", "--plugins", folder.revision(1), "--out", "b.tar.zst"}).exit, 0);
  EXPECT_EQ(folder.bundle({"check", "b.tar.zst", "--plugins", folder.revision(1)}).exit, 0);
  const auto told = folder.told({"check", "b.tar.zst", "--plugins", folder.revision(2)}, 1);
  EXPECT_EQ(told["same"], false);
  const nlohmann::json other{{"what", "plugin"}, {"there", "test.revised/1"}, {"here", "test.revised/2"}};
  EXPECT_THAT(told["differences"], testing::Contains(other));
  EXPECT_EQ(told["first_difference"]["same_until"], 0);
  EXPECT_EQ(told["first_difference"]["tick"], 1);
  EXPECT_EQ(told["first_difference"]["tables"], nlohmann::json({"instance/counter/*/count"}));
  const auto shown = folder.bundle({"check", "b.tar.zst", "--plugins", folder.revision(2)});
  EXPECT_THAT(shown.out, HasSubstr("differs: plugin: test.revised/1 there, test.revised/2 here\n"));
  EXPECT_THAT(shown.out, HasSubstr("  the same after tick 0 (0 s), different after tick 1 (0.1 s), in\n"
                                   "    instance/counter/*/count\n"));
  EXPECT_EQ(folder.bundle({"check", "b.tar.zst", "--plugins-of-bundle"}).exit, 0);
}

TEST(Bundle, TellsAPluginThatIsNotHere) {
  const BundleFolder folder;
  ASSERT_EQ(folder.bundle({"counted", "--plugins", folder.revision(1), "--out", "b.tar.zst"}).exit, 0);
  const auto shown = folder.bundle({"check", "b.tar.zst"});
  EXPECT_EQ(shown.exit, 3);
  EXPECT_THAT(shown.out, HasSubstr("differs: plugin: test.revised/1 there, none here\n"));
  EXPECT_THAT(shown.err, HasSubstr("world.xml:1:"));
}

TEST(Bundle, TellsAnotherMachineAndAnotherModel) {
  const BundleFolder folder;
  ASSERT_EQ(folder.bundle({"lab/site", "--out", "b.tar.zst"}).exit, 0);
  folder.change("b.tar.zst", "c.tar.zst", [](auto& files) {
    auto list = nlohmann::json::parse(files.at("bundle.json"));
    list["machine"]["architecture"] = "s390x";
    list["muster"] = "0.0.1";
    files["bundle.json"] = list.dump();
  });
  fs::create_directories(folder / "own/models");
  std::string model = contents(MUSTER_PLUGINS_DIR "/models/scarab.urdf");
  folder.write("own/models/scarab.urdf", model + "<!-- mine -->\n");
  const auto shown = folder.bundle({"check", "c.tar.zst", "--plugins", "own"});
  EXPECT_EQ(shown.exit, 0) << shown.err;  // none of it changes the run
  EXPECT_THAT(shown.out, HasSubstr("  differs: muster: 0.0.1 there, "));
  EXPECT_THAT(shown.out, HasSubstr("  differs: architecture: s390x there, "));
  EXPECT_THAT(shown.out, HasSubstr("  differs: models/scarab.urdf: SHA-256 "));
  EXPECT_THAT(shown.out, HasSubstr("the same digest after 30 ticks: "));
}

// Code of the bundle runs only where that is asked for.
TEST(Bundle, RunsNoLibraryOfItsOwnUnasked) {
  const BundleFolder folder;
  fs::create_directories(folder / "own");
  fs::copy_file(folder.revision(1) + "/test_revised.so", folder / "own/test_revised.so");
  folder.write(
      "own/world.xml",
      "<world name=\"o\" dt=\"0.1\" until=\"1\"><test.revised name=\"c\" library=\"test_revised.so\"/></world>");
  const auto made = folder.told({"own", "--out", "b.tar.zst"});
  EXPECT_EQ(made["files"], nlohmann::json({"world/own/test_revised.so", "world/own/world.xml"}));
  const auto refused = folder.bundle({"check", "b.tar.zst"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("own/world.xml:1:36: the library \"test_revised.so\" is the bundle's own; expected "
                        "--plugins-of-bundle, which runs its code"));
  EXPECT_EQ(folder.told({"check", "b.tar.zst", "--plugins-of-bundle"})["digest"], made["digest"]);
}

}  // namespace
}  // namespace muster::test
