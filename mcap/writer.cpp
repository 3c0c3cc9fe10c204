#include "writer.hpp"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <utility>

#include "text/error.hpp"
#include "text/whole_file.hpp"

namespace muster::mcap {
namespace {

constexpr std::size_t most_numbers = 65'535;  // of schemas, of channels: they have two bytes

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& path) { return path.string() + ".part"; }

Writer::Writer(const std::filesystem::path& path, const Header& header, std::filesystem::path temporary)
    : path_(path), part_(std::move(temporary)) {
  fd_ = open_part(part_, IfHeld::fails);
  if (fd_ < 0) fail_system();
  std::string begin(magic);
  put_record(begin, header);
  write(begin);
}

Writer::~Writer() {
  if (fd_ >= 0) close_part(fd_);
}

void Writer::discard() {
  if (fd_ < 0) return;
  ::unlink(part_.c_str());
  close_part(std::exchange(fd_, -1));
}

std::uint16_t Writer::schema(Schema schema) {
  if (schemas_.size() >= most_numbers)
    throw Error(Exit::io, {path_.string()}, "cannot hold more than 65535 kinds of tables");
  schema.id = static_cast<std::uint16_t>(schemas_.size() + 1);
  put_record(loose_, schema);
  schemas_.push_back(std::move(schema));
  return schemas_.back().id;
}

std::uint16_t Writer::channel(Channel channel) {
  if (channels_.size() >= most_numbers)
    throw Error(Exit::io, {path_.string()}, "cannot hold more than 65535 channels; record fewer rows or tables");
  channel.id = static_cast<std::uint16_t>(channels_.size());
  put_record(loose_, channel);
  channels_.push_back(std::move(channel));
  counts_.push_back(0);
  entries_.emplace_back();
  return channels_.back().id;
}

void Writer::message(const Message& message) {
  const bool is_full = chunk_has_messages_ &&
                       (chunk_.size() + message.data.size() > chunk_bytes ||
                        std::max(message.log_time, last_time_) - std::min(message.log_time, first_time_) > chunk_time);
  if (is_full) close_chunk();
  if (!std::exchange(chunk_has_messages_, true)) first_time_ = last_time_ = message.log_time;
  first_time_ = std::min(first_time_, message.log_time);
  last_time_ = std::max(last_time_, message.log_time);
  auto& entries = entries_[message.channel];
  if (entries.empty()) in_chunk_.push_back(message.channel);
  entries.push_back({message.log_time, chunk_.size()});
  put_record(chunk_, message);
  ++counts_[message.channel];
  ++messages_;
  begin_ = std::min(begin_, message.log_time);
  end_ = std::max(end_, message.log_time);
}

void Writer::metadata(const Metadata& metadata) {
  flush();
  std::string record;
  put_record(record, metadata);
  metadata_.push_back({written_, record.size(), metadata.name});
  write(record);
}

void Writer::flush() {
  close_chunk();
  write(loose_);
  loose_.clear();
}

void Writer::close_chunk() {
  if (!chunk_has_messages_) return;
  put_chunk(compressor_.compressed(chunk_), crc32(0, chunk_));
  chunk_.clear();
  chunk_has_messages_ = false;
}

void Writer::put_chunk(std::string_view compressed, std::uint32_t crc) {
  out_.clear();
  out_ += loose_;
  loose_.clear();
  ChunkIndex index{.first_time = first_time_,
                   .last_time = last_time_,
                   .start = written_ + out_.size(),
                   .length = 0,
                   .index_length = 0,
                   .compressed = compressed.size(),
                   .size = chunk_.size(),
                   .indices = {}};
  const auto begun = begin_record(out_, Opcode::chunk);
  put(out_, first_time_);
  put(out_, last_time_);
  put(out_, std::uint64_t{chunk_.size()});
  put(out_, crc);
  put(out_, std::string_view("zstd"));
  put(out_, std::uint64_t{compressed.size()});
  out_ += compressed;
  end_record(out_, begun);
  index.length = written_ + out_.size() - index.start;
  put_indices(index);
  write(out_);
  chunks_.push_back(std::move(index));
}

void Writer::put_indices(ChunkIndex& index) {
  const std::size_t first = out_.size();
  std::sort(in_chunk_.begin(), in_chunk_.end());
  for (const std::uint16_t channel : in_chunk_) {
    index.indices[channel] = written_ + out_.size();
    const auto begun = begin_record(out_, Opcode::message_index);
    put(out_, channel);
    put(out_, static_cast<std::uint32_t>(entries_[channel].size() * sizeof(Entry)));
    static_assert(std::endian::native == std::endian::little && sizeof(Entry) == 16);
    out_.append(reinterpret_cast<const char*>(entries_[channel].data()), entries_[channel].size() * sizeof(Entry));
    end_record(out_, begun);
    entries_[channel].clear();
  }
  in_chunk_.clear();
  index.index_length = out_.size() - first;
}

void Writer::put_statistics(std::string& to) const {
  const auto begun = begin_record(to, Opcode::statistics);
  put(to, messages_);
  put(to, static_cast<std::uint16_t>(schemas_.size()));
  put(to, static_cast<std::uint32_t>(channels_.size()));
  put(to, std::uint32_t{0});  // attachments
  put(to, static_cast<std::uint32_t>(metadata_.size()));
  put(to, static_cast<std::uint32_t>(chunks_.size()));
  put(to, messages_ > 0 ? begin_ : 0);
  put(to, end_);
  std::string counts;
  for (const Channel& channel : channels_) put(counts, channel.id), put(counts, counts_[channel.id]);
  put(to, std::string_view(counts));
  end_record(to, begun);
}

// Schemas, channels, statistics and indices in groups, where each group is, and the footer.
void Writer::put_summary() {
  std::string summary, offsets;
  const auto group = [&](Opcode opcode, auto&& put_all) {
    const std::size_t first = summary.size();
    put_all();
    if (summary.size() == first) return;
    const auto begun = begin_record(offsets, Opcode::summary_offset);
    put(offsets, static_cast<std::uint8_t>(opcode));
    put(offsets, std::uint64_t{written_ + first});
    put(offsets, std::uint64_t{summary.size() - first});
    end_record(offsets, begun);
  };
  group(Opcode::schema, [&] {
    for (const Schema& schema : schemas_) put_record(summary, schema);
  });
  group(Opcode::channel, [&] {
    for (const Channel& channel : channels_) put_record(summary, channel);
  });
  group(Opcode::statistics, [&] { put_statistics(summary); });
  group(Opcode::metadata_index, [&] {
    for (const MetadataIndex& index : metadata_) {
      const auto begun = begin_record(summary, Opcode::metadata_index);
      put(summary, index.start);
      put(summary, index.length);
      put(summary, std::string_view(index.name));
      end_record(summary, begun);
    }
  });
  group(Opcode::chunk_index, [&] {
    for (const ChunkIndex& chunk : chunks_) {
      const auto begun = begin_record(summary, Opcode::chunk_index);
      for (const std::uint64_t value : {chunk.first_time, chunk.last_time, chunk.start, chunk.length})
        put(summary, value);
      std::string indices;
      for (const auto& [channel, start] : chunk.indices) put(indices, channel), put(indices, start);
      put(summary, std::string_view(indices));
      put(summary, chunk.index_length);
      put(summary, std::string_view("zstd"));
      put(summary, chunk.compressed);
      put(summary, chunk.size);
      end_record(summary, begun);
    }
  });
  const std::uint64_t summary_start = written_, offset_start = written_ + summary.size();
  summary += offsets;
  const auto begun = begin_record(summary, Opcode::footer);
  put(summary, summary_start);
  put(summary, offset_start);
  end_record(summary, begun);
  const std::uint64_t footer_bytes = 8 + 8 + 4;  // the checksum covers the length, which counts the checksum, too
  summary[begun - 8] = static_cast<char>(footer_bytes);
  put(summary, crc32(0, summary));
  summary += magic;
  write(summary);
}

std::uint64_t Writer::close() {
  flush();
  std::string end;
  const auto begun = begin_record(end, Opcode::data_end);
  put(end, crc_);
  end_record(end, begun);
  write(end);
  put_summary();
  if (::fsync(fd_) != 0 && errno != EINVAL) fail_system();
  if (::rename(part_.c_str(), path_.c_str()) != 0) fail_system();
  close_part(std::exchange(fd_, -1));
  return written_;
}

void Writer::write(std::string_view bytes) {
  crc_ = crc32(crc_, bytes);
  written_ += bytes.size();
  if (!write_all(fd_, bytes)) fail_system();
}

void Writer::fail_system() const { throw Error(Exit::io, {path_.string()}, why_unwritten(errno)); }

}  // namespace muster::mcap
