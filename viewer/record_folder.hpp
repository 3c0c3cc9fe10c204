// Reads and writes run.json, which makes a folder of tables the record of a run: what ran, what was recorded, and the
// scene.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "text/json.hpp"

namespace muster::viewer {

inline constexpr const char* run_file = "run.json";
inline constexpr const char* run_format = "muster.run/1";

// One recorded table, as the blackboard declares it.
struct RecordedTable {
  std::string table;    // "robot/*/pose"
  std::string file;     // in the folder
  std::string kind;     // of its set: fixed, live, queue, listed
  std::string columns;  // "x[m] y[m] payload{}"
  std::uint64_t every = 1;
};

struct RecordFolder {
  std::filesystem::path path;
  std::string world;
  double dt = 0;
  std::string run, scene;  // JSON: what the page is given as it stands
  std::vector<RecordedTable> tables;
};

// Writes run.json into the folder, whole or not at all. Throws Error.
void write_run_file(const std::filesystem::path& folder, const Json& run, const Json& scene,
                    const std::vector<RecordedTable>& tables);

// Throws Error where the folder is no record, with the nearest folder that is one.
RecordFolder read_record_folder(const std::filesystem::path& path);

}  // namespace muster::viewer
