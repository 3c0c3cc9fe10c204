// Colours that stay distinct with any colour vision deficiency.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace muster::plotting {

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
  bool operator==(const Colour&) const = default;

  // "#rrggbb"
  std::string hex() const;
};

// Okabe and Ito, "Color Universal Design" (2008); their yellow is left out because it fades on white.
inline constexpr Colour blue{0, 114, 178}, vermillion{213, 94, 0}, green{0, 158, 115}, purple{204, 121, 167},
    sky{86, 180, 233}, orange{230, 159, 0};
inline constexpr Colour black{26, 26, 26}, grey{120, 120, 120}, light_grey{184, 184, 184}, white{255, 255, 255};

// The colour of the i-th series without a given one; from the seventh on they repeat.
Colour series_colour(std::size_t i);

// viridis: perceptually uniform lightness (van der Walt and Smith 2015, CC0); for quantities. diverging: blue below,
// vermillion above, near white in the middle; for residuals, its range is centred at 0.
enum class Map { viridis = 1, diverging };

// The colour at `at` in [0, 1]; values outside take the end's colour.
Colour map_colour(Map map, double at);

// Perceived lightness in [0, 1] (Oklab's L; Ottosson 2020).
double lightness(Colour colour);

}  // namespace muster::plotting
