// The project's own includes, and the circles that they form.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace muster::test {

struct Include {
  std::string from{};  // the file that includes
  int line = 0;
  std::string to{};  // the file that is included, from the root
};

struct IncludeGraph {
  std::vector<std::string> files{};
  std::vector<Include> includes{};
  std::vector<std::string> unresolved{};  // "file:line: ...", a quoted include that no folder has
};

// Reads the includes of the sources in `folders`. A name is looked for beside the including file, then from the root,
// then in plugins/ and plugin_api/. A name in angle brackets that is found nowhere belongs to another library.
IncludeGraph read_includes(const std::filesystem::path& root, const std::vector<std::string>& folders);

// A header and the source of the same stem are one unit: its path without extension.
std::string unit_of(const std::string& file);

// Strongly connected components (Tarjan 1972) of the graph of units with more than `largest` members. Each message
// walks one circle, include by include, and then lists the units that are in no step of that walk.
std::vector<std::string> circles(const IncludeGraph& graph, std::size_t largest);

}  // namespace muster::test
