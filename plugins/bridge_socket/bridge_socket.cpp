// Drives robots by a program outside, in lock step, over a socket of this computer.
#include <iterator>

#include "session.hpp"

namespace {

using namespace muster;
using bridge::Port;
using bridge::Session;

enum Silence { fail, stop, hold };

constexpr Param params[] = {
    reference("robot", "robot", "the robot that it is bound to; by default none, as a controller of a whole team"),
    text("reads", "", "tables for the client, with blanks between: robot/{robot}/odometry inbox/{robot}/message"),
    text("writes", "", "tables that the client commands: robot/{robot}/command outbox/{robot}/message"),
    integer("port", 47474, 0, 65535,
            "TCP port of 127.0.0.1; 0: one that is free, which the message names; only without socket"),
    text("socket", "", "path of a Unix socket to listen at instead, from the folder in which muster runs"),
    real("wait", 60, 0, 1e6, "s", "how long it waits for a client to come"),
    real("timeout", 10, 0, 1e6, "s", "how long it waits for an answer"),
    choice("on_silence", "fail|stop|hold",
           "without an answer: the run ends, commands are zero, or the last ones go on")};

constexpr auto manual =
    "Each tick it sends the tables of `reads` to a client, waits for rows of the tables of `writes`, and publishes "
    "them.\n"
    "bridge/muster_client.py and bridge/muster_client.hpp are clients; docs/reference/bridge_format.md has the "
    "format.\n"
    "A client sees what any controller may claim: what robots sense, their inboxes, and no truth; with `robot`, that\n"
    "robot's alone. A table that is not standard has its columns behind it: robot/a/own(x[m] y[m]).\n"
    "With on_silence=\"stop\" or \"hold\" a silent client costs `timeout` once; the run goes on without it until it\n"
    "answers, or another comes. Queues then get nothing. What is no frame of the format ends the run in any case.\n"
    "Where the environment has MUSTER_BRIDGE=off, as in `muster check`, it waits for nobody and commands zero.";

struct Bridge {
  const muster_host* host;
  std::vector<Port> ports;
  Silence silence;
  Session session;
};

bridge::SessionSettings settings_of(const muster_host* host) {
  const char* path = host->text(host, "socket");
  return {static_cast<uint16_t>(host->param(host, "port")), path ? path : "", host->param(host, "wait"),
          host->param(host, "timeout"), static_cast<Silence>(host->param(host, "on_silence")) == fail};
}

void* create(const muster_host* host) {
  Bridge* made = nullptr;
  detail::guarded(host, [&] {
    const int robot = static_cast<int>(host->param(host, "robot"));
    auto ports = bridge::claimed_ports(host, {"reads", false, "odometry"}, robot);
    auto commands = bridge::claimed_ports(host, {"writes", true, "command"}, robot);
    if (commands.empty())
      throw BadInput("has no tables to be commanded; expected an attribute writes=\"robot/NAME/command\"");
    ports.insert(ports.end(), commands.begin(), commands.end());
    made = new Bridge{host, ports, static_cast<Silence>(host->param(host, "on_silence")),
                      Session(settings_of(host), ports)};
  });
  return made;
}

void destroy(void* self) { delete static_cast<Bridge*>(self); }

int step(void* self, const muster_tick* tick, const muster_in* in, const muster_out* out) {
  Bridge& bridge = *static_cast<Bridge*>(self);
  const bool fine = detail::guarded(bridge.host, [&] {
    std::vector<bridge::GivenRows> given;
    if (!bridge::is_off()) given = bridge.session.exchange(bridge.host, *tick, in, out);
    auto next = given.begin();
    for (const auto& port : bridge.ports) {
      if (!port.is_written) continue;
      if (next != given.end())
        next++->set(bridge.host, out[port.claim]);
      else if (bridge.silence == hold)
        set_last(port, in[port.claim], out[port.claim]);
      else
        set_rest(port, out[port.claim]);
    }
  });
  return fine ? MUSTER_OK : MUSTER_FAILED;
}

}  // namespace

MUSTER_DECLARE_ABI
extern "C" int muster_register(uint32_t abi, void* registry, muster_add add) {
  static const muster_plugin plugin{sizeof(muster_plugin),
                                    MUSTER_CONTROL,
                                    "bridge.socket/1",
                                    "drives robots by a program outside, in lock step over a socket",
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
