// Draws the surroundings of a panel's layers: axes, title, legend, labels at the ends of lines, scale bar.

#include "draw.hpp"

namespace muster::plotting {
namespace {

constexpr Colour axis_colour{90, 90, 90}, grid_colour{236, 236, 236};
constexpr double axis_width = 0.8;

// As many ticks as fit with their labels.
std::vector<Tick> x_ticks(const Canvas& canvas) {
  const Axis& axis = canvas.view.panel->x;
  if (!axis.names.empty()) return name_ticks(axis);
  for (int most = 9; most > 2; --most) {
    auto ticks = axis.log ? log_ticks_within(canvas.x.range(), most) : ticks_within(canvas.x.range(), most);
    double needs = 0;
    for (const Tick& tick : ticks) needs += text_width(tick.label, tick_size) + 14;
    if (needs < canvas.area.width) return ticks;
  }
  return ticks_within(canvas.x.range(), 2);
}

void draw_x_axis(const Canvas& canvas) {
  const Box& area = canvas.area;
  Svg& svg = canvas.svg;
  const auto ticks = x_ticks(canvas);
  const bool crowded = names_crowded(canvas.view.panel->x, area.width);
  for (const Tick& tick : ticks) {
    const double x = canvas.x(tick.value);
    svg.line({x, area.bottom()}, {x, area.bottom() + tick_length}, {.stroke = axis_colour, .width = axis_width});
    if (!canvas.view.show_x) continue;
    if (crowded) {
      svg.text({x + 3, area.bottom() + tick_length + 9}, tick.label,
               {.size = tick_size, .anchor = Anchor::end, .turn = -40});
    } else {
      svg.text({x, area.bottom() + tick_length + 12}, tick.label, {.size = tick_size, .anchor = Anchor::middle});
    }
  }
  if (canvas.view.show_x) {
    svg.text({area.x + area.width / 2, area.bottom() + canvas.view.margins.bottom - 5},
             axis_title(canvas.view.panel->x), {.size = axis_size, .anchor = Anchor::middle});
  }
}

void draw_y_axis(const Canvas& canvas) {
  const Box& area = canvas.area;
  Svg& svg = canvas.svg;
  for (const Tick& tick : canvas.view.y_ticks) {
    const double y = canvas.y(tick.value);
    svg.line({area.x - tick_length, y}, {area.x, y}, {.stroke = axis_colour, .width = axis_width});
    if (!canvas.view.show_y) continue;
    svg.text({area.x - tick_length - 4, y + 0.35 * tick_size}, tick.label, {.size = tick_size, .anchor = Anchor::end});
  }
  if (canvas.view.show_y) {
    svg.text({area.x - canvas.view.margins.left + 11, area.y + area.height / 2}, axis_title(canvas.view.panel->y),
             {.size = axis_size, .anchor = Anchor::middle, .turn = -90});
  }
}

void draw_legend(const Canvas& canvas, double top) {
  Svg& svg = canvas.svg;
  double x = canvas.area.x, y = top + legend_height / 2;
  for (const LegendEntry& entry : canvas.view.legend) {
    const double width = legend_entry_width(entry);
    if (x > canvas.area.x && x + width > canvas.area.right()) {
      x = canvas.area.x;
      y += legend_height;
    }
    if (entry.sign == Sign::line) svg.line({x, y}, {x + 16, y}, {.stroke = entry.colour, .width = 1.8});
    if (entry.sign == Sign::dot) svg.circle({x + 9, y}, 2.8, {.fill = entry.colour});
    if (entry.sign == Sign::patch)
      svg.rectangle({x + 3, y - 5, 13, 10}, {.fill = entry.colour, .opacity = entry.opacity});
    if (entry.sign == Sign::wall) svg.rectangle({x, y - 2.5, 16, 5}, {.fill = entry.colour});
    svg.text({x + 21, y + 0.35 * tick_size}, entry.label, {.size = tick_size});
    x += width;
  }
}

}  // namespace

void draw_grid(const Canvas& canvas) {
  if (canvas.view.panel->frame != Frame::axes || equal_units(*canvas.view.panel) || canvas.view.has_value) return;
  canvas.svg.open("grid");
  for (const Tick& tick : canvas.view.y_ticks) {
    const double y = canvas.y(tick.value);
    canvas.svg.line({canvas.area.x, y}, {canvas.area.right(), y}, {.stroke = grid_colour, .width = 0.8});
  }
  canvas.svg.close();
}

void draw_axes(const Canvas& canvas) {
  const Box& area = canvas.area;
  canvas.svg.open("axes");
  Pen frame;
  frame.move({area.x, area.y});
  frame.line({area.x, area.bottom()});
  frame.line({area.right(), area.bottom()});
  canvas.svg.path(frame, {.stroke = axis_colour, .width = axis_width});
  draw_x_axis(canvas);
  draw_y_axis(canvas);
  canvas.svg.close();
}

void draw_scale_bar(const Canvas& canvas) {
  const Tick bar = round_length(canvas.x.range().span() / 4);
  const double x = canvas.area.x + 1, y = canvas.area.bottom() + 11, length = bar.value * canvas.x.pixels();
  const Ink ink{.stroke = black, .width = 1, .cap = Cap::square};
  canvas.svg.open("scale-bar");
  canvas.svg.line({x, y}, {x + length, y}, ink);
  for (const double end : {x, x + length}) canvas.svg.line({end, y - 3}, {end, y + 3}, ink);
  canvas.svg.text({x + length + 6, y + 0.35 * tick_size}, bar.label + " m", {.size = tick_size});
  canvas.svg.close();
}

void draw_head(const Canvas& canvas) {
  const View& view = canvas.view;
  const double legend = legend_height * legend_rows(view.legend, canvas.area.width);
  canvas.svg.open("head");
  if (!view.panel->title.empty()) {
    canvas.svg.text({canvas.area.x, canvas.area.y - view.margins.top + 15}, view.panel->title,
                    {.size = title_size, .bold = true});
  }
  draw_legend(canvas, canvas.area.y - legend - 5);
  canvas.svg.close();
}

void draw_end_labels(const Canvas& canvas) {
  const auto& labels = canvas.view.end_labels;
  std::vector<double> wanted;
  for (const EndLabel& label : labels) wanted.push_back(canvas.y(label.y));
  const auto ys = spread(wanted, line_gap, {canvas.area.y, canvas.area.bottom()});
  canvas.svg.open("end-labels");
  for (std::size_t i = 0; i < labels.size(); ++i) {
    canvas.svg.text({canvas.area.right() + 6, ys[i] + 0.35 * tick_size}, labels[i].label,
                    {.size = tick_size, .colour = labels[i].colour});
  }
  canvas.svg.close();
}

}  // namespace muster::plotting
