// What to say of a file that is not there.
#pragma once

#include <filesystem>
#include <string>

namespace muster {

// "there is no file "paths\\a.csv"; did you mean "paths/a.csv"?"
std::string no_file(const std::filesystem::path& path);

}  // namespace muster
