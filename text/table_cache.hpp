// Tables read once and handed on to all that need them, for as long as a piece of work lasts.
#pragma once

#include <map>
#include <memory>
#include <mutex>

#include "text_table.hpp"

namespace muster {

class TableCache {
 public:
  // The table of a file, read at the first call. A file that was written anew since is read again. Throws Error.
  std::shared_ptr<const TextTable> read(const std::filesystem::path& file);
  // Hands on this table in place of the file's, for as long as the file is not written anew.
  void put(const std::filesystem::path& file, std::shared_ptr<const TextTable> table);

 private:
  struct Known {
    std::filesystem::file_time_type written;
    std::uintmax_t size = 0;
    std::vector<std::shared_ptr<const TextTable>> tables;  // the same under each name of the file
  };
  std::mutex mutex_;
  std::map<std::filesystem::path, Known> known_;  // by absolute path
};

}  // namespace muster
