// Puts a run into the page that the build has made of viewer/page: one HTML file that needs nothing else.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "record_folder.hpp"

namespace muster::viewer {

// Numbers that a page holds if nobody says otherwise: some 10 MB of page where none of them compresses.
inline constexpr std::uint64_t most_numbers = 2'000'000;

// Of the page without a run, which the build puts beside the program. Empty if it is there; otherwise the reason, and
// the remedy.
std::string why_no_page(const std::filesystem::path& program_folder);

struct WrittenPage {
  std::uint64_t bytes = 0;
  std::vector<std::string> notes;  // what of the record is not in it
};

// Writes the record in the folder as a page, whole or not at all. Throws Error.
WrittenPage write_page(const std::filesystem::path& record, const std::filesystem::path& out,
                       const std::filesystem::path& program_folder, std::uint64_t most = most_numbers);

// The same page with the record so far, which then asks its server for more. Throws Error.
std::string live_page(const RecordFolder& record, const std::filesystem::path& program_folder, std::uint64_t most);

}  // namespace muster::viewer
