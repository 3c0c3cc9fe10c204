// The archive of a bundle, a tar file compressed by zstd. What is unpacked is taken for hostile: files with plain
// relative names, within limits, are all that comes out of it, and none takes another's place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace muster::bundle {

struct Limits {
  std::size_t files = 10'000;
  std::uint64_t bytes_of_one = std::uint64_t{1} << 30;
  std::uint64_t bytes = std::uint64_t{2} << 30;  // of all
};

// Why the name of a file is not taken: empty where it is. It is taken where it is a path from the folder down, each
// part of it a plain name.
std::string fault_of_name(const std::string& name);

// Writes the files of the folder by these names, in this order. `file` must not be there; it is whole or not at all.
// Throws Error.
void pack(const std::filesystem::path& folder, const std::vector<std::string>& names, const std::filesystem::path& file,
          const Limits& limits = {});

// Unpacks into an empty folder. Throws Error at the first entry that is not a plain file within the limits; what was
// unpacked before it stays, inside of the folder.
void unpack(const std::filesystem::path& file, const std::filesystem::path& folder, const Limits& limits = {});

}  // namespace muster::bundle
