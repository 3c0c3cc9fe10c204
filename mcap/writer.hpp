// Writes an MCAP file in compressed chunks, under the temporary name FILE.part until it is complete. What was flushed
// is whole: recover() (rewrite.hpp) makes a valid file of it, whenever the program ended.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "records.hpp"
#include "sink.hpp"
#include "zstandard.hpp"

namespace muster::mcap {

// A chunk is closed when it holds so many bytes, or spans so many nanoseconds: the most that a crash loses.
inline constexpr std::size_t chunk_bytes = 256 * 1024;
inline constexpr std::uint64_t chunk_time = 500'000'000;

// "run.mcap.part"
std::filesystem::path temporary_name(const std::filesystem::path& path);

// Every failure to write is an Error with Exit::io.
class Writer : public Sink {
 public:
  Writer(const std::filesystem::path& path, const Header& header) : Writer(path, header, temporary_name(path)) {}
  Writer(const std::filesystem::path& path, const Header& header, std::filesystem::path temporary);
  ~Writer() override;  // without close() before, the temporary file stays as far as it was flushed
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // Numbers are given by the writer. Throws Error after 65,535 of a kind.
  std::uint16_t schema(Schema schema) override;
  std::uint16_t channel(Channel channel) override;
  // On a channel of this writer.
  void message(const Message& message) override;
  void metadata(const Metadata& metadata);

  // Writes what is in memory.
  void flush();
  // Ends the file with its summary, brings it to the disk and renames it. Returns its size.
  std::uint64_t close();
  // Removes the temporary file.
  void discard();

  const std::filesystem::path& path() const { return path_; }

 private:
  struct Entry {
    std::uint64_t time, offset;
  };
  struct ChunkIndex {
    std::uint64_t first_time, last_time, start, length, index_length, compressed, size;
    std::map<std::uint16_t, std::uint64_t> indices;  // a channel's message index: where it is
  };
  struct MetadataIndex {
    std::uint64_t start, length;
    std::string name;
  };

  void close_chunk();
  void put_chunk(std::string_view compressed, std::uint32_t crc);
  void put_indices(ChunkIndex& index);
  void put_summary();
  void put_statistics(std::string& to) const;
  void write(std::string_view bytes);
  [[noreturn]] void fail_system() const;

  std::filesystem::path path_, part_;
  int fd_ = -1;
  std::uint64_t written_ = 0;
  std::uint32_t crc_ = 0;  // of all that was written
  std::string loose_;      // schemas and channels: they go before the chunk that uses them
  std::string chunk_, out_;
  std::uint64_t first_time_ = 0, last_time_ = 0;  // of the chunk
  bool chunk_has_messages_ = false;
  Compressor compressor_;
  std::vector<std::vector<Entry>> entries_;  // a channel: its messages in the chunk
  std::vector<std::uint16_t> in_chunk_;      // channels with messages in it
  std::vector<Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<std::uint64_t> counts_;  // messages of a channel
  std::vector<ChunkIndex> chunks_;
  std::vector<MetadataIndex> metadata_;
  std::uint64_t messages_ = 0, begin_ = ~std::uint64_t{0}, end_ = 0;
};

}  // namespace muster::mcap
