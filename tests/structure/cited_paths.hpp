// Paths that comments cite.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "source_tree.hpp"

namespace muster::test {

struct Comment {
  int line = 0;
  std::string text{};  // one line of it
};

// The comments of a file, by the language of its name: // and /* */, #, or <!-- -->.
std::vector<Comment> comments_of(const TextFile& file);

// Words of a comment that cite a file of the tree: a path with an extension of ours or a top-level folder in front, or
// the name of a page (*.md). Patterns, placeholders (NAME, {world}), addresses, ../shared, build/, out/ and docs/long/
// are left out.
std::vector<std::string> paths_in(std::string_view comment, const std::vector<std::string>& top_folders);

// Comments below `root` that cite a path which is not there: "file:line: path". A path counts from the root, from
// plugins/ or plugin_api/, from docs/ or a folder in it, or from any folder that holds the file.
std::vector<std::string> lost_citations(const std::filesystem::path& root);

}  // namespace muster::test
