#include "payload.hpp"

#include <zlib.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "packed_table.hpp"

namespace muster::viewer {
namespace {

constexpr const char* magic = "MUSTERV1";

std::string thinned_note(const RecordedTable& table, std::uint64_t keep_every) {
  return table.table + ": of every " + std::to_string(keep_every) + " recorded times one is in the page; " +
         table.file + " has all";
}

}  // namespace

// Water filling: no table keeps more than a level at which all fit.
std::vector<std::uint64_t> thinning(const std::vector<std::uint64_t>& numbers, std::uint64_t most_numbers) {
  std::vector<std::uint64_t> sorted = numbers;
  std::sort(sorted.begin(), sorted.end());
  std::uint64_t left = most_numbers, level = most_numbers;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    level = std::max<std::uint64_t>(1, left / (sorted.size() - i));
    if (sorted[i] > level) break;
    left -= sorted[i];
    level = most_numbers;
  }
  std::vector<std::uint64_t> result;
  for (const std::uint64_t n : numbers) result.push_back(std::max<std::uint64_t>(1, (n + level - 1) / level));
  return result;
}

Payload payload_of(const RecordFolder& record, std::uint64_t most_numbers) {
  std::vector<std::unique_ptr<TableToPack>> tables;
  std::vector<std::uint64_t> numbers;
  for (const RecordedTable& declared : record.tables) {
    tables.push_back(std::make_unique<TableToPack>(record, declared));
    numbers.push_back(tables.back()->numbers());
  }
  const auto keep_every = thinning(numbers, most_numbers);
  Payload result;
  std::string bytes;
  Json packed = Json::array();
  for (std::size_t i = 0; i < tables.size(); ++i) {
    packed.push_back(tables[i]->packed(keep_every[i], bytes));
    if (keep_every[i] > 1) result.notes.push_back(thinned_note(record.tables[i], keep_every[i]));
  }
  const std::string head = "{\"run\":" + record.run + ",\"scene\":" + record.scene + ",\"tables\":" + packed.dump() +
                           ",\"notes\":" + Json(result.notes).dump() + "}";
  result.container = magic;
  for (int i = 0; i < 4; ++i) result.container += static_cast<char>(head.size() >> (8 * i) & 255);
  result.container += head;
  result.container += bytes;
  return result;
}

std::string gzipped(const std::string& bytes) {
  z_stream stream{};
  constexpr int with_gzip_header = 15 + 16;
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, with_gzip_header, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib cannot begin");
  std::string result(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  const int done = deflate(&stream, Z_FINISH);
  const std::size_t size = stream.total_out;
  deflateEnd(&stream);
  if (done != Z_STREAM_END) throw std::runtime_error("zlib cannot pack the page's data");
  result.resize(size);
  return result;
}

std::string base64(const std::string& bytes) {
  static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t b = 0; b < 3; ++b)
      three = three << 8 | (i + b < bytes.size() ? static_cast<unsigned char>(bytes[i + b]) : 0u);
    for (std::size_t letter = 0; letter < 4; ++letter)
      result += i + letter <= bytes.size() ? letters[three >> (18 - 6 * letter) & 63] : '=';
  }
  return result;
}

}  // namespace muster::viewer
