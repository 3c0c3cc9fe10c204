#include "sha256.hpp"

#include <nettle/sha2.h>

#include <array>
#include <fstream>

#include "text/error.hpp"

namespace muster::bundle {

std::string sha256_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const auto refuse = [&] { throw Error(Exit::io, file.string() + ": cannot be read"); };
  if (!in) refuse();
  sha256_ctx hash;
  sha256_init(&hash);
  std::array<char, 1 << 16> bytes;
  while (in) {
    in.read(bytes.data(), bytes.size());
    sha256_update(&hash, static_cast<std::size_t>(in.gcount()), reinterpret_cast<const std::uint8_t*>(bytes.data()));
  }
  if (in.bad()) refuse();
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
  sha256_digest(&hash, digest.size(), digest.data());
  std::string result;
  for (const std::uint8_t byte : digest) {
    constexpr char digits[] = "0123456789abcdef";
    result += digits[byte >> 4], result += digits[byte & 15];
  }
  return result;
}

}  // namespace muster::bundle
