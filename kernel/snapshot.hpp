// A run's state between two ticks: rows, published tables, parameters. In memory, and as a file
// (docs/reference/snapshot_format.md).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "blackboard.hpp"

namespace muster {

struct Snapshot {
  struct SavedSet {
    std::vector<std::string> names;
    std::vector<uint8_t> alive;
    std::vector<uint32_t> like;
    uint64_t listed = 0;
    bool operator==(const SavedSet&) const = default;
  };
  struct SavedInstance {
    std::string plugin;             // "radio.multiwall/1"
    uint64_t line = 0, column = 0;  // of its declaration in the world file
    std::vector<double> params;
    bool given_up = false;  // its own process has ended, and the run goes on without it
    bool operator==(const SavedInstance&) const = default;
  };
  struct SavedTable {
    std::string columns;
    Cells cells;
  };

  uint64_t tick = 0;
  double dt = 0;  // of a tick [s]
  std::map<std::string, SavedSet> sets;
  std::map<std::string, SavedTable> tables;
  std::map<std::string, SavedInstance> instances;

  // A hash of rows and published tables, names included; equal states give equal digests in every process.
  uint64_t digest() const;

  // Atomic: the file is there whole or not at all. Throws Error with Exit::io.
  void save(const std::filesystem::path& file) const;
  // Throws Error if it is not a whole snapshot.
  static Snapshot load(const std::filesystem::path& file);
};

}  // namespace muster
