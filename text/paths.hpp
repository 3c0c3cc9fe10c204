// What to say of a file that is not there.
#pragma once

#include <filesystem>
#include <string>

namespace muster {

// `there is no file "FOLDER\\NAME"; did you mean "FOLDER/NAME"?`
std::string no_file(const std::filesystem::path& path);

}  // namespace muster
