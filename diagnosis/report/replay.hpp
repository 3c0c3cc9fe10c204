// Writes a world that simulates the measured readings, each as a link.
#pragma once

#include <filesystem>
#include <string>

namespace muster::report {

// Writes `file` beside the world: its links are those of `data` (a name in the same folder), and it records their rssi.
// `muster run FILE --expected --out DIR` then records the mean of every reading. Returns `file`. Throws Error.
std::filesystem::path write_replay(const std::filesystem::path& world, const std::string& data,
                                   const std::filesystem::path& file);

}  // namespace muster::report
