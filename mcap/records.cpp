#include "records.hpp"

#include <zlib.h>

namespace muster::mcap {
namespace {

template <class Number>
char* store(char* to, Number value) {
  for (std::size_t i = 0; i < sizeof value; ++i) *to++ = static_cast<char>(value >> (8 * i) & 255);
  return to;
}

template <class Number>
void put_little_endian(std::string& to, Number value) {
  char bytes[sizeof value];
  store(bytes, value);
  to.append(bytes, sizeof value);
}

}  // namespace

void put(std::string& to, std::uint8_t value) { to += static_cast<char>(value); }
void put(std::string& to, std::uint16_t value) { put_little_endian(to, value); }
void put(std::string& to, std::uint32_t value) { put_little_endian(to, value); }
void put(std::string& to, std::uint64_t value) { put_little_endian(to, value); }

void put(std::string& to, std::string_view text) {
  put(to, static_cast<std::uint32_t>(text.size()));
  to += text;
}

void put(std::string& to, const Texts& texts) {
  std::string list;
  for (const auto& [name, value] : texts) put(list, std::string_view(name)), put(list, std::string_view(value));
  put(to, std::string_view(list));
}

std::size_t begin_record(std::string& to, Opcode opcode) {
  to += static_cast<char>(opcode);
  put(to, std::uint64_t{0});
  return to.size();
}

void end_record(std::string& to, std::size_t begun) {
  const std::uint64_t length = to.size() - begun;
  for (std::size_t i = 0; i < 8; ++i) to[begun - 8 + i] = static_cast<char>(length >> (8 * i) & 255);
}

void put_record(std::string& to, const Header& header) {
  const auto begun = begin_record(to, Opcode::header);
  put(to, std::string_view(header.profile));
  put(to, std::string_view(header.library));
  end_record(to, begun);
}

void put_record(std::string& to, const Schema& schema) {
  const auto begun = begin_record(to, Opcode::schema);
  put(to, schema.id);
  for (const std::string* text : {&schema.name, &schema.encoding, &schema.data}) put(to, std::string_view(*text));
  end_record(to, begun);
}

void put_record(std::string& to, const Channel& channel) {
  const auto begun = begin_record(to, Opcode::channel);
  put(to, channel.id);
  put(to, channel.schema);
  put(to, std::string_view(channel.topic));
  put(to, std::string_view(channel.encoding));
  put(to, channel.metadata);
  end_record(to, begun);
}

// In one piece: a log has millions of them.
void put_record(std::string& to, const Message& message) {
  constexpr std::size_t fields = 2 + 4 + 8 + 8;
  char head[head_bytes + fields];
  char* next = store(head, static_cast<std::uint8_t>(Opcode::message));
  next = store(next, std::uint64_t{fields + message.data.size()});
  next = store(next, message.channel);
  next = store(next, message.sequence);
  next = store(next, message.log_time);
  store(next, message.publish_time);
  to.append(head, sizeof head);
  to += message.data;
}

void put_record(std::string& to, const Metadata& metadata) {
  const auto begun = begin_record(to, Opcode::metadata);
  put(to, std::string_view(metadata.name));
  put(to, metadata.values);
  end_record(to, begun);
}

template <class Number>
Number Cursor::little_endian(const char* what) {
  const std::string_view taken = bytes(sizeof(Number), what);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < taken.size(); ++i)
    value |= std::uint64_t{static_cast<unsigned char>(taken[i])} << (8 * i);
  return static_cast<Number>(value);
}

std::uint8_t Cursor::byte(const char* what) { return little_endian<std::uint8_t>(what); }
std::uint16_t Cursor::word(const char* what) { return little_endian<std::uint16_t>(what); }
std::uint32_t Cursor::number(const char* what) { return little_endian<std::uint32_t>(what); }
std::uint64_t Cursor::large(const char* what) { return little_endian<std::uint64_t>(what); }

std::string_view Cursor::bytes(std::uint64_t count, const char* what) {
  if (count > left())
    throw Malformed(at_, std::string(what) + " of " + std::to_string(count) + " bytes, of which " +
                             std::to_string(left()) + " are left in the record");
  const std::string_view result = body_.substr(at_, static_cast<std::size_t>(count));
  at_ += result.size();
  return result;
}

Texts Cursor::texts(const char* what) {
  const std::size_t size = number(what), end = at_ + size;
  if (size > left()) throw Malformed(at_, std::string(what) + " beyond the end of the record");
  Texts result;
  while (at_ < end) {
    const auto name = std::string(text(what));
    result[name] = text(what);
  }
  if (at_ > end) throw Malformed(at_, std::string(what) + " longer than their own length");
  return result;
}

Header read_header(std::string_view body) {
  Cursor from(body);
  Header result;
  result.profile = from.text("the profile");
  result.library = from.text("the name of the library");
  return result;
}

Schema read_schema(std::string_view body) {
  Cursor from(body);
  Schema result;
  result.id = from.word("a schema's number");
  if (result.id == 0) throw Malformed(0, "a schema has the number 0; expected one from 1 on");
  result.name = from.text("a schema's name");
  result.encoding = from.text("a schema's encoding");
  result.data = from.text("a schema's data");
  return result;
}

Channel read_channel(std::string_view body) {
  Cursor from(body);
  Channel result;
  result.id = from.word("a channel's number");
  result.schema = from.word("a channel's schema");
  result.topic = from.text("a channel's topic");
  result.encoding = from.text("a channel's encoding");
  result.metadata = from.texts("a channel's metadata");
  return result;
}

Message read_message(std::string_view body) {
  Cursor from(body);
  Message result;
  result.channel = from.word("a message's channel");
  result.sequence = from.number("a message's sequence");
  result.log_time = from.large("a message's time");
  result.publish_time = from.large("a message's time");
  result.data = from.bytes(from.left(), "a message's data");
  return result;
}

Metadata read_metadata(std::string_view body) {
  Cursor from(body);
  Metadata result;
  result.name = from.text("the name of metadata");
  result.values = from.texts("metadata");
  return result;
}

Chunk read_chunk(std::string_view body) {
  Cursor from(body);
  Chunk result;
  result.first_time = from.large("a chunk's time");
  result.last_time = from.large("a chunk's time");
  result.size = from.large("a chunk's size");
  result.crc = from.number("a chunk's checksum");
  result.compression = from.text("a chunk's compression");
  result.records = from.bytes(from.large("a chunk's records"), "a chunk's records");
  return result;
}

std::uint32_t crc32(std::uint32_t so_far, std::string_view bytes) {
  return static_cast<std::uint32_t>(::crc32_z(so_far, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace muster::mcap
