#include "raster.hpp"

#include <png.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace muster::plotting {

void save_png(const std::vector<double>& value, std::size_t width, Range range, Map map, std::size_t pixels,
              const std::filesystem::path& file) {
  const std::size_t height = value.size() / width;
  const auto share = [&](double v) { return range.span() > 0 ? (v - range.low) / range.span() : 0.5; };
  std::vector<std::uint8_t> rgba;
  rgba.reserve(4 * value.size() * pixels * pixels);
  for (std::size_t y = height * pixels; y-- > 0;) {
    for (std::size_t x = 0; x < width * pixels; ++x) {
      const double v = value[y / pixels * width + x / pixels];
      const Colour c = drawable(v) ? map_colour(map, share(v)) : white;
      rgba.insert(rgba.end(), {c.r, c.g, c.b, static_cast<std::uint8_t>(drawable(v) ? 255 : 0)});
    }
  }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width * pixels);
  image.height = static_cast<png_uint_32>(height * pixels);
  image.format = PNG_FORMAT_RGBA;
  const std::filesystem::path part = file.string() + ".part";
  if (!png_image_write_to_file(&image, part.c_str(), 0, rgba.data(), 0, nullptr))
    throw std::filesystem::filesystem_error("cannot write the picture", file, {errno, std::generic_category()});
  std::filesystem::rename(part, file);
}

}  // namespace muster::plotting
