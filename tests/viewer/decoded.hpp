// Decodes a payload as the page does, independently of the code that writes it.
#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace muster::test {

using Read = nlohmann::json;

struct Opened {
  Read head;
  std::string bytes;
};

inline Opened opened(const std::string& container) {
  if (container.substr(0, 8) != "MUSTERV1") throw std::runtime_error("no payload");
  std::uint32_t size = 0;
  std::memcpy(&size, container.data() + 8, 4);
  return {Read::parse(container.substr(12, size)), container.substr(12 + size)};
}

template <class T>
T number_at(const std::string& bytes, std::size_t at) {
  T value;
  if (at + sizeof(T) > bytes.size()) throw std::out_of_range("the payload is too short");
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

inline std::int64_t integer_at(const std::string& bytes, const Read& code, std::size_t row) {
  const std::string type = code["type"];
  const std::size_t at = code["at"];
  if (type == "i8") return number_at<std::int8_t>(bytes, at + row);
  if (type == "i16") return number_at<std::int16_t>(bytes, at + 2 * row);
  if (type == "i32") return number_at<std::int32_t>(bytes, at + 4 * row);
  if (type == "u8") return number_at<std::uint8_t>(bytes, at + row);
  if (type == "u16") return number_at<std::uint16_t>(bytes, at + 2 * row);
  if (type == "u32") return number_at<std::uint32_t>(bytes, at + 4 * row);
  throw std::runtime_error("no such type: " + type);
}

inline std::vector<double> scaled_numbers(const Read& code, const std::string& bytes) {
  const std::string type = code["type"];
  const std::int64_t lowest = type == "i8" ? -128 : type == "i16" ? -32768 : std::numeric_limits<std::int32_t>::min();
  const double odd[] = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                        -std::numeric_limits<double>::infinity()};
  std::vector<double> result;
  std::int64_t k = 0;
  for (std::size_t row = 0; row < code["count"]; ++row) {
    const std::int64_t stored = integer_at(bytes, code, row);
    k = code["delta"] ? k + stored : stored;
    if (!code["delta"] && k < lowest + 3)
      result.push_back(odd[k - lowest]);
    else if (code.contains("by"))
      result.push_back(static_cast<double>(k) / code["by"].get<double>());
    else
      result.push_back(static_cast<double>(k) * code["step"].get<double>());
  }
  return result;
}

inline std::vector<double> numbers(const Read& code, const std::string& bytes) {
  const std::string kind = code["kind"];
  const std::size_t count = code["count"];
  if (kind == "constant") return std::vector<double>(count, code["value"].get<double>());
  if (kind == "scaled") return scaled_numbers(code, bytes);
  if (kind != "planes") throw std::runtime_error("no such code: " + kind);
  std::vector<double> result;
  std::uint64_t word = 0;
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t plane = 0; plane < 8; ++plane)
      word ^= std::uint64_t{number_at<std::uint8_t>(bytes, code["at"].get<std::size_t>() + plane * count + row)}
              << (8 * plane);
    double value;
    std::memcpy(&value, &word, 8);
    result.push_back(value);
  }
  return result;
}

inline std::vector<std::string> names(const Read& code, const std::string& bytes) {
  std::vector<std::string> result;
  for (std::size_t row = 0; row < code["count"]; ++row)
    result.push_back(code["levels"][static_cast<std::size_t>(integer_at(bytes, code, row))]);
  return result;
}

// A column of a table, by their names.
inline const Read& column(const Read& table, const std::string& name) {
  for (const Read& one : table["columns"]) {
    if (one["name"] == name) return one["code"];
  }
  throw std::runtime_error("no column " + name);
}

}  // namespace muster::test
