// A run that is killed at any moment leaves a file of which all but the last half second is recovered, as it was.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <new>
#include <random>

#include "logged_run.hpp"
#include "mcap/rewrite.hpp"

namespace muster::test {
namespace {

// Ticks that a process has done, seen by another after its death.
class SharedTicks {
 public:
  SharedTicks() {
    void* memory =
        ::mmap(nullptr, sizeof(std::atomic<uint64_t>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    ticks_ = new (memory) std::atomic<uint64_t>(0);
  }
  ~SharedTicks() { ::munmap(ticks_, sizeof *ticks_); }
  std::atomic<uint64_t>& operator*() { return *ticks_; }

 private:
  std::atomic<uint64_t>* ticks_;
};

// Ticks that the run had done when it was killed.
uint64_t killed_run(const std::filesystem::path& file, uint64_t least_ticks, useconds_t later) {
  SharedTicks ticks;
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      run_logged(file, 100'000'000, [&](const Simulation& run) { *ticks = run.tick(); });
    } catch (...) {
    }
    ::_exit(1);
  }
  int status = 0;
  while (*ticks < least_ticks && ::waitpid(child, &status, WNOHANG) == 0) ::usleep(100);
  ::usleep(later);
  ::kill(child, SIGKILL);
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the run ended by itself";
  return *ticks;
}

void expect_recovered(std::mt19937& random) {
  const Folder folder;
  const double dt = 0.02;
  const uint64_t done = killed_run(folder / "run.mcap", 20 + random() % 2000, static_cast<useconds_t>(random() % 3000));
  ASSERT_TRUE(std::filesystem::exists(folder / "run.mcap.part"));
  mcap::rewrite(folder / "run.mcap.part", folder / "run.mcap", mcap::Damage::skipped);
  Collected recovered, whole;
  EXPECT_TRUE(mcap::scan(folder / "run.mcap", recovered, mcap::Damage::refused).is_whole);
  const double reached = static_cast<double>(done) * dt;
  const double last = recovered.messages.empty() ? 0 : static_cast<double>(recovered.messages.back().time) / 1e9;
  EXPECT_GE(last, reached - 0.5 - dt - 1e-9) << "killed at " << reached << " s";
  ASSERT_EQ(recovered.all_metadata.size(), 1u);
  EXPECT_EQ(recovered.all_metadata[0].values.at("world"), "logged");

  run_logged(folder / "whole.mcap", done + 1);
  mcap::scan(folder / "whole.mcap", whole, mcap::Damage::refused);
  ASSERT_LE(recovered.messages.size(), whole.messages.size());
  EXPECT_TRUE(std::equal(recovered.messages.begin(), recovered.messages.end(), whole.messages.begin()));
}

TEST(KilledRun, LosesHalfASecondAtMost) {
  std::mt19937 random(11);
  for (int i = 0; i < 5; ++i) expect_recovered(random);
}

TEST(KilledRun, LosesHalfASecondAtMostLong) {
  std::mt19937 random(12);
  for (int i = 0; i < 150; ++i) expect_recovered(random);
}

}  // namespace
}  // namespace muster::test
