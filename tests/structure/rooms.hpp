// How large rooms are, and which words a domain-free room keeps out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace muster::test {

// Folders at or below `folder` that hold more than `largest` units themselves.
std::vector<std::string> crowded_folders(const std::filesystem::path& root, const std::string& folder,
                                         std::size_t largest);

// Files directly in a folder, without its README.md and CMakeLists.txt.
std::vector<std::string> files_in(const std::filesystem::path& root, const std::string& folder);

// The parts of an identifier or word, in small letters: "tx_at" gives tx and at, "linkOf" link and of, "dBm" dbm.
std::vector<std::string> parts_of(std::string_view identifier);

// Words of radio and robots in the sources below a folder, code and comments alike.
std::vector<std::string> domain_words(const std::filesystem::path& root, const std::string& folder);

}  // namespace muster::test
