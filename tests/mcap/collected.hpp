// A file's content in the memory of a test, and small files to read.
#pragma once

#include <string>
#include <vector>

#include "mcap/scan.hpp"
#include "mcap/writer.hpp"
#include "tests/folder.hpp"

namespace muster::test {

struct Collected : mcap::Visitor {
  struct Kept {
    std::string topic;
    std::uint32_t sequence;
    std::uint64_t time;
    std::string data;
    bool operator==(const Kept&) const = default;
  };
  void schema(const mcap::Schema& schema) override { schemas[schema.id] = schema; }
  void channel(const mcap::Channel& channel) override { channels[channel.id] = channel; }
  void message(const mcap::Message& m, const std::string&) override {
    messages.push_back({channels.at(m.channel).topic, m.sequence, m.log_time, std::string(m.data)});
  }
  void metadata(const mcap::Metadata& one) override { all_metadata.push_back(one); }

  std::map<std::uint16_t, mcap::Schema> schemas;
  std::map<std::uint16_t, mcap::Channel> channels;
  std::vector<Kept> messages;
  std::vector<mcap::Metadata> all_metadata;
};

// Two channels, so many messages of each, a hundredth of a second apart. Returns what a reader has to find.
inline std::vector<Collected::Kept> write_log(const std::filesystem::path& file, std::uint32_t count,
                                              std::size_t bytes = 40) {
  mcap::Writer writer(file, {"test", "mcap_test"});
  const auto schema = writer.schema({0, "test/msg/Text", "ros2msg", "string text\n"});
  const std::uint16_t channels[] = {writer.channel({0, schema, "/first", "cdr", {{"a", "b"}}}),
                                    writer.channel({0, schema, "/second", "cdr", {}})};
  writer.metadata({"about", {{"world", "hall"}, {"seed", "7"}}});
  std::vector<Collected::Kept> result;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const std::uint16_t channel : channels) {
      std::string data = std::to_string(i) + (channel ? " second" : " first");
      for (std::uint32_t k = 0; data.size() < bytes; ++k)
        data += static_cast<char>((i * 2654435761u + k * 40503u) >> 7);
      const std::uint64_t time = i * 10'000'000ull;
      writer.message({channel, i, time, time, data});
      result.push_back({channel ? "/second" : "/first", i, time, data});
    }
  }
  writer.close();
  return result;
}

}  // namespace muster::test
