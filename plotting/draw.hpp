// Draws layers, and their frame, into SVG.
#pragma once

#include "view.hpp"

namespace muster::plotting {

struct Canvas {
  Svg& svg;
  const View& view;
  Box area;
  Scale x, y;
  Labels labels{};
  std::size_t outside = 0;  // values beyond the limits

  Point operator()(Point p) const { return {x(p.x), y(p.y)}; }
  // Colour of `value` on the panel's colour bar, in one of `shades` steps.
  static constexpr int shades = 128;
  int shade(double value) const;
  Colour shade_colour(int shade) const;
};

void draw(const Line& line, Colour colour, Canvas& canvas);
void draw(const Points& points, Colour colour, Canvas& canvas);
void draw(const Rule& rule, Colour colour, Canvas& canvas);
void draw(const Band& band, Colour colour, Canvas& canvas);
void draw(const Histogram& histogram, Colour colour, Canvas& canvas);
void draw(const ErrorBars& errors, Colour colour, Canvas& canvas);
void draw(const Cells& cells, Colour colour, Canvas& canvas);
void draw(const FloorPlan& plan, Colour colour, Canvas& canvas);
// Call after all layers, so that no link crosses a station's mark.
void draw_stations(const FloorPlan& plan, Canvas& canvas);
void draw(const Robots& robots, Colour colour, Canvas& canvas);
void draw(const Path& path, Colour colour, Canvas& canvas);
void draw(const Links& links, Colour colour, Canvas& canvas);

// A whole panel, its plot at `area`.
void draw_panel(const View& view, const Box& area, Svg& svg);

// Parts of draw_panel() around the layers: axes, grid, title, legend, colour bar and scale bar.
void draw_grid(const Canvas& canvas);
void draw_axes(const Canvas& canvas);
void draw_scale_bar(const Canvas& canvas);
void draw_head(const Canvas& canvas);
void draw_end_labels(const Canvas& canvas);
void draw_colour_bar(const Canvas& canvas);

}  // namespace muster::plotting
