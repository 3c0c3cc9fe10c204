// Every world of the tree: bundled from a copy that is gone when the bundle is checked.
#include <fmt/core.h>

#include "bundled.hpp"
#include "tests/worlds/all/world_runs.hpp"

namespace muster::test {
namespace {

class BundledWorld : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Bundle, BundledWorld, testing::ValuesIn(worlds()), test_name);

TEST_P(BundledWorld, ComesToTheSameDigestWithoutItsSources) {
  const BundleFolder folder;
  fs::copy(MUSTER_SOURCE_DIR "/worlds", folder / "worlds", fs::copy_options::recursive);
  const World world = read_world(place_of(GetParam()), standard());
  const double until = static_cast<double>(std::min(world.ticks, most_ticks)) * world.dt;
  const auto made = folder.told({"worlds/" + GetParam(), "--until", fmt::format("{}", until), "--out", "b.tar.zst"});
  const std::string expected = fmt::format("{:016x}", plain_digest(GetParam()));
  EXPECT_EQ(made["digest"], expected);
  fs::rename(folder / "worlds", folder / "elsewhere");
  const auto checked = folder.told({"check", "b.tar.zst"});
  EXPECT_EQ(checked["digest"], expected);
  EXPECT_EQ(checked["same"], true);
}

}  // namespace
}  // namespace muster::test
