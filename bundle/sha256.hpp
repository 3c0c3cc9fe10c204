// SHA-256 of a file (FIPS 180-4), as 64 hexadecimal digits.
#pragma once

#include <filesystem>
#include <string>

namespace muster::bundle {

// Throws Error where it cannot be read.
std::string sha256_of(const std::filesystem::path& file);

}  // namespace muster::bundle
