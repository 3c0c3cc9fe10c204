// What an MCAP file holds, channel by channel, for a reader.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mcap/scan.hpp"
#include "text/json.hpp"

namespace muster::cli {

struct LogContents {
  struct Channel {
    std::string topic, type, encoding;
    std::uint64_t messages = 0, bytes = 0;
    std::uint64_t first_time = 0, last_time = 0;  // ns
  };
  std::string file;
  mcap::Scan scan;
  std::vector<Channel> channels;  // by topic
  std::vector<mcap::Metadata> metadata;
  std::uint64_t messages = 0, first_time = 0, last_time = 0;
};

// Damages are listed in the scan. Throws Error where it is no MCAP file.
LogContents contents_of(const std::filesystem::path& file);

Json json_of(const LogContents& contents);
void print(const LogContents& contents);

}  // namespace muster::cli
