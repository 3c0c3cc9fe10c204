// Puts a record into the form that a page carries: base64 of gzip of a container.
//
// The container is "MUSTERV1", the length of its head as 32 bits, the head as JSON, and the bytes that the head refers
// to. The head:
//   {"run", "scene": as in run.json, "tables": [...], "notes": [...]}
// A table has its rows grouped by key: the robot, the radio, or the number of the row. Group i is rows starts[i] to
// starts[i + 1].
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "record_folder.hpp"

namespace muster::viewer {

struct Payload {
  std::string container;
  std::vector<std::string> notes;  // tables that were thinned, for the user
};

// `most_numbers`: in all tables. The longest tables are thinned until they fit. Throws Error.
Payload payload_of(const RecordFolder& record, std::uint64_t most_numbers);

// Of every so many recorded times one is kept, table by table, so that all of them hold at most so many numbers.
std::vector<std::uint64_t> thinning(const std::vector<std::uint64_t>& numbers, std::uint64_t most_numbers);

std::string gzipped(const std::string& bytes);
std::string base64(const std::string& bytes);

}  // namespace muster::viewer
