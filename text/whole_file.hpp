// Files that appear under their names when they are whole. Until then they have ".part" behind.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace muster {

// What is done where another process writes a temporary file of that name; one that waits does so until it is whole.
enum class IfHeld { waits, fails };

// Opens a temporary file for writing, empty and a file of its own: a link of that name is taken away, not followed. No
// other opens it until close_part(), which comes after it was given its name. The descriptor, or -1 with errno set,
// which is EWOULDBLOCK where another process writes it. A file system without locks has none.
int open_part(const std::filesystem::path& part, IfHeld if_held);
void close_part(int descriptor);

// Writes all of it to the descriptor. False with errno set.
bool write_all(int descriptor, std::string_view bytes);

// For an error: why a file cannot be opened or written, such as "cannot be written: Permission denied".
std::string why_unwritten(int error_number);

// Writes the file whole, to the disk, in place of one that was there. Throws Error with Exit::io; the old one is still
// there then.
void write_whole(const std::filesystem::path& file, std::string_view bytes);

}  // namespace muster
