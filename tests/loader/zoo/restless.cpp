// Looks at what no run repeats: random numbers and the clock of the system, and state that no snapshot holds.
#include <chrono>
#include <cstdlib>
#include <muster/plugin.hpp>
#include <thread>

namespace {

struct Restless {
  static constexpr auto id = ANIMAL_ID, summary = "never does the same";
  static constexpr auto phase = MUSTER_OBSERVE;
  explicit Restless(muster::Setup&) {}
  void step(const muster::Step& k) const {
    static int count = 0;
    static const char* const words[] = {"odd", "even"};
    const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    count += std::rand() + static_cast<int>(now);
    std::this_thread::sleep_for(std::chrono::microseconds(1));
    k.event(words[count % 2 == 0]);
  }
};

}  // namespace

MUSTER_PLUGIN_IS(Restless)
