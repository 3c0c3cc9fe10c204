#include "log_contents.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "text/number.hpp"

namespace muster::cli {
namespace {

class Counter : public mcap::Visitor {
 public:
  explicit Counter(LogContents& contents) : contents_(contents) {}
  void schema(const mcap::Schema& schema) override { types_[schema.id] = schema.name; }
  void channel(const mcap::Channel& channel) override {
    auto& counted = channels_[channel.id];
    counted.topic = channel.topic;
    counted.encoding = channel.encoding;
    counted.type = types_[channel.schema];
  }
  void message(const mcap::Message& message, const std::string&) override {
    auto& channel = channels_[message.channel];
    count(channel.messages, channel.first_time, channel.last_time, message.log_time);
    channel.bytes += message.data.size();
    count(contents_.messages, contents_.first_time, contents_.last_time, message.log_time);
  }
  void metadata(const mcap::Metadata& metadata) override { contents_.metadata.push_back(metadata); }

  void finish() {
    for (auto& [id, channel] : channels_) contents_.channels.push_back(channel);
    std::stable_sort(contents_.channels.begin(), contents_.channels.end(),
                     [](const auto& a, const auto& b) { return a.topic < b.topic; });
  }

 private:
  static void count(std::uint64_t& messages, std::uint64_t& first, std::uint64_t& last, std::uint64_t time) {
    if (messages++ == 0) first = last = time;
    first = std::min(first, time), last = std::max(last, time);
  }
  LogContents& contents_;
  std::map<std::uint16_t, std::string> types_;
  std::map<std::uint16_t, LogContents::Channel> channels_;
};

double seconds(std::uint64_t time) { return static_cast<double>(time) / 1e9; }

// Text of a file may be anything; what is no text of UTF-8 cannot be in JSON, and control characters not on a terminal.
std::string printable(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7f)
      result += c;
    else
      result += fmt::format("\\x{:02x}", byte);
  }
  return result;
}

}  // namespace

LogContents contents_of(const std::filesystem::path& file) {
  LogContents result;
  result.file = file.string();
  Counter counter(result);
  result.scan = mcap::scan(file, counter, mcap::Damage::skipped);
  counter.finish();
  return result;
}

Json json_of(const LogContents& contents) {
  Json channels = Json::array(), metadata = Json::object();
  for (const auto& channel : contents.channels)
    channels.push_back({{"topic", printable(channel.topic)},
                        {"type", printable(channel.type)},
                        {"encoding", printable(channel.encoding)},
                        {"messages", channel.messages},
                        {"bytes", channel.bytes},
                        {"from", seconds(channel.first_time)},
                        {"to", seconds(channel.last_time)}});
  for (const auto& one : contents.metadata) {
    Json values = Json::object();
    for (const auto& [name, value] : one.values) values[printable(name)] = printable(value);
    metadata[printable(one.name)] = values;
  }
  return {{"file", contents.file},
          {"bytes", contents.scan.bytes},
          {"whole", contents.scan.is_whole && contents.scan.damages.empty()},
          {"damages", contents.scan.damages},
          {"profile", printable(contents.scan.profile)},
          {"library", printable(contents.scan.library)},
          {"messages", contents.messages},
          {"from", seconds(contents.first_time)},
          {"to", seconds(contents.last_time)},
          {"chunks", contents.scan.chunks},
          {"bytes_in_chunks", contents.scan.packed},
          {"bytes_before_compression", contents.scan.unpacked},
          {"attachments", contents.scan.attachments},
          {"metadata", metadata},
          {"channels", channels}};
}

void print(const LogContents& contents) {
  const mcap::Scan& scan = contents.scan;
  fmt::print("{}: {:.2f} MB by {}, profile {}\n", contents.file, static_cast<double>(scan.bytes) / 1e6,
             scan.library.empty() ? "nobody" : printable(scan.library),
             scan.profile.empty() ? "none" : printable(scan.profile));
  for (const auto& one : contents.metadata) {
    fmt::print("  {}:", printable(one.name));
    for (const auto& [name, value] : one.values) fmt::print(" {}={}", printable(name), printable(value));
    fmt::print("\n");
  }
  fmt::print("  {} messages, {} s to {} s\n", contents.messages, print_real(seconds(contents.first_time)),
             print_real(seconds(contents.last_time)));
  fmt::print("  {} chunks, {:.2f} MB of {:.2f} MB before compression\n", scan.chunks,
             static_cast<double>(scan.packed) / 1e6, static_cast<double>(scan.unpacked) / 1e6);
  std::size_t topics = 5, types = 4;
  for (const auto& channel : contents.channels) {
    topics = std::max(topics, printable(channel.topic).size());
    types = std::max(types, printable(channel.type).size());
  }
  fmt::print("\n  {:<{}}  {:<{}}  {:>9}  {:>9}  {:>9}\n", "topic", topics, "type", types, "messages", "per s", "kB");
  for (const auto& channel : contents.channels) {
    const double lasts = seconds(channel.last_time - channel.first_time);
    const std::string rate =
        lasts > 0 ? fmt::format("{:.4g}", static_cast<double>(channel.messages - 1) / lasts) : std::string("-");
    fmt::print("  {:<{}}  {:<{}}  {:>9}  {:>9}  {:>9.1f}\n", printable(channel.topic), topics, printable(channel.type),
               types, channel.messages, rate, static_cast<double>(channel.bytes) / 1e3);
  }
  if (scan.attachments > 0) fmt::print("\n  and {} attachments\n", scan.attachments);
  for (const std::string& damage : scan.damages) fmt::print("\n  {}\n", printable(damage));
  if (!scan.damages.empty()) fmt::print("  `muster log recover {}` saves what is whole\n", contents.file);
}

}  // namespace muster::cli
