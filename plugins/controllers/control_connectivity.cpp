// One robot of a chain that keeps its links: the case study of Fink et al., section 6.
#include <muster/plugin.hpp>
#include <optional>
#include <string>

#include "plugins/own_radio.hpp"
#include "plugins/periods.hpp"
#include "roadmap.hpp"
#include "switching.hpp"

namespace {

using namespace muster;

struct ControlConnectivity {
  static constexpr auto id = "control.connectivity/2";
  static constexpr auto summary = "moves along a roadmap as fast as the links measured on messages allow";
  static constexpr auto manual =
      "Speed along the roadmap = speed x switching((parent - threshold) / width), where `parent` is the smoothed\n"
      "rssi of the messages that came from the radio towards the base: on above the threshold, back below it, at\n"
      "rest on it. A follower holds until its child's link falls to threshold + margin, and is free at half of the\n"
      "margin; it goes back whenever its own parent's link asks for it. So a chain extends only as far as it must,\n"
      "and once it is extended, every link rests at the threshold. A link unheard for `lost` counts as broken.\n"
      "Switching functions: linear (saturated), tanh, relay (full speed but within half a width), hysteresis (linear,\n"
      "but once the link was below the threshold it goes on only when the link is a width above: where a wall makes\n"
      "the link jump across the threshold, the robot rests before the wall instead of going to and fro). The robot\n"
      "knows its own odometry and the messages in its inbox: nothing of the channel, the walls or the others.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot it steers, heard through the radio of the same name").required(),
      file("roadmap", "way points x[m],y[m] from the base to the goal").required(),
      choice("role", "follower|leader", "a leader goes for the goal, a follower serves its child"),
      reference("parent", "radio", "the radio towards the base, whose link it keeps").required(),
      reference("child", "radio", "the radio towards the leader that a follower serves"),
      choice("switching", "linear|tanh|relay|hysteresis", "switching function"),
      real("threshold", -60, -200, 0, "dBm", "rssi at which it rests").free(),
      real("width", 3, 0.01, 50, "dB", "above the threshold by this much it goes at full speed"),
      real("margin", 6, 0.01, 50, "dB", "a follower stays while its child's link is this much above the threshold"),
      real("speed", 0.3, 0, 10, "m/s", "full speed along the roadmap"),
      real("turn_speed", 0.8, 0, 10, "rad/s", "rate of turns on the spot"),
      real("lookahead", 0.6, 0.01, 10, "m", "how far along the roadmap it aims"),
      real("smoothing", 5, 0, 1000, "s", "time constant of the filter of rssi"),
      real("period", 0.5, 0.001, 1000, "s", "of its own messages"),
      real("lost", 5, 0.001, 1000, "s", "a link unheard for so long counts as broken")};

  struct State {
    static constexpr const char* columns =
        "arclength[m]? parent[dBm]? child[dBm]? parent_heard[s] child_heard[s] speed[m/s]";
    double arclength, parent, child;          // null before the first reading
    double parent_heard, child_heard, speed;  // times of the last message from each; speed along the roadmap
  };

  struct Turned {
    static constexpr const char* columns = "turned";
    double turned;  // 1 from when the link was below the threshold until it is a width above
  };

  explicit ControlConnectivity(Setup& s)
      : threshold(s.value("threshold")),
        width(s.value("width")),
        margin(s.value("margin")),
        speed(s.value("speed")),
        turn_speed(s.value("turn_speed")),
        lookahead(s.value("lookahead")),
        smoothing(s.value("smoothing")),
        period(s.value("period")),
        lost(s.value("lost")),
        leads(s.param("role") == 1),
        switching(static_cast<Switching>(s.param("switching"))),
        radio(own_radio(s)),
        parent(s.param("parent")),
        child(s.param("child")),
        way(s.file<Waypoint>("roadmap")),
        odometry(s.read<Odometry>("robot/{robot}/odometry")),
        inbox(s.read<Incoming>("inbox/{robot}/message")),
        command(s.write<Command>("robot/{robot}/command")),
        outbox(s.write<Outgoing>("outbox/{robot}/message")),
        state(s.write<State>("self/state")) {
    for (const char* other : {"parent", "child"}) expect_another_radio(s, other, radio, "the robot's own radio");
    expect_another_radio(s, "child", parent, "the parent already", radio,
                         leads ? "; a leader needs no child" : "; a robot without one is role=\"leader\"");
    if (switching == Switching::hysteresis) turned = s.write<Turned>("self/turned");
    if (!leads && child < 0) throw BadInput("a follower has a child; expected child=\"NAME\" or role=\"leader\"");
  }

  void step(const Step& k) {
    if (roadmap.empty()) roadmap = Roadmap(k[way]);
    State now = *k.last(state);
    listen(k, now);
    const Waypoint here{k[odometry]->x, k[odometry]->y};
    constexpr double reach = 1;  // [m] the robot is localised at most this far along from its last arclength, so that
                                 // it cuts no bend
    now.arclength = is_null(now.arclength) ? roadmap.nearest(here, 0, roadmap.length())
                                           : roadmap.nearest(here, now.arclength - reach, now.arclength + reach);
    now.speed = within_roadmap(now.arclength, k[speed] * urge(k, now));
    const double ahead = now.arclength + (now.speed < 0 ? -k[lookahead] : k[lookahead]);
    *k[command] = pursuit(*k[odometry], roadmap.at(ahead), now.speed, k[turn_speed]);
    *k[state] = now;
    if (is_due(k.time(), k.dt(), k[period])) k.send(outbox, 0, "beacon") = {radio, null(), 0};
  }

  void listen(const Step& k, State& now) const {
    for (const Incoming& message : k[inbox]) {
      if (message.from == parent) hear(k, message, now.parent, now.parent_heard);
      if (message.from == child) hear(k, message, now.child, now.child_heard);
    }
  }

  void hear(const Step& k, const Incoming& message, double& rssi, double& heard) const {
    rssi = is_null(rssi) ? message.rssi : smoothed(rssi, message.rssi, message.t_received - heard, k[smoothing]);
    heard = message.t_received;
  }

  // Command from -1 to 1. Before the first message of a link its quality is unknown, and the robot waits.
  double urge(const Step& k, const State& now) const {
    if (turned) *k[*turned] = *k.last(*turned);
    if (is_null(now.parent)) return 0;
    const bool is_lost = k.time() - now.parent_heard > k[lost];
    const double excess = is_lost ? -1 : (now.parent - k[threshold]) / k[width];
    const double on = turning(k, is_lost ? -1 : switched(switching, excess), excess);
    if (leads || on < 0) return on;
    if (is_null(now.child)) return 0;
    return on * (k.time() - now.child_heard > k[lost] ? 1 : wanted(now.child - k[threshold], k[margin]));
  }

  double turning(const Step& k, double on, double excess) const {
    if (!turned) return on;
    bool has_turned = k.last(*turned)->turned != 0;
    const double result = after_turning(on, excess, has_turned);
    k[*turned]->turned = has_turned;
    return result;
  }

  // Slows down at both ends of the roadmap, with a time constant of a second.
  double within_roadmap(double s, double v) const {
    constexpr double rate = 1;  // [1/s]
    return std::clamp(v, std::min(0.0, -rate * s), std::max(0.0, rate * (roadmap.length() - s)));
  }

  Value threshold, width, margin, speed, turn_speed, lookahead, smoothing, period, lost;
  bool leads;
  Switching switching;
  double radio, parent, child;
  In<Waypoint> way;
  In<Odometry> odometry;
  In<Incoming> inbox;
  Out<Command> command;
  Out<Outgoing> outbox;
  Out<State> state;
  std::optional<Out<Turned>> turned;  // with hysteresis
  Roadmap roadmap;                    // rebuilt from the file
};

}  // namespace

MUSTER_PLUGIN_IS(ControlConnectivity)
