// Curves, points, bands, bars: layers over two axes.
#include <algorithm>

#include "draw.hpp"

namespace muster::plotting {
namespace {

constexpr std::string_view dashes = "5 4";

std::vector<Point> placed(const std::vector<double>& x, const std::vector<double>& y, const Canvas& canvas) {
  std::vector<Point> points(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) points[i] = canvas({x[i], y[i]});
  return points;
}

// Thins a curve: per half pixel across, its first, lowest, highest and last point draw the same curve.
std::vector<Point> thinned(const std::vector<Point>& points) {
  if (points.size() < 4000) return points;
  constexpr double column = 0.5;  // px
  std::vector<Point> result;
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    const auto same = [&](std::size_t i) {
      return drawable(points[i]) && std::floor(points[i].x / column) == std::floor(points[begin].x / column);
    };
    if (drawable(points[begin])) {
      while (end < points.size() && same(end)) ++end;
    }
    const auto [low, high] = std::minmax_element(points.begin() + static_cast<std::ptrdiff_t>(begin),
                                                 points.begin() + static_cast<std::ptrdiff_t>(end),
                                                 [](Point a, Point b) { return a.y < b.y; });
    std::array keep{begin, static_cast<std::size_t>(low - points.begin()),
                    static_cast<std::size_t>(high - points.begin()), end - 1};
    std::sort(keep.begin(), keep.end());
    const auto last = std::unique(keep.begin(), keep.end());
    for (auto i = keep.begin(); i != last; ++i) result.push_back(points[*i]);
    begin = end;
  }
  return result;
}

// Few points are large; many are faint, and their ink adds up where they are dense.
struct DotStyle {
  double radius, opacity;
  std::size_t coats;
};

DotStyle dot_style(std::size_t count, double radius) {
  DotStyle style = count <= 150    ? DotStyle{2.6, 0.85, 1}
                   : count <= 1500 ? DotStyle{1.7, 0.6, 2}
                   : count <= 6000 ? DotStyle{1.2, 0.45, 4}
                                   : DotStyle{0.9, 0.35, 8};
  if (radius > 0) style.radius = radius;
  return style;
}

Ink dots(Colour colour, const DotStyle& style) {
  return {.stroke = colour, .width = 2 * style.radius, .opacity = style.opacity};
}

// The band between low and high where both are defined, one closed shape a run.
void fill_runs(Pen& pen, const std::vector<Point>& low, const std::vector<Point>& high) {
  const auto there = [&](std::size_t i) { return drawable(low[i]) && drawable(high[i]); };
  for (std::size_t begin = 0; begin < low.size();) {
    std::size_t end = begin;
    while (end < low.size() && there(end)) ++end;
    if (end > begin) {
      pen.move(low[begin]);
      for (std::size_t i = begin + 1; i < end; ++i) pen.line(low[i]);
      for (std::size_t i = end; i-- > begin;) pen.line(high[i]);
      pen.close();
    }
    begin = end + 1;
  }
}

}  // namespace

void draw(const Line& line, Colour colour, Canvas& canvas) {
  Pen pen;
  pen.polyline(thinned(placed(line.x, line.y, canvas)));
  canvas.svg.open("line");
  canvas.svg.path(pen, {.stroke = colour, .width = line.width, .dash = line.dashed ? std::string(dashes) : ""});
  canvas.svg.close();
}

void draw(const Points& points, Colour colour, Canvas& canvas) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const Point p = canvas({points.x[i], points.y[i]});
    const bool valued = points.value.empty() || drawable(points.value[i]);
    if (!drawable(p) || !valued) continue;
    const bool inside = canvas.x.range().holds(points.x[i]) && canvas.y.range().holds(points.y[i]);
    if (inside)
      shown.push_back(i);
    else
      ++canvas.outside;
  }
  const DotStyle style = dot_style(shown.size(), points.radius);
  const bool by_value = !points.value.empty();
  std::vector<Pen> pens(by_value ? Canvas::shades : style.coats);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    const std::size_t i = shown[k];
    const std::size_t pen = by_value ? static_cast<std::size_t>(canvas.shade(points.value[i])) : k % style.coats;
    pens[pen].dot(canvas({points.x[i], points.y[i]}));
  }
  canvas.svg.open("points");
  for (std::size_t i = 0; i < pens.size(); ++i) {
    Ink ink = dots(by_value ? canvas.shade_colour(static_cast<int>(i)) : colour, style);
    if (by_value) ink.opacity = 1;
    canvas.svg.path(pens[i], ink);
  }
  canvas.svg.close();
}

void draw(const Rule& rule, Colour colour, Canvas& canvas) {
  const double at = rule.vertical ? canvas.x(rule.at) : canvas.y(rule.at);
  if (!drawable(at)) return;
  const Box& area = canvas.area;
  const Point a = rule.vertical ? Point{at, area.y} : Point{area.x, at};
  const Point b = rule.vertical ? Point{at, area.bottom()} : Point{area.right(), at};
  canvas.svg.open("rule");
  canvas.svg.line(a, b,
                  {.stroke = colour, .width = 1, .dash = rule.dashed ? std::string(dashes) : "", .cap = Cap::butt});
  if (rule.vertical && !rule.label.empty()) {
    const bool left = at + text_width(rule.label, tick_size) + 6 > area.right();
    canvas.svg.text({at + (left ? -4 : 4), area.y + 11}, rule.label,
                    {.size = tick_size, .colour = colour, .anchor = left ? Anchor::end : Anchor::start, .halo = true});
  }
  canvas.svg.close();
}

void draw(const Band& band, Colour colour, Canvas& canvas) {
  Pen pen;
  fill_runs(pen, placed(band.x, band.low, canvas), placed(band.x, band.high, canvas));
  canvas.svg.open("band");
  canvas.svg.path(pen, {.fill = colour, .opacity = band_opacity});
  canvas.svg.close();
}

void draw(const Histogram& histogram, Colour colour, Canvas& canvas) {
  const Bars counted = bars(histogram);
  canvas.outside += counted.outside;
  Pen fill;
  for (std::size_t i = 0; i < counted.heights.size(); ++i) {
    if (counted.heights[i] <= 0) continue;
    const Point low = canvas({histogram.edges[i], std::max(0.0, canvas.y.range().low)});
    const Point high = canvas({histogram.edges[i + 1], counted.heights[i]});
    fill.rectangle({low.x + 0.5, high.y, std::max(high.x - low.x - 1, 0.5), low.y - high.y});
  }
  canvas.svg.open("histogram");
  canvas.svg.path(fill, {.fill = colour, .opacity = bar_opacity});
  canvas.svg.close();
}

void draw(const ErrorBars& errors, Colour colour, Canvas& canvas) {
  canvas.svg.open("error-bars");
  Pen stems, marks;
  for (std::size_t i = 0; i < errors.x.size(); ++i) {
    const Point p = canvas({errors.x[i], errors.y[i]});
    if (!drawable(p)) continue;
    const Point low = canvas({errors.x[i], errors.low[i]}), high = canvas({errors.x[i], errors.high[i]});
    if (drawable(low) && drawable(high)) {
      stems.move(low);
      stems.line(high);
    }
    marks.dot(p);
  }
  canvas.svg.path(stems, {.stroke = colour, .width = 1.2});
  canvas.svg.path(marks, {.stroke = colour, .width = 6});
  canvas.svg.close();
}

}  // namespace muster::plotting
