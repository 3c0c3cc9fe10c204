// Tables of files that plugins claim: cells for the blackboard, or what the file is instead.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "blackboard.hpp"
#include "text/table_cache.hpp"

namespace muster {

// A file's cells, names turned into row numbers; where `closed`, it must have no other columns. Throws Error with line
// and column of the file.
std::unique_ptr<Cells> read_file_table(const std::filesystem::path& path, const Columns& columns, bool closed,
                                       Blackboard& board, TableCache& tables);

// Warnings of columns that are not read and mean one that is not there, as `theta` means `yaw`.
std::vector<std::string> unread_columns(const std::filesystem::path& path, const Columns& columns, TableCache& tables);

// Warnings of numbers in a file's cells that look like something else: marks for no value, degrees, places on the
// globe.
std::vector<std::string> doubtful_cells(const std::filesystem::path& path, const Columns& columns, const Cells& cells,
                                        TableCache& tables);

}  // namespace muster
