// Converts foreign tables of readings to the format of measured data, as specified by a map file
// (docs/how-to/import_a_table.md), and reports its assumptions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace muster::diagnosis {

struct Imported {
  std::size_t rows = 0, empty = 0;   // rows written, and those of them without a reading
  std::vector<std::string> assumed;  // columns, units and frames, one a line
};

// Reads `files` by `map` and writes `out`, one table. Throws Error.
Imported import_table(const std::vector<std::filesystem::path>& files, const std::filesystem::path& map,
                      const std::filesystem::path& out);

}  // namespace muster::diagnosis
