// Serialises numbers to bytes, for state without a fixed number of columns.
#pragma once

#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace muster::medium {

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);  // no padding
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void put_all(const std::vector<T>& values) {
    static_assert(std::is_arithmetic_v<T>);
    put(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void put_text(std::string_view text) {
    put(text.size());
    bytes_ += text;
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Throws std::runtime_error if the bytes end early.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  void get(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    std::memcpy(&value, next(sizeof value).data(), sizeof value);
  }
  template <class T>
  T get() {
    T value;
    get(value);
    return value;
  }
  template <class T>
  void get_all(std::vector<T>& values) {
    static_assert(std::is_arithmetic_v<T>);
    values.resize(count(sizeof(T)));
    if (!values.empty()) std::memcpy(values.data(), next(values.size() * sizeof(T)).data(), values.size() * sizeof(T));
  }
  // A number of things of so many bytes each or more: no more than can follow.
  std::size_t count(std::size_t least = 1) {
    const auto things = get<std::size_t>();
    if (things > bytes_.size() / least) fail();
    return things;
  }
  bool is_at_end() const { return bytes_.empty(); }
  std::string_view text() { return next(get<std::size_t>()); }

 private:
  [[noreturn]] static void fail() { throw std::runtime_error("the network's state ends too early"); }
  std::string_view next(std::size_t bytes) {
    if (bytes > bytes_.size()) fail();
    const std::string_view result = bytes_.substr(0, bytes);
    bytes_.remove_prefix(bytes);
    return result;
  }
  std::string_view bytes_;
};

}  // namespace muster::medium
