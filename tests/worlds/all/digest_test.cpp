// A run is the same bit for bit, however it comes about.
#include <fmt/core.h>

#include <clocale>
#include <cstdlib>
#include <locale>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/cli/errors/program.hpp"
#include "world_runs.hpp"

namespace muster::test {
namespace {

class EveryWorld : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Digest, EveryWorld, testing::ValuesIn(worlds()), test_name);

TEST_P(EveryWorld, IsNotAtRest) {
  Simulation run = start(GetParam());
  const auto first = run.digest();
  EXPECT_NE(finish(run), first) << "nothing has happened, so that the tests below would show nothing";
}

TEST_P(EveryWorld, IsTheSameForAnyNumberOfWorkers) {
  const auto expected = plain_digest(GetParam());
  for (const int workers : {2, 3, 7}) {
    Simulation run = start(GetParam(), workers);
    EXPECT_EQ(finish(run), expected) << workers << " workers";
  }
}

TEST_P(EveryWorld, IsTheSameWhereEachInstanceStepsInAProcessOfItsOwn) {
  Simulation run = start(GetParam(), 1, {{"*", {}}});
  run_until(run, run.world().ticks / 5);
  Simulation plain = start(GetParam());
  run_until(plain, plain.world().ticks / 5);
  EXPECT_EQ(run.digest(), plain.digest());
}

TEST_P(EveryWorld, IsTheSameAfterSaveAndRestore) {
  const auto expected = plain_digest(GetParam());
  const ProgramFolder folder;
  const auto file = folder.path() / "state";
  Simulation before = start(GetParam());
  run_until(before, before.world().ticks / 2);
  before.snapshot().save(file);
  const auto at_half = before.digest();
  Simulation after = start(GetParam());
  after.restore(Snapshot::load(file));
  EXPECT_EQ(after.digest(), at_half);
  EXPECT_EQ(finish(after), expected);
  EXPECT_EQ(finish(before), expected) << "to save disturbs";
}

// To restart a run is to restore what stood before its first tick.
TEST_P(EveryWorld, RestartsFromTheSnapshotOfItsStart) {
  Simulation run = start(GetParam());
  const Snapshot at_start = run.snapshot();
  const auto first = finish(run);
  EXPECT_EQ(first, plain_digest(GetParam()));
  run.restore(at_start);
  EXPECT_EQ(run.tick(), 0u);
  EXPECT_EQ(run.digest(), start(GetParam()).digest());
  EXPECT_EQ(finish(run), first);
}

TEST_P(EveryWorld, IsTheSameAfterEveryInstanceWasMadeAgain) {
  Simulation run = start(GetParam());
  std::vector<std::string> names;
  for (const auto& instance : run.instances()) names.push_back(instance->name());
  run_until(run, run.world().ticks / 2);
  for (const auto& name : names) run.remake(name);
  EXPECT_EQ(finish(run), plain_digest(GetParam()));
}

TEST_P(EveryWorld, IsTheSameInGermany) {
  const auto expected = plain_digest(GetParam());
  ::setenv("LOCPATH", MUSTER_LOCALES, 1);
  ASSERT_NE(std::setlocale(LC_ALL, "de_DE.UTF-8"), nullptr);
  ASSERT_STREQ(std::localeconv()->decimal_point, ",");
  const auto usual = std::locale::global(std::locale("de_DE.UTF-8"));
  const auto found = plain_digest(GetParam());
  std::locale::global(usual);
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(found, expected);
}

// Each in another language, and with other values in memory that nobody wrote (glibc fills it with what MALLOC_PERTURB_
// is not).
TEST_P(EveryWorld, IsTheSameInTwoProcesses) {
  const auto expected = fmt::format("\"digest\": \"{:016x}\"", plain_digest(GetParam()));
  const World world = read_world(place_of(GetParam()), standard());
  const double until = static_cast<double>(std::min(world.ticks, most_ticks)) * world.dt;
  for (int process = 0; process < 2; ++process) {
    Surroundings around;
    around.environment = {"LOCPATH=" MUSTER_LOCALES, process ? "LC_ALL=de_DE.UTF-8" : "LC_ALL=C",
                          process ? "MALLOC_PERTURB_=255" : "MALLOC_PERTURB_=165"};
    const auto outcome =
        run_muster({"run", place_of(GetParam()), "--until", fmt::format("{}", until), "--json"}, around);
    EXPECT_EQ(outcome.exit, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(expected), outcome.out.npos) << expected << "\n" << outcome.out;
  }
}

// The C library chooses its elementary functions by the processor: those with fused multiply-add differ in the last
// bit.
TEST_P(EveryWorld, IsTheSameWithoutFusedMultiplyAddAndWideVectors) {
  if (GetParam().find("mujoco") != std::string::npos) GTEST_SKIP() << "MuJoCo calls the C library itself";
  const World world = read_world(place_of(GetParam()), standard());
  const double until = std::min(10.0, static_cast<double>(world.ticks) * world.dt);
  std::set<std::string> digests;
  for (const char* without : {"", "-FMA", "-FMA,-AVX2,-AVX512F"}) {
    Surroundings around;
    around.environment = {std::string("GLIBC_TUNABLES=glibc.cpu.hwcaps=") + without};
    const auto outcome =
        run_muster({"run", place_of(GetParam()), "--until", fmt::format("{}", until), "--json"}, around);
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    digests.insert(nlohmann::json::parse(outcome.out).at("digest").get<std::string>());
  }
  EXPECT_EQ(digests.size(), 1u) << testing::PrintToString(digests);
}

}  // namespace

// glibc keeps the path of LOCPATH that setlocale() has split, for good.
// NOLINTNEXTLINE(bugprone-reserved-identifier): the name that the sanitizer looks for.
extern "C" const char* __lsan_default_suppressions() { return "leak:argz_add_sep\n"; }
}  // namespace muster::test
