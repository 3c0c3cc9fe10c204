// A run that is killed at any moment and begun again from the last state that it saved ends as one that was not.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <random>

#include "kernel/snapshot.hpp"
#include "tests/cli/errors/program.hpp"

namespace muster::test {
namespace {

const std::string logged = MUSTER_LOG_WORLD;
constexpr const char* until = "60";

// The line that tells ticks, seconds and digest.
std::string end_of(const Outcome& outcome) {
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  const auto at = outcome.out.find("logged: ");
  return at == std::string::npos ? outcome.out : outcome.out.substr(at, outcome.out.find('\n', at) - at);
}

// Counts how many of the runs were killed after their first state.
int killed_and_resumed(std::mt19937& random, int times) {
  const ProgramFolder whole_folder;
  const Outcome whole = whole_folder.muster({"run", logged, "--until", until, "--mcap", "run.mcap"});
  const std::string straight = end_of(whole);
  std::uniform_real_distribution<> moment(0, whole.wall_seconds);
  int resumed = 0;
  for (int i = 0; i < times; ++i) {
    const ProgramFolder folder;
    Surroundings around;
    around.meanwhile = [&](int process) {
      ::usleep(static_cast<useconds_t>(1e6 * moment(random)));
      ::kill(process, SIGKILL);
    };
    const Outcome killed = folder.muster({"run", logged, "--until", until, "--mcap", "run.mcap", "--save", "state",
                                          "--save-every", "0.5", "--digest-every", "1"},
                                         around);
    if (killed.exit != 128 + SIGKILL || !std::filesystem::exists(folder / "state")) continue;
    ++resumed;
    // What it printed last is of a tick that it had done: the state is of half a second before that, or later.
    const auto digest = killed.out.rfind('\n', killed.out.rfind('\n') - 1) + 1;
    EXPECT_GE(Snapshot::load(folder / "state").tick + 25, std::stoull(killed.out.substr(digest)));
    EXPECT_EQ(end_of(folder.muster({"run", logged, "--until", until, "--restore", "state"})), straight);
    if (!std::filesystem::exists(folder / "run.mcap.part")) continue;
    const Outcome recovered = folder.muster({"log", "recover", "run.mcap.part", "-o", "recovered.mcap"});
    EXPECT_EQ(recovered.exit, 0) << recovered.err;
    EXPECT_EQ(folder.muster({"log", "info", "recovered.mcap"}).exit, 0);
  }
  return resumed;
}

TEST(KilledRun, GoesOnFromItsLastState) {
  std::mt19937 random(21);
  EXPECT_GT(killed_and_resumed(random, 8), 0);
}

TEST(KilledRun, GoesOnFromItsLastStateLong) {
  std::mt19937 random(22);
  EXPECT_GT(killed_and_resumed(random, 150), 100);
}

TEST(KilledRun, SaysWhatSavingOnTheWayNeeds) {
  const ProgramFolder folder;
  expect_error(folder.muster({"run", logged, "--save-every", "1"}), 2,
               "muster run: --save-every has no effect without --save; expected --save beside it, or no --save-every; "
               "see muster run --help");
  expect_error(folder.muster({"run", logged, "--save", "s", "--save-every", "0.01"}), 2,
               "--save-every: 0.01 s is less than a tick of 0.02 s; expected at least that");
  EXPECT_FALSE(std::filesystem::exists(folder / "s"));
}

}  // namespace
}  // namespace muster::test
