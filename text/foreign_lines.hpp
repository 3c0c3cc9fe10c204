// Lines of files that are no tables here: of other separators, and comments.
#pragma once

#include <string>
#include <string_view>

#include "error.hpp"

namespace muster {

// Throws Error for a first line between ';' or tabs; `second` is the line below.
void refuse_foreign(const std::string& first, const std::string& second, const Place& place);

// True where the text begins with a comment of scripts or of MATLAB.
bool is_comment(std::string_view text);

}  // namespace muster
