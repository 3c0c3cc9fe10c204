// Values one after another in memory that two processes share, each at a multiple of 8 bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "blackboard.hpp"

namespace muster {

// Thrown where they end beyond the memory.
struct DoesNotFit {};

class ValueWriter {
 public:
  ValueWriter(std::byte* at, std::byte* end) : at_(at), end_(end) {}

  double* put(const double* from, std::size_t count) {
    return reinterpret_cast<double*>(put_bytes(from, count * sizeof(double)));
  }
  void put(uint64_t value) { put_bytes(&value, sizeof value); }
  void put(const std::string& text) {
    put(text.size());
    put_bytes(text.data(), text.size());
  }
  void put(const Blob& blob) {
    put(blob->size());
    put_bytes(blob->data(), blob->size());
  }

 private:
  std::byte* put_bytes(const void* from, std::size_t bytes) {
    const std::size_t whole = (bytes + 7) / 8 * 8;
    if (whole > static_cast<std::size_t>(end_ - at_)) throw DoesNotFit{};
    if (bytes > 0) std::memcpy(at_, from, bytes);
    return std::exchange(at_, at_ + whole);
  }
  std::byte *at_, *end_;
};

// The plugin of the other process may have written anything: nothing is read from beyond the end.
class ValueReader {
 public:
  ValueReader(std::byte* at, std::byte* end) : at_(at), end_(end) {}

  double* numbers(uint64_t count, uint64_t width = 1) {
    if (width > 0 && count > static_cast<std::size_t>(end_ - at_) / sizeof(double) / width) throw DoesNotFit{};
    return reinterpret_cast<double*>(take(count * width * sizeof(double)));
  }
  uint64_t number() {
    uint64_t result;
    std::memcpy(&result, take(sizeof result), sizeof result);
    return result;
  }
  std::string text() {
    const uint64_t size = number();
    return {reinterpret_cast<const char*>(take(size)), size};
  }
  Blob blob() {
    const uint64_t size = number();
    const auto* bytes = reinterpret_cast<const uint8_t*>(take(size));
    return std::make_shared<const std::vector<uint8_t>>(bytes, bytes + size);
  }

 private:
  std::byte* take(uint64_t bytes) {
    const uint64_t whole = (bytes + 7) / 8 * 8;
    if (whole < bytes || whole > static_cast<uint64_t>(end_ - at_)) throw DoesNotFit{};
    return std::exchange(at_, at_ + whole);
  }
  std::byte *at_, *end_;
};

}  // namespace muster
