// A robot of hardware, or its stand-in, in the place of a simulated one: over UDP, at the pace of the clock.
#include <cstdio>
#include <iterator>
#include <memory>
#include <muster/plugin.hpp>

#include "device_ports.hpp"
#include "link.hpp"
#include "pace.hpp"

namespace {

using namespace muster;
using ports::GivenRows;
using ports::Port;

enum Silence { stop, hold, fail };

constexpr Param params[] = {
    reference("robot", "robot", "the robot that is driven").required(),
    text("writes", "robot/{robot}/odometry robot/{robot}/stall", "tables that it fills with what the robot senses"),
    text("reads", "robot/{robot}/command", "commands that the robot is sent"),
    text("address", "127.0.0.1", "where the robot is"),
    integer("port", 47480, 1, 65535, "its UDP port"),
    real("wait", 60, 0, 1e6, "s", "how long the run waits for the robot at its start; 0: it begins at once"),
    real("deadline", 0.5, 1e-3, 1e6, "s", "a robot that was not heard for longer is silent"),
    choice("on_silence", "stop|hold|fail",
           "a silent robot is sent zero commands, or the controller's, or the run ends"),
    real("speed", 1, 1e-3, 1e6, "", "times real time, as the robot's clock goes: for trials with host.udp")};

constexpr auto manual =
    "Each tick it sends the controller's commands, waits for the tick's moment on the clock on the wall, and "
    "publishes\n"
    "what has come: of a table the latest row, of a queue all messages. So a run goes at the pace of the clock, with "
    "or\n"
    "without --real-time; one that is later than `deadline` does not catch up.\n"
    "Datagrams that are lost, late, twice there, malformed or from elsewhere are counted in self/link and never taken; "
    "the\n"
    "format is docs/reference/datagram_format.md. A robot is asked until it speaks, and a world whose tables it does "
    "not\n"
    "exchange ends the run. What was sensed last stays while it is silent.\n"
    "Where the environment has MUSTER_BRIDGE=off, as in `muster check`, nobody is sent anything.";

// Columns of self/link.
struct Status {
  static constexpr const char* columns =
      "silent age[s]? round_trip[s]? sent received lost late duplicate malformed foreign left_out";
  double silent, age, round_trip, sent, received, lost, late, duplicate, malformed, foreign, left_out;
};

// What exists while the run goes on: no state of the world.
struct Connection {
  Connection(const devices::Address& own, const devices::Address& robot, std::vector<devices::TableShape> shapes)
      : socket(own), end(socket, robot, std::move(shapes), devices::new_session()), pace(clock) {}
  devices::UdpSocket socket;
  devices::ControllerEnd end;
  devices::SteadyClock clock;
  devices::Pace pace;
  double begun = 0;  // [s] of the run
};

struct Device {
  const muster_host* host;
  std::vector<Port> filled, commands;
  int status;
  devices::Address robot;
  std::unique_ptr<Connection> connection;
  double left_out = 0;  // messages about rows that this world does not have

  double param(const char* name) const { return host->param(host, name); }
};

void* create(const muster_host* host) {
  Device* made = nullptr;
  detail::guarded(host, [&] {
    const int robot = static_cast<int>(host->param(host, "robot"));
    auto filled = devices::filled_ports(host, robot), commands = devices::command_ports(host, robot);
    if (filled.empty()) throw BadInput("fills no table; expected an attribute writes=\"robot/{robot}/odometry\"");
    devices::sort_by_name(filled);
    devices::sort_by_name(commands);
    const int status = devices::own_table(host, "link", Status::columns);
    const char* address = host->text(host, "address");
    made = new Device{host,
                      filled,
                      commands,
                      status,
                      devices::address_of(address ? address : "", static_cast<uint16_t>(host->param(host, "port"))),
                      nullptr};
  });
  return made;
}

void destroy(void* self) {
  auto* device = static_cast<Device*>(self);
  if (device->connection) device->connection->end.say_bye(0);
  delete device;
}

void connect(Device& device) {
  std::vector<Port> both = device.filled;
  both.insert(both.end(), device.commands.begin(), device.commands.end());
  const bool is_here = device.robot.host >> 24 == 127;
  device.connection = std::make_unique<Connection>(devices::address_of(is_here ? "127.0.0.1" : "0.0.0.0", 0),
                                                   device.robot, devices::shapes_of(both, true));
}

// What has come: the latest rows of a table, all messages of a queue.
using Arrived = std::vector<std::vector<GivenRows>>;  // a datagram, a table

void take_arrived(Device& device, double now, Arrived& arrived) {
  device.connection->end.receive(now, [&](std::string_view body) {
    arrived.push_back(devices::given_rows(device.filled, device.host, body));
    for (const GivenRows& rows : arrived.back()) device.left_out += rows.left_out();
  });
}

// Until the robot has been heard for the first time.
void wait_for_robot(Device& device, double now, Arrived& arrived) {
  constexpr double slice = 0.02;  // [s] between two questions
  Connection& connection = *device.connection;
  const double most = device.param("wait");
  if (most > 0) {
    const char* place = device.host->text(device.host, "self/place");
    std::fprintf(stderr, "%s: device.udp waits %s for the robot at %s\n", place ? place : "muster",
                 devices::seconds_text(most).c_str(), device.robot.text().c_str());
  }
  for (const double began = connection.clock.now(); most > 0 && !connection.end.has_heard();) {
    if (connection.clock.now() - began > most)
      throw BadInput("no robot answered at " + device.robot.text() + " within " + devices::seconds_text(most) +
                     "; expected one to be started, such as a world with <host.udp/>, or a longer wait");
    connection.end.ask(now);
    connection.clock.sleep(slice);
    take_arrived(device, now, arrived);
  }
}

void send_commands(const Device& device, const muster_in* in, double now, bool is_silent) {
  if (!device.connection->end.has_heard()) return;  // what a controller makes of nothing moves no robot
  if (!is_silent || device.param("on_silence") != stop) {
    device.connection->end.command(now, devices::rows_of(device.commands, device.host, in));
    return;
  }
  std::vector<double> zeros;
  std::vector<muster_in> at_rest;
  for (const Port& port : device.commands) zeros.resize(std::max(zeros.size(), port.columns.size()));
  for (const Port& port : device.commands) {
    at_rest.resize(std::max(at_rest.size(), static_cast<std::size_t>(port.claim) + 1));
    at_rest[static_cast<std::size_t>(port.claim)] = {zeros.data(), 1, static_cast<uint32_t>(port.columns.size()), 0};
  }
  device.connection->end.command(now, devices::rows_of(device.commands, device.host, at_rest.data()));
}

Status status_of(const Device& device, double now, bool is_silent) {
  const auto& end = device.connection->end;
  const auto& counts = end.from_robot().counts();
  const auto real = [](std::uint64_t count) { return static_cast<double>(count); };
  return {is_silent ? 1.0 : 0.0,
          end.has_heard() ? now - end.heard() : null(),
          end.round_trip() < 0 ? null() : end.round_trip(),
          real(end.sent()),
          real(counts.received),
          real(counts.lost),
          real(counts.late),
          real(counts.duplicate),
          real(end.refused().malformed),
          real(end.refused().foreign),
          device.left_out};
}

// Silence and its end are events.
void tell_silence(const Device& device, bool was_silent, bool is_silent) {
  if (was_silent == is_silent) return;
  const std::string robot = "the robot at " + device.robot.text();
  if (!is_silent) return device.host->event(device.host, (robot + " is heard again").c_str());
  const bool has_left = device.connection->end.has_left();
  const std::string what =
      robot + (has_left ? " has left" : " was not heard for " + devices::seconds_text(device.param("deadline")));
  if (device.param("on_silence") == fail)
    throw BadInput(what + "; on_silence=\"stop\" or \"hold\" would go on without it");
  detail::warn(device.host, "self", what);
}

void publish(const Device& device, const Arrived& arrived, const muster_in* in, const muster_out* out) {
  for (std::size_t p = 0; p < device.filled.size(); ++p) {
    const Port& port = device.filled[p];
    uint32_t first = 0;
    for (const auto& datagram : arrived) {
      if (port.is_queue) datagram[p].set(device.host, out[port.claim], first), first += datagram[p].rows();
    }
    if (port.is_queue) continue;
    if (arrived.empty())
      set_last(port, in[port.claim], out[port.claim]);
    else
      arrived.back()[p].set(device.host, out[port.claim]);
  }
}

void drive(Device& device, const muster_tick& tick, const muster_in* in, const muster_out* out) {
  const double now = tick.time, deadline = device.param("deadline");
  const Status last = *reinterpret_cast<const Status*>(in[device.status].data);
  const auto is_silent = [&] {
    const auto& end = device.connection->end;
    return end.has_left() || now - (end.has_heard() ? end.heard() : device.connection->begun) > deadline;
  };
  Arrived arrived;
  if (!device.connection) {
    connect(device);
    device.connection->begun = now;
    wait_for_robot(device, now, arrived);
  } else {
    send_commands(device, in, now, last.silent != 0);
  }
  const double speed = device.param("speed");
  if (const double late = device.connection->pace.wait(now, speed, deadline / speed); late > 0)
    detail::warn(device.host, "self", "the run was " + devices::seconds_text(late) + " late, and goes on from there");
  take_arrived(device, now, arrived);
  if (is_silent() || !device.connection->end.has_agreed()) device.connection->end.ask(now);
  tell_silence(device, tick.index > 0 && last.silent != 0, is_silent());
  publish(device, arrived, in, out);
  *reinterpret_cast<Status*>(out[device.status].data) = status_of(device, now, is_silent());
}

// Nobody is there, and nobody is waited for.
void rest(const Device& device, const muster_in* in, const muster_out* out) {
  for (const Port& port : device.filled) set_last(port, in[port.claim], out[port.claim]);
  *reinterpret_cast<Status*>(out[device.status].data) = {1, null(), null(), 0, 0, 0, 0, 0, 0, 0, 0};
}

int step(void* self, const muster_tick* tick, const muster_in* in, const muster_out* out) {
  Device& device = *static_cast<Device*>(self);
  const bool fine = detail::guarded(device.host, [&] {
    if (tick->index == 0)
      devices::note(
          device.host,
          "a run of this world goes at the pace of the clock on the wall, as with --real-time: the robot at " +
              device.robot.text() + " waits for nobody");
    if (ports::is_off()) return rest(device, in, out);
    try {
      drive(device, *tick, in, out);
    } catch (const devices::Interrupted&) {
      throw BadInput("interrupted while it waited for the robot at " + device.robot.text());
    }
  });
  return fine ? MUSTER_OK : MUSTER_FAILED;
}

}  // namespace

MUSTER_DECLARE_ABI
extern "C" int muster_register(uint32_t abi, void* registry, muster_add add) {
  static const muster_plugin plugin{sizeof(muster_plugin),
                                    MUSTER_SENSE,
                                    "device.udp/1",
                                    "a robot over UDP in the place of a simulated one, at the pace of the clock",
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
