// Commands of a controller to a robot beside a velocity, from a table: each row from its time on.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct TestAsks {
  static constexpr auto id = "test.asks/1";
  static constexpr auto summary = "goals, car-like commands or resets of odometry from a table";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("robot", "robot", "the robot it asks").required(),
                                     choice("what", "goal2d|car_command|odometry_reset", "the table it writes"),
                                     file("plan", "what it asks for and from when").required()};
  struct Planned {
    static constexpr const char* columns = "t[s] a? b? c?";
    double t, a, b, c;
  };

  explicit TestAsks(Setup& s) : what(s.value("what")), plan(s.file<Planned>("plan")) {
    if (s.param("what") == 0) goal = s.write<Goal2d>("robot/{robot}/goal2d");
    if (s.param("what") == 1) car = s.write<CarCommand>("robot/{robot}/car_command");
    if (s.param("what") == 2) reset = s.write<OdometryReset>("robot/{robot}/odometry_reset");
  }

  void step(const Step& k) const {
    Planned now{0, null(), null(), null()};
    double count = 0;
    for (const Planned& p : k[plan]) {
      if (p.t < k.time() - k.dt() / 2) now = p, ++count;
    }
    const auto or_0 = [](double value) { return is_null(value) ? 0 : value; };
    if (k[what] == 0) *k[goal] = {now.a, now.b, now.c};
    if (k[what] == 1) *k[car] = {or_0(now.a), or_0(now.b)};
    if (k[what] == 2) *k[reset] = {or_0(now.a), or_0(now.b), or_0(now.c), count};
  }

  Value what;
  In<Planned> plan;
  Out<Goal2d> goal{};
  Out<CarCommand> car{};
  Out<OdometryReset> reset{};
};

}  // namespace

MUSTER_PLUGIN_IS(TestAsks)
