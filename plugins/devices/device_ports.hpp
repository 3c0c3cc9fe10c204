// What plugins in the place of a robot's hardware share: their tables, and tables of their own about them.
#pragma once

#include <algorithm>
#include <ctime>
#include <string>
#include <vector>

#include "ports/ports.hpp"

namespace muster::devices {

// "odometry" of robot/a/odometry, "scan" of scan/a/message.
inline std::string short_name(const ports::Port& port) {
  return port.is_queue ? port.table.substr(0, port.table.find('/')) : port.table.substr(port.table.rfind('/') + 1);
}

// The tables that a device fills, one robot's each. Throws BadInput.
inline std::vector<ports::Port> filled_ports(const muster_host* host, int robot) {
  auto result = ports::claimed_ports(host, {"writes", true, "odometry", MUSTER_SENSED}, robot);
  for (const auto& port : result) {
    if (!port.set.empty() || (port.is_queue && !port.has_one_owner))
      throw BadInput(
          "attribute \"writes\": \"" + port.table + "\" has all rows; expected those of one robot, such as " +
          port.table.substr(0, port.table.find('/')) + "/{robot}" + port.table.substr(port.table.rfind('/')));
  }
  return result;
}

// The commands that it takes: rows, one robot's each. Throws BadInput.
inline std::vector<ports::Port> command_ports(const muster_host* host, int robot) {
  auto result = ports::claimed_ports(host, {"reads", false, "command"}, robot);
  for (const auto& port : result) {
    if (!port.set.empty() || port.is_queue)
      throw BadInput("attribute \"reads\": \"" + port.table +
                     "\" is no row; expected commands of one robot, such as robot/{robot}/command");
  }
  return result;
}

// The same order at both ends of a link, whatever the world files have.
inline void sort_by_name(std::vector<ports::Port>& ports) {
  std::sort(ports.begin(), ports.end(), [](const auto& a, const auto& b) { return a.general < b.general; });
}

// The rows of these tables as the body of a datagram; without queues where `has_queues` is not set.
inline std::string rows_of(const std::vector<ports::Port>& ports, const muster_host* host, const muster_in* in,
                           bool has_queues = true) {
  ports::FrameWriter frame(ports::Kind::rows);
  for (const auto& port : ports) {
    muster_in rows = in[port.claim];
    if (port.is_queue && !has_queues) rows.rows = 0;
    ports::write_rows(frame, port, host, rows, ports::References::names);
  }
  return frame.take().substr(ports::header_bytes + 1);
}

// Those rows of the body of a datagram. Throws ports::Malformed.
inline std::vector<ports::GivenRows> given_rows(const std::vector<ports::Port>& ports, const muster_host* host,
                                                std::string_view body) {
  ports::FrameReader reader(body);
  std::vector<ports::GivenRows> result;
  for (const auto& port : ports) result.emplace_back(reader, port, host, 1, ports::References::names);
  if (reader.left()) throw ports::Malformed(std::to_string(reader.left()) + " bytes too many behind the rows");
  return result;
}

// Larger each time that a program starts.
inline std::uint64_t new_session() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(now.tv_nsec);
}

using ports::seconds_text;

// What `muster check` is to say of a world in which nothing is wrong.
inline void note(const muster_host* host, const std::string& message) {
  const char* place = host->text(host, "self/place");
  host->event(host, ("note: " + (place ? place + std::string(": ") : "") + message).c_str());
}

// A table of the plugin's own; throws where the kernel refuses it.
inline int own_table(const muster_host* host, const std::string& name, const std::string& columns) {
  const int claim = host->claim(host, MUSTER_WRITE, 0, ("self/" + name).c_str(), columns.c_str());
  if (claim < 0) throw std::runtime_error("");
  return claim;
}

}  // namespace muster::devices
