// Says in which process it steps. Its parameter `wait` is for what is outside, or a time of the world.
#include <unistd.h>

#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Where {
  static constexpr const char* columns = "process";
  double process;
};

struct Waiting {
  static constexpr auto id = TOY_ID "/1", summary = "says in which process it steps";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {
      real("wait", 1, 0, 10, "s", TOY_OUTSIDE ? "how long it waits for a client to come" : "at each way point")};

  explicit Waiting(Setup& s) : wait(s.value("wait")), out(s.write<Where>("self/where")) {}
  void step(const Step& k) const { k[out]->process = static_cast<double>(::getpid()); }

  Value wait;
  Out<Where> out;
};

}  // namespace

MUSTER_PLUGIN_IS(Waiting)
