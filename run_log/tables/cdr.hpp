// CDR as ROS 2 has it in a log: four bytes that name the encoding, then values in their order, each aligned to its own
// size, little-endian.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "mcap/records.hpp"

namespace muster::run_log {

static_assert(sizeof(double) == 8 && __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);

class CdrWriter {
 public:
  // Begins a message in the buffer, whose content goes.
  explicit CdrWriter(std::string& to) : to_(to) { to_.assign("\0\1\0\0", head); }

  template <class Number>
  CdrWriter& put(Number value) {
    align(sizeof value);
    to_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  CdrWriter& reals(const double* values, std::size_t count) {
    if (count == 0) return *this;
    align(sizeof(double));
    to_.append(reinterpret_cast<const char*>(values), count * sizeof(double));
    return *this;
  }
  CdrWriter& text(std::string_view value) {
    put(static_cast<std::uint32_t>(value.size() + 1));
    to_.append(value);
    to_ += '\0';
    return *this;
  }
  CdrWriter& bytes(const void* first, std::size_t count) {
    put(static_cast<std::uint32_t>(count));
    to_.append(static_cast<const char*>(first), count);
    return *this;
  }
  // The length of a sequence, whose elements follow.
  CdrWriter& count(std::size_t elements) { return put(static_cast<std::uint32_t>(elements)); }

  std::string_view message() const { return to_; }

 private:
  static constexpr std::size_t head = 4;
  void align(std::size_t size) { to_.append((size - (to_.size() - head) % size) % size, '\0'); }
  std::string& to_;
};

// Throws mcap::Malformed where the message ends before a value does.
class CdrReader {
 public:
  explicit CdrReader(std::string_view message) : from_(message) {
    const std::string_view encoding = from_.bytes(4, "the head of a message");
    if (encoding[0] != 0 || encoding[1] != 1)
      throw mcap::Malformed(0, "a message in another encoding than little-endian CDR");
  }

  template <class Number>
  Number number() {
    align(sizeof(Number));
    Number value;
    std::memcpy(&value, from_.bytes(sizeof value, "a number").data(), sizeof value);
    return value;
  }
  double real() { return number<double>(); }
  // Of 1, 2, 4 or 8 bytes.
  std::uint64_t whole(std::size_t size) {
    align(size);
    std::uint64_t value = 0;
    std::memcpy(&value, from_.bytes(size, "a number").data(), size);
    return value;
  }
  std::uint32_t count(const char* what = "a length") {
    align(4);
    return from_.number(what);
  }
  std::string_view text() {
    const std::uint32_t size = count();
    const std::string_view whole = from_.bytes(size, "a text");
    return whole.substr(0, size > 0 ? size - 1 : 0);
  }
  std::string_view bytes() { return from_.bytes(count(), "bytes"); }
  std::size_t left() const { return from_.left(); }

 private:
  static constexpr std::size_t head = 4;
  void align(std::size_t size) { from_.bytes((size - (from_.at() - head) % size) % size, "padding"); }
  mcap::Cursor from_;
};

}  // namespace muster::run_log
