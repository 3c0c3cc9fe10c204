// Cells coloured by value, and their colour bar.
#include <algorithm>

#include "draw.hpp"

namespace muster::plotting {

int Canvas::shade(double value) const {
  const Range& range = view.value_range;
  const double at = std::clamp((value - range.low) / range.span(), 0.0, 1.0);
  return std::min(static_cast<int>(at * shades), shades - 1);
}

Colour Canvas::shade_colour(int shade) const {
  return map_colour(view.panel->map, static_cast<double>(shade) / (shades - 1));
}

void draw(const Cells& cells, Colour, Canvas& canvas) {
  std::vector<Pen> pens(Canvas::shades);
  Pen few;
  for (std::size_t i = 0; i < cells.x.size(); ++i) {
    const Point a = canvas({cells.x[i] - cells.size / 2, cells.y[i] + cells.size / 2});
    const Point b = canvas({cells.x[i] + cells.size / 2, cells.y[i] - cells.size / 2});
    if (!drawable(a) || !drawable(b)) continue;
    const Box box{a.x, a.y, b.x - a.x, b.y - a.y};
    const bool scarce = !cells.count.empty() && !(cells.count[i] >= cells.min_count);
    if (scarce)
      few.rectangle(box);
    else if (drawable(cells.value[i]))
      pens[static_cast<std::size_t>(canvas.shade(cells.value[i]))].rectangle(box);
  }
  canvas.svg.open("cells");
  canvas.svg.path(few, {.fill = light_grey, .crisp = true});
  for (std::size_t i = 0; i < pens.size(); ++i) {
    canvas.svg.path(pens[i], {.fill = canvas.shade_colour(static_cast<int>(i)), .crisp = true});
  }
  canvas.svg.close();
}

void draw_colour_bar(const Canvas& canvas) {
  const View& view = canvas.view;
  if (!view.has_value) return;
  const std::string title = axis_title(view.panel->value);
  const Box& area = canvas.area;
  const bool below = !view.value.empty() && view.value.range().low < view.value_range.low;
  const bool above = !view.value.empty() && view.value.range().high > view.value_range.high;
  constexpr double tip = 8;  // px, of the arrows that mark values beyond the limits
  Box bar{area.right() + view.margins.right - colour_bar_room(view), area.y, bar_width, area.height};
  if (above) bar.y += tip;
  bar.height -= tip * (above + below);
  Svg& svg = canvas.svg;
  svg.open("colour-bar");
  const double step = bar.height / Canvas::shades;
  for (int i = 0; i < Canvas::shades; ++i) {
    svg.rectangle({bar.x, bar.bottom() - (i + 1) * step, bar.width, step + (i > 0 ? 1 : 0)},
                  {.fill = canvas.shade_colour(i)});
  }
  const auto draw_tip = [&](double y, double end, int shade) {
    Pen pen;
    pen.move({bar.x, y});
    pen.line({bar.x + bar.width / 2, end});
    pen.line({bar.right(), y});
    pen.close();
    svg.path(pen, {.fill = canvas.shade_colour(shade)});
  };
  if (above) draw_tip(bar.y, bar.y - tip, Canvas::shades - 1);
  if (below) draw_tip(bar.bottom(), bar.bottom() + tip, 0);
  const Scale scale(view.value_range, bar.bottom(), bar.y);
  for (const Tick& tick : view.value_ticks) {
    const double y = scale(tick.value);
    svg.line({bar.right(), y}, {bar.right() + 3, y}, {.stroke = grey, .width = 0.8});
    svg.text({bar.right() + 6, y + 0.35 * tick_size}, tick.label, {.size = tick_size});
  }
  if (!title.empty()) {
    svg.text({bar.right() + widest(view.value_ticks) + 20, bar.y + bar.height / 2}, title,
             {.size = axis_size, .anchor = Anchor::middle, .turn = -90});
  }
  svg.close();
}

}  // namespace muster::plotting
