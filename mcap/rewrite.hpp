// Writes what is whole of an MCAP file, or what lies in a span of time, as a file of its own.
#pragma once

#include <filesystem>

#include "scan.hpp"

namespace muster::mcap {

// A channel with this metadatum holds what stands from then on, such as walls: it is in every span of time.
inline constexpr const char* still = "still";

// Nanoseconds; messages from `first` up to but without `end`.
struct Span {
  std::uint64_t first = 0, end = ~std::uint64_t{0};
};

struct Rewritten {
  Scan scan;                                    // of the file that was read
  std::uint64_t messages = 0;                   // written
  std::uint64_t first_time = 0, last_time = 0;  // of them; 0 where there are none
  std::uint64_t bytes = 0;                      // of the new file
};

// With Damage::skipped this recovers a damaged file. Both names may be the same. Throws Error.
Rewritten rewrite(const std::filesystem::path& from, const std::filesystem::path& to, Damage damage,
                  const Span& span = {});

}  // namespace muster::mcap
