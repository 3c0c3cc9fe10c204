// The list of a bundle: hashes of known texts, what it says after it was written, and what of a folder is not as
// listed.
#include "bundle/manifest.hpp"

#include <gtest/gtest.h>

#include "bundle/sha256.hpp"
#include "tests/folder.hpp"
#include "text/error.hpp"

namespace muster::test {
namespace {

using namespace muster::bundle;

// FIPS 180-4's examples, and NIST's of a million letters.
TEST(Sha256, IsThatOfTheStandard) {
  const Folder folder;
  const auto of = [&](const std::string& text) { return sha256_of(folder.write("text", text)); };
  EXPECT_EQ(of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(of(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_THROW(sha256_of(folder / "none"), Error);
}

Manifest example() {
  Manifest result;
  result.date = "2026-11-27T04:17:22Z", result.muster = "0.2.0";
  result.machine = {"Debian", "x86_64", "glibc 2.36", "GCC 12.2.0", "a \"processor\"", {"avx2", "fma"}};
  result.world = "world/office/world.xml";
  result.seed = 0xFFFFFFFFFFFFFFFFu, result.ticks = 3, result.dt = 0.1;
  result.set = {"radio.multiwall/n=2.5"};
  result.files = {
      {"world/office/world.xml", 3, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad", ""},
      {"plugins/a_b.so", 0, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855", "../a_b.so"}};
  result.plugins = {{"a.b/2", "plugins/a_b.so"}};
  result.waymarks = {{0, "0000000000000001", {{"robot/*/pose", "00ff"}}}, {3, "0000000000000002", {}}};
  return result;
}

TEST(Manifest, SaysWhatItSaidWhenItIsReadAgain) {
  const Folder folder;
  const Manifest given = example(), read = read_manifest(folder.write("bundle.json", text_of(given)));
  EXPECT_EQ(text_of(read), text_of(given));
  EXPECT_EQ(read.seed, given.seed);
  EXPECT_EQ(read.dt, given.dt);
  EXPECT_EQ(read.files[1].named, "../a_b.so");
  EXPECT_EQ(read.waymarks[0].tables.at("robot/*/pose"), "00ff");
}

TEST(Manifest, ThatSaysWhatNoListSaysIsRefused) {
  const Folder folder;
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string text = text_of(example());
    text.replace(text.find(from), from.size(), to);
    try {
      read_manifest(folder.write("bundle.json", text));
    } catch (const Error& e) {
      const std::string end = "; expected the bundle.json that `muster bundle` wrote", all = folder.inside(e.what());
      EXPECT_TRUE(all.ends_with(end)) << all;
      return all.substr(0, all.size() - end.size());
    }
    return std::string("taken");
  };
  EXPECT_EQ(refusal("{", "["), "bundle.json: is no JSON");
  EXPECT_EQ(refusal("muster.bundle.1", "muster.bundle.9"),
            "bundle.json: is of the format \"muster.bundle.9\", and this version of muster reads \"muster.bundle.1\"");
  EXPECT_EQ(refusal("\"seed\": 18446744073709551615", "\"seed\": -1"), "bundle.json: \"seed\" is no whole number");
  EXPECT_EQ(refusal("\"ticks\": 3", "\"tacks\": 3"), "bundle.json: has no \"ticks\"");
  EXPECT_EQ(refusal("\"ticks\": 3", "\"ticks\": 4"), "bundle.json: has no digest of the end of its run");
  EXPECT_EQ(refusal("\"tick\": 0", "\"tick\": 5"), "bundle.json: has digests that are not in order of ticks");
  EXPECT_EQ(refusal("\"dt\": 0.1", "\"dt\": 0"), "bundle.json: \"dt\" is no time");
  EXPECT_EQ(refusal("\"name\": \"plugins/a_b.so\"", "\"name\": \"../../a_b.so\""),
            "bundle.json: lists \"../../a_b.so\", which leaves the bundle; expected a path inside of it");
  EXPECT_EQ(refusal("\"name\": \"plugins/a_b.so\"", "\"name\": \"world/office/world.xml\""),
            "bundle.json: lists \"world/office/world.xml\" more than once");
  EXPECT_EQ(refusal("\"world\": \"world/office/world.xml\"", "\"world\": \"/etc/world.xml\""),
            "bundle.json: does not list the world \"/etc/world.xml\"");
  EXPECT_EQ(refusal("\"file\": \"plugins/a_b.so\"", "\"file\": \"/tmp/a_b.so\""),
            "bundle.json: does not list the plugin \"/tmp/a_b.so\"");
}

TEST(Manifest, NamesWhatIsNotAsListed) {
  const Folder folder;
  const Manifest manifest = example();
  folder.write("bundle.json", text_of(manifest));
  folder.write("world/office/world.xml", "abc");
  folder.write("plugins/a_b.so", "");
  EXPECT_FALSE(faults_of(folder.path(), manifest).any());
  folder.write("world/office/world.xml", "abd");  // of the same length
  folder.write("world/office/more.csv", "");
  std::filesystem::remove(folder / "plugins/a_b.so");
  const Faults faults = faults_of(folder.path(), manifest);
  EXPECT_EQ(faults.changed, std::vector<std::string>{"world/office/world.xml"});
  EXPECT_EQ(faults.missing, std::vector<std::string>{"plugins/a_b.so"});
  EXPECT_EQ(faults.extra, std::vector<std::string>{"world/office/more.csv"});
}

}  // namespace
}  // namespace muster::test
