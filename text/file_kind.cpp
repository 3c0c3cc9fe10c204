#include "text/file_kind.hpp"

#include <array>
#include <fstream>

namespace muster {
namespace {

std::string_view line_of(std::string_view& rest) {
  const std::size_t end = rest.find('\n');
  std::string_view line = rest.substr(0, end);
  rest = end == rest.npos ? std::string_view() : rest.substr(end + 1);
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
  return line;
}

// Pairs of lines, a code and its value; the first is "0, SECTION", perhaps behind comments of code 999.
bool is_dxf(std::string_view rest) {
  for (int pair = 0; pair < 8 && !rest.empty(); ++pair) {
    const std::string_view code = line_of(rest), value = line_of(rest);
    if (code == "0" && value == "SECTION") return true;
    if (code != "999") return false;
  }
  return false;
}

}  // namespace

std::string file_kind(std::string_view bytes) {
  if (bytes.starts_with("\x89MCAP")) return "an MCAP file";
  if (bytes.starts_with("SQLite format 3")) return "a bag of ROS 2 in SQLite";
  if (bytes.starts_with("#ROSBAG V")) return "a bag of ROS 1";
  if (bytes.starts_with("\x1F\x8B")) return "compressed by gzip";
  if (bytes.starts_with("\x28\xB5\x2F\xFD")) return "compressed by zstd";
  if (bytes.starts_with("\xFD"
                        "7zXZ"))
    return "compressed by xz";
  if (bytes.starts_with("BZh")) return "compressed by bzip2";
  if (bytes.starts_with("\x89HDF")) return "an HDF5 file";
  if (bytes.starts_with("\x89PNG") || bytes.starts_with("\xFF\xD8\xFF")) return "a picture";
  if (bytes.starts_with("%PDF")) return "a PDF document";
  if (bytes.starts_with("\x7F"
                        "ELF"))
    return "a program or a library";
  if (bytes.starts_with("PAR1")) return "a Parquet file";
  if (bytes.starts_with("muster.snapshot.")) return "a snapshot of muster";
  if (bytes.starts_with("QGC WPL ") || bytes.starts_with("\xEF\xBB\xBFQGC WPL "))
    return "a flight plan of QGroundControl";
  if (is_dxf(bytes)) return "a DXF drawing";
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  const char c = first == bytes.npos ? '\0' : bytes[first];
  if (c == '{') return "JSON";
  if (c == '[') {  // a list, and no column without a name
    const std::size_t next = bytes.find_first_not_of(" \t\r\n", first + 1);
    if (next != bytes.npos && std::string_view("[{\"-0123456789").find(bytes[next]) != std::string_view::npos)
      return "JSON";
  }
  return c == '<' ? "XML" : "";
}

std::string file_kind_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 256> bytes{};
  file.read(bytes.data(), bytes.size());
  return file_kind({bytes.data(), static_cast<std::size_t>(file.gcount())});
}

}  // namespace muster
