// A plugin with one fault, by the definition of the build: what the compiler says of it is tested.
#include <muster/plugin.hpp>

struct State {
#ifndef NO_COLUMNS
  static constexpr const char* columns = "count";
#endif
  double count;
};

#ifndef PARAM
#define PARAM muster::real("speed", 0, 0, 2, "m/s", "forward speed"), muster::flag("loop", false, "again")
#endif

#ifndef PARAMS
#define PARAMS params
#endif

struct Wrong {
  static constexpr auto id = "test.wrong/1", summary = "is wrong in one place";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr muster::Param PARAMS[] = {PARAM};
  explicit Wrong(muster::Setup& s) : state(s.write<State>("self/state")) {}
  void step(const muster::Step&) const {}
  muster::Out<State> state;
};
MUSTER_PLUGIN_IS(Wrong)
