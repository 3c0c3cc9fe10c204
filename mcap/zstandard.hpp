// Zstandard: compression of chunks, by libzstd.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace muster::mcap {

class Compressor {
 public:
  Compressor();
  ~Compressor();
  // A frame; valid until the next call.
  std::string_view compressed(std::string_view bytes);

 private:
  struct Context;
  std::unique_ptr<Context> context_;
  std::string frame_;
};

// Replaces `to` by the frame's content, which must have `size` bytes. Empty if that is so; otherwise what is wrong.
std::string decompress(std::string_view frame, std::uint64_t size, std::string& to);

}  // namespace muster::mcap
