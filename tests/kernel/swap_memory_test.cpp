// A thousand swaps leave memory as it was. Without sanitizers, which keep what is freed.
#include <malloc.h>

#include "toy_world.hpp"

namespace muster {
namespace {

using Memory = ToyWorld;

// Pages of this process that are its own, and bytes allocated by malloc.
double resident_megabytes() {
  std::ifstream in("/proc/self/statm");
  double total = 0, resident = 0;
  in >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

TEST_F(Memory, AThousandSwapsLeaveItFlat) {
  Simulation sim =
      run(two_robots + "<toy.copy_physics name='n' to='robot/*/v' own='true' add='1'/>\n<toy.version name='v'/>\n");
  const auto swap = [&](int times) {
    for (int i = 0; i < times; ++i) {
      sim.swap("n", instance(i % 2 ? "toy.copy_physics" : "toy.copy_sense", "",
                             {{"to", "robot/*/v"}, {"own", "true"}, {"add", "1"}}));
      step(sim);
    }
  };
  swap(100);
  const double resident = resident_megabytes();
  const auto used = mallinfo2().uordblks;
  swap(1000);
  EXPECT_EQ(cell(sim, "robot/a/v"), 1100);
  EXPECT_LT(resident_megabytes() - resident, 2);
  // The list of events is the user's and grows by one a swap.
  EXPECT_LT(static_cast<double>(mallinfo2().uordblks) - static_cast<double>(used), 1000 * 400.0);
  std::ifstream maps("/proc/self/maps");
  int mapped = 0;
  for (std::string line; std::getline(maps, line);)
    mapped += line.find("toy_") != std::string::npos || line.find("(deleted)") != std::string::npos;
  EXPECT_LT(mapped, 40);
}

}  // namespace
}  // namespace muster
