// What a command reads and writes: it refuses to write over a file that it reads, or twice into one file.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace muster::cli {

class WrittenFiles {
 public:
  // `as`: how the command line names it, such as "--data".
  void reads(const std::filesystem::path& file, const std::string& as);
  // A world's folder or file, and the files that its attributes name.
  void reads_world(const std::filesystem::path& world);

  // Call after all that is read. Empty paths are none. Throws Error.
  void writes(const std::filesystem::path& file, const std::string& option);
  // Throws Error where the path is a file, or is called like one; `of_file` is the option that writes such a file.
  static void writes_folder(const std::filesystem::path& folder, const std::string& option,
                            const std::string& of_file = "");
  // Of a run that goes on from a state: throws Error where the folder has a record, whole or cut off, which may be that
  // of the time before.
  static void replaces_no_record(const std::filesystem::path& folder, const std::string& option);

 private:
  using Named = std::pair<std::filesystem::path, std::string>;
  std::vector<Named> read_, written_;
  std::vector<std::filesystem::path> worlds_;
};

}  // namespace muster::cli
