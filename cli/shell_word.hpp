// Text as one word of a POSIX shell.
#pragma once

#include <string>

namespace muster::cli {

// In quotes where it needs them.
std::string shell_word(const std::string& text);

}  // namespace muster::cli
