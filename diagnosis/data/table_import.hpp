// Brings a foreign table of readings into the format of measured data, as a map file says
// (docs/how-to/import_a_table.md), and says what it took for granted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace muster::diagnosis {

struct Imported {
  std::size_t rows = 0, empty = 0;   // written, and of these without a reading
  std::vector<std::string> assumed;  // columns, units and frames, one a line
};

// Reads `file` by `map` and writes `out`. Throws Error.
Imported import_table(const std::filesystem::path& file, const std::filesystem::path& map,
                      const std::filesystem::path& out);

}  // namespace muster::diagnosis
