// Contents of messages, for tests.
#pragma once

#include <string>

#include "muster/random.hpp"
#include "world_of.hpp"

namespace muster {

// Of a row of the inbox.
inline std::string payload(const Simulation& world, std::size_t row) {
  const TableView inbox = world.table("inbox/*/message");
  const auto blob = static_cast<std::size_t>(inbox.at(row, Incoming::payload_column));
  if (blob == 0) return "";
  const auto& bytes = *inbox.table->now().blobs[blob - 1];
  return {bytes.begin(), bytes.end()};
}

// Payload of test.sender in a tick.
inline std::string sent(std::size_t size, uint64_t tick) {
  std::string result(size, '\0');
  for (std::size_t i = 0; i < size; ++i) result[i] = static_cast<char>(mixed(i + tick));
  return result;
}

}  // namespace muster
