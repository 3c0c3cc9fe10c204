// An image of coloured cells and nothing else, for other programs to use as a map layer.
#pragma once

#include <filesystem>
#include <vector>

#include "colour.hpp"
#include "scale.hpp"

namespace muster::plotting {

// `value`: rows from the south, `width` cells each. A cell is `pixels` x `pixels`; north is up; NaN is transparent.
// Throws std::runtime_error with the file and the reason.
void save_png(const std::vector<double>& value, std::size_t width, Range range, Map map, std::size_t pixels,
              const std::filesystem::path& file);

}  // namespace muster::plotting
