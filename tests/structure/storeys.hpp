// The storeys of the tree: which folder may include which.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "include_graph.hpp"

namespace muster::test {

// A room is a folder with all below it that is no room itself, or one unit: a header and its source, named without
// extension. "X/*" makes a room of each folder in X.
struct Storey {
  std::string room{};
  std::vector<std::string> may_include{};  // rooms, by the same names; "X/*" is every room below X
};

using Storeys = std::vector<Storey>;  // lowest first

// The tree of muster.
const Storeys& storeys();

// The top-level folders of a table.
std::vector<std::string> top_folders(const Storeys& storeys);

// Faults of the table itself: a room that is not there, one that may include what is not below it.
std::vector<std::string> table_faults(const std::filesystem::path& root, const Storeys& storeys);

// Folders that hold sources without a storey.
std::vector<std::string> homeless_folders(const IncludeGraph& graph, const Storeys& storeys);

// Includes that a table does not allow. A file without a storey may include anything.
std::vector<std::string> upward_includes(const IncludeGraph& graph, const Storeys& storeys);

}  // namespace muster::test
