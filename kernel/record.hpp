// Tables of a run written as CSV while it runs: `t[s],robot,x[m],...`. Plugins read such files back by Setup::file.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "simulation.hpp"
#include "text/text_table_writer.hpp"

namespace muster {

// Throws Error where the world records a table that does not exist.
void check_records(const Simulation& run);

class Recorder {
 public:
  // One file per declaration, named after its table, in the folder, which is created. Throws Error.
  Recorder(const Simulation& run, const std::vector<RecordDeclaration>& tables, const std::filesystem::path& folder);

  struct File {
    std::string table;
    uint64_t every = 1;
    std::filesystem::path path;
  };
  // What is written, one a table. Empty after close().
  std::vector<File> files() const;

  // Call after each tick.
  void write(const Simulation& run);
  // What was written so far can be read in files of these names with ".part" behind.
  void flush();
  // Renames the files to their final names; without it what was flushed stays under the temporary ones.
  std::vector<std::filesystem::path> close();

 private:
  struct OpenFile {
    File file;
    std::unique_ptr<TextTableWriter> writer;
  };
  std::vector<OpenFile> files_;
};

}  // namespace muster
