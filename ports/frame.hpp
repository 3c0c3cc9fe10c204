// Frames: a length, a kind, a body; little endian whatever the computer. docs/reference/bridge_format.md defines those
// of the bridge, whose clients are in bridge/; docs/reference/datagram_format.md those of devices.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace muster::ports {

constexpr std::string_view magic = "MUSTERB1";          // of the format, with its revision
constexpr uint32_t most_bytes = 64u << 20;              // of a frame from a client
constexpr std::size_t header_bytes = sizeof(uint32_t);  // the length, which counts what follows it

enum class Kind : uint8_t { join = 1, tables, rows, state, commands, bye, fault };

// The client sent what is no frame, or not the frame that is due.
struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class FrameWriter {
 public:
  explicit FrameWriter(Kind kind) : bytes_(header_bytes, '\0') { integer<uint8_t>(static_cast<uint8_t>(kind)); }
  template <class Integer>
  void integer(Integer value) {
    for (std::size_t i = 0; i < sizeof value; ++i) bytes_ += static_cast<char>((value >> (8 * i)) & 0xff);
  }
  void real(double value) {
    uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    integer(bits);
  }
  void text(std::string_view text) {
    integer(static_cast<uint32_t>(text.size()));
    bytes_ += text;
  }
  void raw(std::string_view bytes) { bytes_ += bytes; }
  // The whole frame.
  std::string take() {
    const auto length = static_cast<uint32_t>(bytes_.size() - header_bytes);
    for (std::size_t i = 0; i < header_bytes; ++i) bytes_[i] = static_cast<char>((length >> (8 * i)) & 0xff);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

// Reads a frame's kind and body; throws Malformed where they end too early.
class FrameReader {
 public:
  explicit FrameReader(std::string_view bytes) : rest_(bytes) {}
  template <class Integer>
  Integer integer() {
    const std::string_view bytes = raw(sizeof(Integer));
    Integer value = 0;
    for (std::size_t i = 0; i < sizeof value; ++i)
      value = static_cast<Integer>(
          value | static_cast<Integer>(static_cast<Integer>(static_cast<uint8_t>(bytes[i])) << (8 * i)));
    return value;
  }
  double real() {
    const auto bits = integer<uint64_t>();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  std::string_view text() { return raw(integer<uint32_t>()); }
  std::string_view raw(std::size_t count) {
    if (count > rest_.size())
      throw Malformed("a frame that ends " + std::to_string(count - rest_.size()) + " bytes too early");
    const std::string_view result = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return result;
  }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view rest_;
};

}  // namespace muster::ports
