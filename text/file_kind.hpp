// Files of other kinds, told by their first bytes, for messages of those who expect something else.
#pragma once

#include <string>
#include <string_view>

namespace muster {

// "a DXF drawing", "a flight plan of QGroundControl", "JSON", "XML", "an MCAP file", "a bag of ROS 2 in SQLite", "a bag
// of ROS 1", "compressed by gzip" or "a snapshot of muster"; empty for other bytes.
std::string file_kind(std::string_view bytes);

// The kind of the file's first bytes; empty also where it cannot be read.
std::string file_kind_of(const std::string& path);

}  // namespace muster
