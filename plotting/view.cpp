#include "view.hpp"

#include <algorithm>

namespace muster::plotting {
namespace {

// Adds a layer's needs to a view; called in the order of the layers.
struct Look {
  View& view;
  std::size_t next_series = 0;

  Colour take(const std::optional<Colour>& given) { return given ? *given : series_colour(next_series++); }
  void add(const std::vector<double>& xs, const std::vector<double>& ys) {
    for (std::size_t i = 0; i < xs.size(); ++i) add(Point{xs[i], ys[i]});
  }
  void add(Point p) {
    if (!drawable(p) || (view.panel->x.log && p.x <= 0) || (view.panel->y.log && p.y <= 0)) return;
    // Given limits of x restrict the data that determine y.
    if (p.x < view.panel->x.from.value_or(p.x) || p.x > view.panel->x.to.value_or(p.x)) return;
    view.x.add(p.x);
    view.y.add(p.y);
  }
  void add_square(Point centre, double half) {
    add(Point{centre.x - half, centre.y - half});
    add(Point{centre.x + half, centre.y + half});
  }
  void add_values(const std::vector<double>& values) {
    for (const double v : values) view.value.add(v);
  }
  void name(const std::string& label, Colour colour, Sign sign, double opacity = 1) {
    if (!label.empty()) view.legend.push_back({label, colour, sign, opacity});
  }

  // Height of a line's label: the mean of its last fiftieth, so that one noisy sample does not shift it.
  std::optional<double> end_level(const Line& line) const {
    const std::size_t wanted = line.x.size() / 50 + 1;
    std::size_t count = 0;
    double sum = 0;
    for (std::size_t i = line.x.size(); i-- > 0 && count < wanted;) {
      if (!drawable({line.x[i], line.y[i]}) || line.x[i] > view.panel->x.to.value_or(line.x[i])) continue;
      sum += line.y[i];
      ++count;
    }
    return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
  }

  Colour operator()(const Line& line) {
    const Colour colour = take(line.colour);
    add(line.x, line.y);
    if (view.panel->legend)
      name(line.label, colour, Sign::line);
    else if (!line.label.empty()) {
      if (const auto level = end_level(line)) view.end_labels.push_back({line.label, colour, *level});
    }
    return colour;
  }
  Colour operator()(const Points& points) {
    const Colour colour = points.value.empty() ? take(points.colour) : points.colour.value_or(grey);
    add(points.x, points.y);
    add_values(points.value);
    name(points.label, colour, Sign::dot);
    return colour;
  }
  Colour operator()(const Rule& rule) {
    (rule.vertical ? view.x : view.y).add(rule.at);
    if (!rule.vertical && !rule.label.empty() && drawable(rule.at)) {
      view.end_labels.push_back({rule.label, rule.colour, rule.at});
    }
    return rule.colour;
  }
  Colour operator()(const Band& band) {
    const Colour colour = band.colour.value_or(series_colour(next_series));
    add(band.x, band.low);
    add(band.x, band.high);
    name(band.label, colour, Sign::patch, band_opacity);
    return colour;
  }
  Colour operator()(const Histogram& histogram) {
    const Colour colour = take(histogram.colour);
    view.counts = view.counts || !histogram.density;
    for (const double edge : histogram.edges) view.x.add(edge);
    view.y.add(0);
    for (const double height : bars(histogram).heights) view.y.add(height);
    name(histogram.label, colour, Sign::patch, bar_opacity);
    return colour;
  }
  Colour operator()(const ErrorBars& errors) {
    const Colour colour = take(errors.colour);
    add(errors.x, errors.y);
    add(errors.x, errors.low);
    add(errors.x, errors.high);
    name(errors.label, colour, Sign::dot);
    return colour;
  }
  Colour operator()(const Cells& cells) {
    bool few = false;
    for (std::size_t i = 0; i < cells.x.size(); ++i) {
      const bool scarce = !cells.count.empty() && !(cells.count[i] >= cells.min_count);
      few = few || scarce;
      if (!scarce && !drawable(cells.value[i])) continue;
      for (const double side : {-0.5, 0.5}) add(Point{cells.x[i] + side * cells.size, cells.y[i] + side * cells.size});
      if (!scarce) view.value.add(cells.value[i]);
    }
    if (few) name("fewer than " + number_label(cells.min_count, 0) + " samples", light_grey, Sign::patch);
    return grey;
  }
  Colour operator()(const FloorPlan& plan) {
    for (const Wall& wall : plan.walls) {
      add_square(wall.from, wall.thickness / 2);
      add_square(wall.to, wall.thickness / 2);
    }
    for (const Door& door : plan.doors) {
      add(door.from);
      add(door.to);
    }
    for (const Station& station : plan.stations) add(station.at);
    const auto names = materials(plan);
    for (std::size_t i = 0; i < names.size() && names.size() > 1; ++i) name(names[i], wall_shade(i), Sign::wall);
    return black;
  }
  Colour operator()(const Robots& robots) {
    for (const Robot& robot : robots.robots) {
      for (const double side : {-1.0, 1.0})
        add(Point{robot.at.x + side * robot.radius, robot.at.y + side * robot.radius});
    }
    return blue;
  }
  Colour operator()(const Path& path) {
    for (const Point p : path.points) add(p);
    add_values(path.value);
    return path.value.empty() ? take(path.colour) : grey;
  }
  Colour operator()(const Links& links) {
    for (const Link& link : links.links) {
      add(link.from);
      add(link.to);
    }
    return grey;
  }
};

Range with_limits(Range range, const Axis& axis) {
  if (axis.from) range.low = *axis.from;
  if (axis.to) range.high = *axis.to;
  // All data are beyond the one given limit.
  if (range.low >= range.high && axis.from)
    range.high = axis.log ? range.low * 10 : range.low + std::max(1.0, std::abs(range.low) * 0.1);
  if (range.low >= range.high)
    range.low = axis.log ? range.high / 10 : range.high - std::max(1.0, std::abs(range.high) * 0.1);
  return range;
}

// `room` [fraction of the span] replaces round ends.
Range range_of(const Extent& extent, const Axis& axis, std::optional<double> room) {
  if (!axis.names.empty()) return {-0.5, static_cast<double>(axis.names.size()) - 0.5};
  Range range = axis.log ? Range{1, 10} : Range{0, 1};
  if (!extent.empty()) {
    range = extent.range();
    const bool plain = room && range.span() > 1e-9 * std::abs(range.high);
    if (plain)
      range = {range.low - *room * range.span(), range.high + *room * range.span()};
    else
      range = axis.log ? log_axis_range(range) : axis_range(range);
  }
  return with_limits(range, axis);
}

}  // namespace

double widest(const std::vector<Tick>& ticks) {
  double width = 0;
  for (const Tick& tick : ticks) width = std::max(width, text_width(tick.label, tick_size));
  return width;
}

double colour_bar_room(const View& view) {
  return bar_width + widest(view.value_ticks) + 12 + (axis_title(view.panel->value).empty() ? 0 : 18);
}

std::string axis_title(const Axis& axis) {
  if (axis.unit.empty()) return axis.label;
  return axis.label.empty() ? axis.unit : axis.label + " (" + axis.unit + ")";
}

std::vector<std::string> materials(const FloorPlan& plan) {
  std::vector<std::string> names;
  for (const Wall& wall : plan.walls) {
    if (std::find(names.begin(), names.end(), wall.material) == names.end()) names.push_back(wall.material);
  }
  return names;
}

Colour wall_shade(std::size_t material) {
  constexpr std::array shades{Colour{72, 72, 72}, Colour{158, 158, 158}, Colour{150, 112, 76}, Colour{120, 150, 170}};
  return shades[material % shades.size()];
}

Bars bars(const Histogram& histogram) {
  const auto& edges = histogram.edges;
  Bars result;
  if (edges.size() < 2) return result;
  result.heights.resize(edges.size() - 1);
  double counted = 0;
  for (const double v : histogram.values) {
    if (!drawable(v)) continue;
    if (v < edges.front() || v > edges.back()) {
      ++result.outside;
      continue;
    }
    const auto after = std::upper_bound(edges.begin(), edges.end() - 1, v);
    result.heights[static_cast<std::size_t>(after - edges.begin()) - 1] += 1;
    ++counted;
  }
  if (histogram.density && counted > 0) {
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) result.heights[i] /= counted * (edges[i + 1] - edges[i]);
  }
  return result;
}

View look(const Panel& panel) {
  View view;
  view.panel = &panel;
  Look visitor{view};
  for (const Layer& layer : panel.layers) view.colours.push_back(std::visit(visitor, layer));
  return view;
}

void set_ranges(View& view) {
  const Panel& panel = *view.panel;
  view.has_value = !view.value.empty();
  std::optional<double> room;
  if (equal_units(panel)) room = panel.frame == Frame::axes ? 0.02 : 0;
  view.x_range = range_of(view.x, panel.x, room);
  view.y_range = range_of(view.y, panel.y, room);
  view.value_range = range_of(view.value, panel.value, {});
  if (panel.map == Map::diverging && !panel.value.from && !panel.value.to) {
    const double far = std::max(std::abs(view.value_range.low), std::abs(view.value_range.high));
    view.value_range = {-far, far};
  }
  std::erase_if(view.end_labels, [&](const EndLabel& label) { return !view.y_range.holds(label.y); });
}

std::vector<Tick> name_ticks(const Axis& axis) {
  std::vector<Tick> ticks;
  for (std::size_t i = 0; i < axis.names.size(); ++i) ticks.push_back({static_cast<double>(i), axis.names[i]});
  return ticks;
}

bool names_crowded(const Axis& axis, double width) {
  const double pitch = width / static_cast<double>(std::max<std::size_t>(axis.names.size(), 1));
  return widest(name_ticks(axis)) + 6 > pitch;
}

double legend_entry_width(const LegendEntry& entry) { return 22 + text_width(entry.label, tick_size) + 14; }

int legend_rows(const std::vector<LegendEntry>& legend, double width) {
  int rows = legend.empty() ? 0 : 1;
  double x = 0;
  for (const LegendEntry& entry : legend) {
    if (x > 0 && x + legend_entry_width(entry) > width) {
      ++rows;
      x = 0;
    }
    x += legend_entry_width(entry);
  }
  return rows;
}

void set_margins(View& view, double plot_width) {
  const Panel& panel = *view.panel;
  Margins& m = view.margins;
  m = {.left = 8, .right = 14, .top = 8, .bottom = 26};
  if (!panel.title.empty()) m.top += 18;
  m.top += legend_height * legend_rows(view.legend, plot_width);
  if (panel.frame == Frame::axes) {
    if (view.show_y) {
      m.left = widest(view.y_ticks) + tick_length + 8 + (axis_title(panel.y).empty() ? 0 : 20);
    }
    m.bottom = view.show_x ? tick_length + 18 + (axis_title(panel.x).empty() ? 0 : 18) : 10;
  }
  if (names_crowded(panel.x, plot_width)) m.bottom += 0.65 * widest(name_ticks(panel.x)) - 8;  // sin 40 degrees
  for (const EndLabel& label : view.end_labels) m.right = std::max(m.right, text_width(label.label, tick_size) + 14);
  if (view.has_value) {
    view.value_ticks = ticks_within(view.value_range, 7);
    m.right += colour_bar_room(view);
  }
}

}  // namespace muster::plotting
