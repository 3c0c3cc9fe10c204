// muster swap as a user calls it: the run that a world with the same <swap> would be.
#include "compared.hpp"

namespace muster::test {
namespace {

using testing::HasSubstr;

nlohmann::json outcome(const CompareFolder& folder, std::vector<std::string> words) {
  words.emplace_back("--json");
  const auto made = folder.muster(words);
  EXPECT_EQ(made.exit, 0) << made.err;
  return nlohmann::json::parse(made.out);
}

std::vector<std::string> swapped(const std::vector<std::string>& more) {
  std::vector<std::string> words = {"swap", "world.xml", "--at", "2", "--instance", "physics", "--plugin"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(SwapVerb, IsTheSwapOfAWorldFile) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world());
  folder.write("written.xml", drive_world(R"(<swap at="2" instance="physics" plugin="physics.simbody" step="0.01"/>)"));
  const auto run = outcome(folder, swapped({"physics.simbody", "step=0.01"}));
  EXPECT_EQ(run["digest"], outcome(folder, {"run", "written.xml"})["digest"]);
  EXPECT_NE(run["digest"], outcome(folder, {"run", "world.xml"})["digest"]);
  ASSERT_EQ(run["events"].size(), 1u);
  EXPECT_EQ(run["events"][0]["time"], 2.0);
  EXPECT_EQ(run["events"][0]["instance"], "physics");
  EXPECT_THAT(run["events"][0]["message"].get<std::string>(),
              HasSubstr("swapped from physics.planar to physics.simbody/"));
}

TEST(SwapVerb, OfAPluginForItselfChangesNothing) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world());
  EXPECT_EQ(outcome(folder, swapped({"physics.planar"}))["digest"], outcome(folder, {"run", "world.xml"})["digest"]);
}

TEST(SwapVerb, NamesWhatItDoesNotKnow) {
  const CompareFolder folder;
  folder.write("world.xml", drive_world());
  const auto instance =
      folder.muster({"swap", "world.xml", "--at", "2", "--instance", "fysics", "--plugin", "physics.planar"});
  EXPECT_NE(instance.exit, 0);
  EXPECT_THAT(instance.err, HasSubstr("no instance is called \"fysics\""));
  EXPECT_THAT(instance.err, HasSubstr("did you mean \"physics\"?"));
  const auto attribute = folder.muster(swapped({"physics.planar", "accelleration=4"}));
  EXPECT_NE(attribute.exit, 0);
  EXPECT_THAT(attribute.err, HasSubstr("did you mean \"acceleration\"?"));
}

}  // namespace
}  // namespace muster::test
