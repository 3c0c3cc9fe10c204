// The file that was meant where a path names none: for messages.
#pragma once

#include <filesystem>
#include <string>

namespace muster {

// `; did you mean "hall.xml"?`: the entry of the same folder that is fewest typing errors away, or the path
// with
// '/' where it has '\'; empty where there is none, or the folder has very many.
std::string near_file(const std::filesystem::path& path);

}  // namespace muster
