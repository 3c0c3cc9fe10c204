// Files that appear under their names when they are whole. Until then they have ".part" behind.
#pragma once

#include <filesystem>
#include <string_view>

namespace muster {

// Opens FILE.part for writing, empty and a file of its own: a link of that name is taken away, not followed. The
// descriptor, or -1 with errno set.
int open_part(const std::filesystem::path& file);

// Writes all of it to the descriptor. False with errno set.
bool write_all(int descriptor, std::string_view bytes);

// Writes the file whole, to the disk, in place of one that was there. Throws Error with Exit::io; the old one is still
// there then.
void write_whole(const std::filesystem::path& file, std::string_view bytes);

}  // namespace muster
