#include "zstandard.hpp"

#include <zstd.h>

#include <new>
#include <stdexcept>

namespace muster::mcap {
namespace {

// On records of 50 robots' poses, twists and wheels, level 1 takes 1.5 to 2 times as long and leaves 19.5 % of the
// bytes instead of 22.3 %; level 3 leaves as many as level 1.
constexpr int level = -3;

}  // namespace

struct Compressor::Context {
  ZSTD_CCtx* zstd = ZSTD_createCCtx();
  ~Context() { ZSTD_freeCCtx(zstd); }
};

Compressor::Compressor() : context_(std::make_unique<Context>()) {
  if (!context_->zstd) throw std::bad_alloc();
}

Compressor::~Compressor() = default;

std::string_view Compressor::compressed(std::string_view bytes) {
  if (const std::size_t bound = ZSTD_compressBound(bytes.size()); frame_.size() < bound) frame_.resize(bound);
  const std::size_t size =
      ZSTD_compressCCtx(context_->zstd, frame_.data(), frame_.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size)) throw std::runtime_error(std::string("libzstd: ") + ZSTD_getErrorName(size));
  return std::string_view(frame_).substr(0, size);
}

std::string decompress(std::string_view frame, std::uint64_t size, std::string& to) {
  to.resize(static_cast<std::size_t>(size));
  const std::size_t got = ZSTD_decompress(to.data(), to.size(), frame.data(), frame.size());
  if (ZSTD_isError(got)) return std::string("cannot be decompressed: ") + ZSTD_getErrorName(got);
  if (got != size) return "has " + std::to_string(got) + " bytes; " + std::to_string(size) + " were declared";
  return "";
}

}  // namespace muster::mcap
