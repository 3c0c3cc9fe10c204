// Every world of the tree: bundled from a copy that is gone when the bundle is checked.
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>

#include "bundled.hpp"
#include "tests/sanitized.hpp"
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

// Processors of 2008 and 2013: the one has neither fused multiply-add nor wide vectors, the other no AVX-512.
TEST_P(BundledWorld, ComesToTheSameDigestOnOtherProcessors) {
  if (sanitized) GTEST_SKIP() << "the emulator has no room for the sanitizer's memory";
  if (std::system("command -v qemu-x86_64 > /dev/null") != 0) GTEST_SKIP() << "needs qemu-user: scripts/setup --peers";
  const BundleFolder folder;
  const World world = read_world(place_of(GetParam()), standard());
  const double until = std::min(2.0, static_cast<double>(world.ticks) * world.dt);
  folder.told({place_of(GetParam()), "--until", fmt::format("{}", until), "--out", "b.tar.zst"});
  for (const char* processor : {"Nehalem", "Haswell"}) {
    const std::string said = folder / "said";
    const std::string command = fmt::format("qemu-x86_64 -cpu {} {} bundle check {} > {} 2>&1", processor,
                                            MUSTER_PROGRAM, (folder / "b.tar.zst").string(), said);
    EXPECT_EQ(std::system(command.c_str()), 0) << processor << '\n' << folder.read("said");
  }
}

}  // namespace
}  // namespace muster::test
