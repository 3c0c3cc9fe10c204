// The controller of toys/control_pair.cpp as a client. usage: pair SOCKET_OR_PORT
#include <algorithm>
#include <charconv>
#include <iostream>

#include "bridge/muster_client.hpp"

namespace {

muster_client::Client connected(const std::string& at) {
  uint16_t port = 0;
  std::from_chars(at.data(), at.data() + at.size(), port);
  return port ? muster_client::connect(port) : muster_client::connect(at);
}

void drive(muster_client::Client& run, const std::string& name, const std::string& other, uint64_t turn) {
  const auto here = run.row("robot/" + name + "/odometry");
  double v = 0.3 - 0.05 * here["x"], w = 0.4 - 0.2 * here["yaw"];
  for (const auto& message : run.rows("inbox/" + name + "/message")) {
    v += 0.001 * message["rssi"];
    w += 0.01 * static_cast<double>(message.bytes("payload").size());
    if (message.name("from") == "base") w += 1;
  }
  run.set("robot/" + name + "/command", {v, w});
  if (run.tick() % 5 != turn) return;
  const auto& radios = run.names("radio");
  const auto to = static_cast<double>(std::find(radios.begin(), radios.end(), other) - radios.begin());
  run.send("outbox/" + name + "/message", {{"to", run.tick() % 2 ? muster_client::null : to}},
           "tick " + std::to_string(run.tick()));
}

}  // namespace

int main(int, char** argv) {
  auto run = connected(argv[1]);
  while (run.next()) {
    drive(run, "east", "west", 0);
    drive(run, "west", "east", 1);
  }
  std::cout << run.end() << '\n';
}
