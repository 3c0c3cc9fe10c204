// What a bundle refuses, word for word, and that it leaves nothing behind then.
#include "bundled.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

TEST(BundleRefusals, SayWhatWasExpected) {
  const BundleFolder folder;
  folder.write("there.tar.zst", "mine");
  const auto refuses = [&](const std::vector<std::string>& words, const std::string& message) {
    expect_error(folder.bundle(words), 2, message);
  };
  refuses({"lab/site"}, "--out is missing; expected a file to write, NAME.tar.zst");
  refuses({"lab/site", "--out", "b.zip"}, "--out: \"b.zip\" does not end in .tar.zst; expected NAME.tar.zst");
  refuses({"lab/site", "--out", "there.tar.zst"}, "--out: there.tar.zst is there already; expected a new file");
  refuses({"lab/site", "more", "--out", "b.tar.zst"}, "expected one WORLD, or check FILE; \"more\" is too much");
  refuses({"lab/site", "--plugins-of-bundle", "--out", "b.tar.zst"},
          "--plugins-of-bundle is of `muster bundle check FILE`");
  refuses({"lab/site", "--data", "none.csv", "--out", "b.tar.zst"}, "--data: none.csv is no file; expected one");
  refuses({"check"}, "check: expected one FILE after it; a world of that name is ./check");
  refuses({"check", "there.tar.zst", "--seed", "3"},
          "--seed is of the making of a bundle, which keeps it; expected it at `muster bundle WORLD`");
  refuses({"check", "there.tar.zst", "--plugins", "lab", "--plugins-of-bundle"},
          "--plugins and --plugins-of-bundle exclude each other; expected one of them");
  refuses({"check", "there.tar.zst", "--out", "lab"}, "--out: lab is there already; expected a new folder");
  EXPECT_THAT(folder.bundle({"check", "there.tar.zst"}).err,
              HasSubstr("there.tar.zst: is no whole bundle; expected a file that `muster bundle` wrote"));
  EXPECT_EQ(folder.read("there.tar.zst"), "mine");
  EXPECT_FALSE(fs::exists(folder / "b.tar.zst"));
}

TEST(BundleRefusals, AWorldThatCannotBeRunMakesNoBundle) {
  const BundleFolder folder;
  folder.write("lab/site/a/way.csv", "x[m],y[m]\n9,\n");
  const auto outcome = folder.bundle({"lab/site", "--out", "b.tar.zst"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a/way.csv:2:3: "));
  EXPECT_FALSE(fs::exists(folder / "b.tar.zst"));
}

TEST(BundleRefusals, AHostileArchiveLeavesNothing) {
  const BundleFolder folder;
  write_archive(folder / "h.tar.zst", {{"bundle.json", "{}"}, {"../stolen", "x"}});
  const auto outcome = folder.bundle({"check", "h.tar.zst", "--out", "kept"});
  expect_error(outcome, 2, "h.tar.zst: has \"../stolen\", which leaves the bundle; expected a path inside of it");
  EXPECT_FALSE(fs::exists(folder / "kept"));
  EXPECT_FALSE(fs::exists(folder / "stolen"));
  write_archive(folder / "n.tar.zst", {{"world/world.xml", "<world/>"}});
  expect_error(folder.bundle({"check", "n.tar.zst"}), 2,
               "n.tar.zst: has no bundle.json; expected a file that `muster bundle` wrote");
}

// A list that names the world of somebody else as its own, or one that is not in the bundle.
TEST(BundleRefusals, AListMayNotLeaveItsBundle) {
  const BundleFolder folder;
  ASSERT_EQ(folder.bundle({"counted", "--plugins", folder.revision(1), "--out", "b.tar.zst"}).exit, 0);
  const auto with = [&](const std::string& world) {
    folder.change("b.tar.zst", "c.tar.zst", [&](auto& files) {
      auto list = nlohmann::json::parse(files.at("bundle.json"));
      for (auto& file : list["files"])
        if (file["name"] == list["run"]["world"]) file["name"] = world;
      list["run"]["world"] = world;
      files["bundle.json"] = list.dump();
    });
    return folder.bundle({"check", "c.tar.zst"});
  };
  EXPECT_EQ(with("../../counted/world.xml").exit, 2);
  EXPECT_EQ(with(folder.at("counted/world.xml")).exit, 2);
  EXPECT_EQ(with("world/counted/other.xml").exit, 1);  // missing, and the other one is not listed
}

}  // namespace
}  // namespace muster::test
