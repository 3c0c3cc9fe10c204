// The other end of device.udp: this run is the robot, which a controller elsewhere drives by datagrams.
#include <cstdio>
#include <iterator>
#include <memory>
#include <muster/plugin.hpp>
#include <optional>

#include "device_ports.hpp"
#include "link.hpp"
#include "pace.hpp"

namespace {

using namespace muster;
using ports::GivenRows;
using ports::Port;

constexpr Param params[] = {
    reference("robot", "robot", "the robot that is driven").required(),
    text("reads", "robot/{robot}/odometry robot/{robot}/stall", "what it senses, for the controller"),
    text("writes", "robot/{robot}/command", "commands that it takes"),
    text("address", "127.0.0.1", "where it listens; 0.0.0.0: at every network of this computer"),
    integer("port", 47480, 1, 65535, "its UDP port"),
    real("watchdog", 0.5, 1e-3, 1e6, "s", "without a command for longer it stops, as a base of hardware does"),
    real("speed", 1, 1e-3, 1e6, "", "times real time"),
    real("loss", 0, 0, 1, "", "share of the datagrams of either direction that is lost, for trying"),
    real("delay", 0, 0, 10, "s", "by which each is late"),
    real("jitter", 0, 0, 10, "s", "by which each is later still, at random from 0 to this")};

constexpr auto manual =
    "The robot moves in this world's physics at the pace of the clock. Before each tick the controller is sent what "
    "the\n"
    "robot senses, and the latest command that has come holds over the tick. It is a controller to this world: what "
    "it\n"
    "may tell is what any controller may claim, and no truth.\n"
    "The first controller that asks, and exchanges the same tables, drives; another is refused until that one has "
    "been\n"
    "silent for `watchdog`. self/link counts datagrams. Time is the run's, so `watchdog` and `delay` are the same at "
    "any\n"
    "`speed`; `loss`, `delay` and `jitter` are drawn from the world's seed.\n"
    "Where the environment has MUSTER_BRIDGE=off, nobody is heard, and commands are zero.";

// Columns of self/link.
struct Status {
  static constexpr const char* columns = "stopped age[s]? received lost late duplicate malformed foreign";
  double stopped, age, received, lost, late, duplicate, malformed, foreign;
};

// What exists while the run goes on: no state of the world.
struct Connection {
  Connection(const devices::Address& at, const devices::RoughWire::Settings& rough, Stream random,
             std::vector<devices::TableShape> shapes)
      : socket(at), wire(socket, rough, random), end(wire, std::move(shapes), devices::new_session()), pace(clock) {}
  devices::UdpSocket socket;
  devices::RoughWire wire;
  devices::RobotEnd end;
  devices::SteadyClock clock;
  devices::Pace pace;
  std::vector<GivenRows> commands;  // the latest
  std::string told;                 // disagreement
  int tellings = 0;
};

struct RobotHost {
  const muster_host* host;
  std::vector<Port> sensed, commands;
  int status;
  devices::Address at;
  Stream random;
  std::unique_ptr<Connection> connection;

  double param(const char* name) const { return host->param(host, name); }
};

void* create(const muster_host* host) {
  RobotHost* made = nullptr;
  detail::guarded(host, [&] {
    const int robot = static_cast<int>(host->param(host, "robot"));
    auto sensed = ports::claimed_ports(host, {"reads", false, "odometry"}, robot);
    auto commands = ports::claimed_ports(host, {"writes", true, "command"}, robot);
    for (const auto& port : commands) {
      if (port.is_queue) throw BadInput("attribute \"writes\": \"" + port.table + "\" is a queue; expected commands");
    }
    if (commands.empty()) throw BadInput("takes no commands; expected an attribute writes=\"robot/{robot}/command\"");
    devices::sort_by_name(sensed);
    devices::sort_by_name(commands);
    const int status = devices::own_table(host, "link", Status::columns);
    const char* address = host->text(host, "address");
    made = new RobotHost{host,
                         sensed,
                         commands,
                         status,
                         devices::address_of(address ? address : "", static_cast<uint16_t>(host->param(host, "port"))),
                         Stream(host->stream(host, "datagrams")),
                         nullptr};
  });
  return made;
}

void destroy(void* self) {
  auto* robot = static_cast<RobotHost*>(self);
  if (robot->connection) robot->connection->end.say_bye(0);
  delete robot;
}

void connect(RobotHost& robot) {
  std::vector<Port> both = robot.sensed;
  both.insert(both.end(), robot.commands.begin(), robot.commands.end());
  robot.connection = std::make_unique<Connection>(
      robot.at, devices::RoughWire::Settings{robot.param("loss"), robot.param("delay"), robot.param("jitter")},
      robot.random, devices::shapes_of(both, false));
  const char* place = robot.host->text(robot.host, "self/place");
  std::fprintf(stderr, "%s: host.udp is a robot at %s\n", place ? place : "muster",
               robot.connection->socket.at().text().c_str());
}

void tell_changes(RobotHost& robot, bool was_stopped, bool is_stopped) {
  Connection& connection = *robot.connection;
  constexpr int most_tellings = 10;  // whoever sends others at every tick fills no list of events
  if (connection.end.disagreement() != connection.told) {
    connection.told = connection.end.disagreement();
    if (!connection.told.empty() && connection.tellings++ < most_tellings)
      detail::warn(robot.host, "self", "refuses a controller: " + connection.told);
  }
  if (was_stopped && !is_stopped)
    robot.host->event(robot.host, ("is driven by " + connection.end.controller().text()).c_str());
  if (!was_stopped && is_stopped)
    robot.host->event(robot.host,
                      connection.end.has_controller()
                          ? ("stops: no command for " + devices::seconds_text(robot.param("watchdog"))).c_str()
                          : "stops: its controller has left");
}

void serve(RobotHost& robot, const muster_tick& tick, const muster_in* in, const muster_out* out) {
  const double now = tick.time - tick.dt;  // of what was sensed, and when the commands begin to hold
  if (!robot.connection) connect(robot);
  Connection& connection = *robot.connection;
  const double speed = robot.param("speed"), watchdog = robot.param("watchdog");
  if (const double late = connection.pace.wait(now, speed, watchdog / speed); late > 0)
    detail::warn(robot.host, "self", "the run was " + devices::seconds_text(late) + " late, and goes on from there");
  connection.wire.at(now);
  connection.end.receive(now, watchdog, [&](std::string_view body) {
    connection.commands = devices::given_rows(robot.commands, robot.host, body);
  });
  const auto& end = connection.end;
  const bool is_stopped = !end.has_heard() || now - end.heard() > watchdog || connection.commands.empty();
  const Status last = *reinterpret_cast<const Status*>(in[robot.status].data);
  tell_changes(robot, tick.index <= 1 || last.stopped != 0, is_stopped);
  for (std::size_t p = 0; p < robot.commands.size(); ++p) {
    const Port& port = robot.commands[p];
    if (is_stopped)
      set_rest(port, out[port.claim]);
    else
      connection.commands[p].set(robot.host, out[port.claim]);
  }
  std::string rows = devices::rows_of(robot.sensed, robot.host, in);
  constexpr std::size_t stamp_bytes = 64;  // more than a frame's head and stamp
  if (rows.size() > devices::most_datagram_bytes - stamp_bytes) {
    detail::warn(robot.host, "self",
                 "messages of " + std::to_string(rows.size()) + " bytes are not sent: a datagram has at most " +
                     std::to_string(devices::most_datagram_bytes));
    rows = devices::rows_of(robot.sensed, robot.host, in, false);
  }
  connection.end.tell(now, rows);
  const auto& counts = end.from_controller().counts();
  const auto real = [](std::uint64_t count) { return static_cast<double>(count); };
  *reinterpret_cast<Status*>(out[robot.status].data) = {is_stopped ? 1.0 : 0.0,
                                                        end.has_heard() ? now - end.heard() : null(),
                                                        real(counts.received),
                                                        real(counts.lost),
                                                        real(counts.late),
                                                        real(counts.duplicate),
                                                        real(end.refused().malformed),
                                                        real(end.refused().foreign)};
}

int step(void* self, const muster_tick* tick, const muster_in* in, const muster_out* out) {
  RobotHost& robot = *static_cast<RobotHost*>(self);
  const bool fine = detail::guarded(robot.host, [&] {
    if (tick->index <= 1)
      devices::note(
          robot.host,
          "a run of this world goes at the pace of the clock on the wall, as with --real-time: a controller at " +
              robot.at.text() + " drives it");
    if (ports::is_off()) {
      for (const Port& port : robot.commands) set_rest(port, out[port.claim]);
      *reinterpret_cast<Status*>(out[robot.status].data) = {1, null(), 0, 0, 0, 0, 0, 0};
      return;
    }
    try {
      serve(robot, *tick, in, out);
    } catch (const devices::Interrupted&) {
      throw BadInput("interrupted while it waited for its next tick");
    }
  });
  return fine ? MUSTER_OK : MUSTER_FAILED;
}

}  // namespace

MUSTER_DECLARE_ABI
extern "C" int muster_register(uint32_t abi, void* registry, muster_add add) {
  static const muster_plugin plugin{sizeof(muster_plugin),
                                    MUSTER_CONTROL,
                                    "host.udp/1",
                                    "this run is a robot that a controller elsewhere drives over UDP",
                                    manual,
                                    params,
                                    std::size(params),
                                    nullptr,
                                    create,
                                    destroy,
                                    step,
                                    nullptr,
                                    nullptr,
                                    nullptr,
                                    nullptr,
                                    nullptr};
  return abi == MUSTER_ABI ? add(registry, &plugin) : MUSTER_FAILED;
}
