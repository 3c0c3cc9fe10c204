// Lays panels out in a grid so that the plots of a column and of a row line up.
#include <set>

#include "draw.hpp"
#include "figure.hpp"

namespace muster::plotting {
namespace {

constexpr double edge = 14, row_gap = 14;  // px
constexpr double golden = 0.62, least_aspect = 0.2, most_aspect = 1.4;

struct Grid {
  std::size_t columns, rows;
  double plot_width = 0;
  std::vector<double> left, right;          // a column
  std::vector<double> top, bottom, height;  // a row
};

std::vector<View> look_at_all(const Figure& figure) {
  std::vector<View> views;
  std::set<std::string> explained;  // a label in an earlier panel's legend is not repeated
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Panel& panel = figure.panels[i];
    check(panel, "panel " + std::to_string(i + 1) + (panel.title.empty() ? "" : " (" + panel.title + ")"));
    views.push_back(look(panel));
    std::erase_if(views.back().legend, [&](const LegendEntry& entry) { return !explained.insert(entry.label).second; });
  }
  return views;
}

void share(std::vector<View>& views, Extent View::*extent) {
  Extent all;
  for (const View& view : views) all.add(view.*extent);
  for (View& view : views) view.*extent = all;
}

double aspect(const View& view) {
  const Panel& panel = *view.panel;
  if (panel.aspect > 0) return panel.aspect;
  if (!equal_units(panel)) return golden;
  return std::clamp(view.y_range.span() / view.x_range.span(), least_aspect, most_aspect);
}

void set_y_ticks(View& view) {
  const Axis& axis = view.panel->y;
  if (!axis.names.empty())
    view.y_ticks = name_ticks(axis);
  else
    view.y_ticks = axis.log ? log_ticks_within(view.y_range, 8) : ticks_within(view.y_range, 8);
  if (!view.counts) return;
  std::erase_if(view.y_ticks, [](const Tick& tick) { return tick.value != std::floor(tick.value); });
  for (Tick& tick : view.y_ticks) tick.label = number_label(tick.value, 0);
}

// Hides titles of inner axes where limits are shared and the titles agree.
void hide_inner_axes(const Figure& figure, std::vector<View>& views, std::size_t columns) {
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Panel& panel = *views[i].panel;
    const bool has_below = i + columns < views.size();
    if (figure.share_x && has_below) {
      views[i].show_x = axis_title(panel.x) != axis_title(views[i + columns].panel->x);
    }
    if (figure.share_y && i % columns > 0) views[i].show_y = axis_title(panel.y) != axis_title(views[i - 1].panel->y);
  }
}

Grid lay_out(const Figure& figure, std::vector<View>& views) {
  Grid grid;
  grid.columns = static_cast<std::size_t>(std::max(1, figure.columns));
  grid.columns = std::min(grid.columns, std::max<std::size_t>(views.size(), 1));
  grid.rows = (views.size() + grid.columns - 1) / grid.columns;
  hide_inner_axes(figure, views, grid.columns);
  // The legend's height depends on the plot's width, and that on the margins: two passes suffice.
  double width = figure.width / static_cast<double>(grid.columns) - 80;
  for (int pass = 0; pass < 2; ++pass) {
    grid.left.assign(grid.columns, 0);
    grid.right.assign(grid.columns, 0);
    for (std::size_t i = 0; i < views.size(); ++i) {
      set_y_ticks(views[i]);
      set_margins(views[i], width);
      double& left = grid.left[i % grid.columns];
      double& right = grid.right[i % grid.columns];
      left = std::max(left, views[i].margins.left);
      right = std::max(right, views[i].margins.right);
    }
    double taken = 2 * edge;
    for (std::size_t c = 0; c < grid.columns; ++c) taken += grid.left[c] + grid.right[c];
    grid.plot_width = std::max((figure.width - taken) / static_cast<double>(grid.columns), 40.0);
    width = grid.plot_width;
  }
  grid.top.assign(grid.rows, 0);
  grid.bottom.assign(grid.rows, 0);
  grid.height.assign(grid.rows, 0);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::size_t row = i / grid.columns;
    grid.top[row] = std::max(grid.top[row], views[i].margins.top);
    grid.bottom[row] = std::max(grid.bottom[row], views[i].margins.bottom);
    grid.height[row] = std::max(grid.height[row], grid.plot_width * aspect(views[i]));
  }
  return grid;
}

double draw_title(const Figure& figure, Svg& svg) {
  double y = edge;
  for (const std::string& line : wrapped(figure.title, (figure.width - 2 * edge) / bold_widening, figure_title_size)) {
    y += figure_title_size + 4;
    svg.text({edge, y - 5}, line, {.size = figure_title_size, .bold = true});
  }
  return figure.title.empty() ? y : y + 4;
}

double draw_caption(const Figure& figure, double y, Svg& svg) {
  if (!figure.caption.empty()) y += 6;
  for (const std::string& line : wrapped(figure.caption, figure.width - 2 * edge, caption_size)) {
    y += caption_size + 4;
    svg.text({edge, y}, line, {.size = caption_size, .colour = Colour{80, 80, 80}});
  }
  return y;
}

}  // namespace

std::string svg(const Figure& figure) {
  auto views = look_at_all(figure);
  if (figure.share_x) share(views, &View::x);
  if (figure.share_y) share(views, &View::y);
  if (figure.share_value) share(views, &View::value);
  for (View& view : views) set_ranges(view);
  const Grid grid = lay_out(figure, views);
  Svg out;
  double y = draw_title(figure, out);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    y += grid.top[row];
    double x = edge;
    for (std::size_t column = 0; column < grid.columns; ++column) {
      x += grid.left[column];
      const std::size_t i = row * grid.columns + column;
      if (i < views.size()) {
        views[i].margins.top = grid.top[row];  // so that the titles of a row line up
        draw_panel(views[i], {x, y, grid.plot_width, grid.height[row]}, out);
      }
      x += grid.plot_width + grid.right[column];
    }
    y += grid.height[row] + grid.bottom[row] + (row + 1 < grid.rows ? row_gap : 0);
  }
  y = draw_caption(figure, y, out) + edge;
  return out.document(figure.width, std::ceil(y), figure.title.empty() ? "figure" : figure.title, figure.caption);
}

}  // namespace muster::plotting
