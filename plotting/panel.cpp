// Draws one panel: its layers in order, clipped to the plot, and its frame.

#include "draw.hpp"

namespace muster::plotting {
namespace {

// Widens the range of the axis with pixels to spare, so that a unit is as long in x as in y.
void equalise(Range& x, Range& y, const Box& area) {
  const double x_unit = x.span() / area.width, y_unit = y.span() / area.height;
  const double unit = std::max(x_unit, y_unit);
  const auto widen = [](Range& range, double span) {
    const double room = (span - range.span()) / 2;
    range = {range.low - room, range.high + room};
  };
  widen(x, unit * area.width);
  widen(y, unit * area.height);
}

void draw_notes(const Canvas& canvas) {
  const Box& area = canvas.area;
  const View& view = canvas.view;
  const bool nothing = view.x.empty() || view.y.empty();
  if (nothing) {
    canvas.svg.text({area.x + area.width / 2, area.y + area.height / 2}, "no data",
                    {.size = axis_size, .colour = grey, .anchor = Anchor::middle});
  }
  if (canvas.outside > 0) {
    const std::string note = number_label(static_cast<double>(canvas.outside), 0) + " outside";
    canvas.svg.text({area.right() - 4, area.y + 11}, note,
                    {.size = tick_size, .colour = grey, .anchor = Anchor::end, .halo = true});
  }
}

}  // namespace

void draw_panel(const View& view, const Box& area, Svg& svg) {
  const Panel& panel = *view.panel;
  Range x = view.x_range, y = view.y_range;
  if (equal_units(panel)) equalise(x, y, area);
  View shown = view;
  if (equal_units(panel)) shown.y_ticks = ticks_within(y, area.height < 160 ? 5 : 9);
  Canvas canvas{svg, shown, area, Scale(x, area.x, area.right(), panel.x.log),
                Scale(y, area.bottom(), area.y, panel.y.log)};
  svg.open("panel");
  draw_grid(canvas);
  svg.open("layers", &area);
  for (std::size_t i = 0; i < panel.layers.size(); ++i) {
    std::visit([&](const auto& layer) { draw(layer, view.colours[i], canvas); }, panel.layers[i]);
  }
  for (const Layer& layer : panel.layers) {
    if (const auto* plan = std::get_if<FloorPlan>(&layer)) draw_stations(*plan, canvas);
  }
  canvas.labels.write(svg, area);
  draw_notes(canvas);
  svg.close();
  if (panel.frame == Frame::axes)
    draw_axes(canvas);
  else
    draw_scale_bar(canvas);
  draw_head(canvas);
  draw_end_labels(canvas);
  draw_colour_bar(canvas);
  svg.close();
}

}  // namespace muster::plotting
