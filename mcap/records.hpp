// The records of an MCAP file (https://mcap.dev/spec, version 0) as bytes, little-endian, and back.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace muster::mcap {

inline constexpr std::string_view magic{"\x89MCAP0\r\n", 8};

enum class Opcode : std::uint8_t {
  header = 1,
  footer,
  schema,
  channel,
  message,
  chunk,
  message_index,
  chunk_index,
  attachment,
  attachment_index,
  statistics,
  metadata,
  metadata_index,
  summary_offset,
  data_end
};
inline constexpr std::size_t head_bytes = 9;  // of each record: opcode, and length of what follows

using Texts = std::map<std::string, std::string>;

struct Header {
  std::string profile, library;
};

struct Schema {
  std::uint16_t id = 0;  // from 1 on; 0 means none
  std::string name, encoding, data;
};

struct Channel {
  std::uint16_t id = 0, schema = 0;
  std::string topic, encoding;
  Texts metadata{};
};

// Times are nanoseconds. The data are a view: of the buffer that was read, or of what is to be written.
struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0, publish_time = 0;
  std::string_view data;
};

struct Metadata {
  std::string name;
  Texts values;
};

struct Chunk {
  std::uint64_t first_time = 0, last_time = 0;  // of its messages
  std::uint64_t size = 0;                       // before compression
  std::uint32_t crc = 0;                        // of the records before compression; 0: none
  std::string compression;
  std::string_view records;  // compressed
};

// ---- Writing ----

void put(std::string& to, std::uint8_t value);
void put(std::string& to, std::uint16_t value);
void put(std::string& to, std::uint32_t value);
void put(std::string& to, std::uint64_t value);
void put(std::string& to, std::string_view text);  // its length in four bytes first
void put(std::string& to, const Texts& texts);

// Appends opcode and a length to be filled in; the result goes to end_record().
std::size_t begin_record(std::string& to, Opcode opcode);
void end_record(std::string& to, std::size_t begun);

void put_record(std::string& to, const Header& header);
void put_record(std::string& to, const Schema& schema);
void put_record(std::string& to, const Channel& channel);
void put_record(std::string& to, const Message& message);
void put_record(std::string& to, const Metadata& metadata);

// ---- Reading ----

// A fault of a record: the byte of its body, and what is wrong there.
struct Malformed : std::runtime_error {
  Malformed(std::size_t byte, const std::string& fault) : std::runtime_error(fault), at(byte) {}
  std::size_t at;
};

// Takes values from a record's body. Each throws Malformed where the body ends before the value does.
class Cursor {
 public:
  explicit Cursor(std::string_view body) : body_(body) {}
  std::size_t at() const { return at_; }
  std::size_t left() const { return body_.size() - at_; }

  std::uint8_t byte(const char* what);
  std::uint16_t word(const char* what);
  std::uint32_t number(const char* what);
  std::uint64_t large(const char* what);
  std::string_view bytes(std::uint64_t count, const char* what);
  std::string_view text(const char* what) { return bytes(number(what), what); }
  Texts texts(const char* what);

 private:
  template <class Number>
  Number little_endian(const char* what);
  std::string_view body_;
  std::size_t at_ = 0;
};

Header read_header(std::string_view body);
Schema read_schema(std::string_view body);
Channel read_channel(std::string_view body);
Message read_message(std::string_view body);
Metadata read_metadata(std::string_view body);
Chunk read_chunk(std::string_view body);

// The CRC-32 of zlib, continued.
std::uint32_t crc32(std::uint32_t so_far, std::string_view bytes);

}  // namespace muster::mcap
