// Floor plans: walls, doors, stations, robots, paths and links.

#include <algorithm>

#include "draw.hpp"

namespace muster::plotting {
namespace {

double thickness_px(double thickness, const Canvas& canvas) { return std::max(1.4, thickness * canvas.x.pixels()); }

void draw_walls(const FloorPlan& plan, Canvas& canvas) {
  const auto names = materials(plan);
  // Thick walls last: where walls meet, the thin one ends inside the thick one.
  std::vector<Wall> walls = plan.walls;
  std::stable_sort(walls.begin(), walls.end(), [](const Wall& a, const Wall& b) { return a.thickness < b.thickness; });
  canvas.svg.open("walls");
  for (const Wall& wall : walls) {
    const Point a = canvas(wall.from), b = canvas(wall.to);
    if (!drawable(a) || !drawable(b)) continue;
    const auto material = std::find(names.begin(), names.end(), wall.material) - names.begin();
    canvas.svg.line(a, b,
                    {.stroke = wall_shade(static_cast<std::size_t>(material)),
                     .width = thickness_px(wall.thickness, canvas),
                     .cap = Cap::square});
    canvas.labels.occupy_line(a, b, 1);
  }
  canvas.svg.close();
}

// Architects' symbol: a gap in the wall, the open leaf at a right angle to it, and the arc of its swing.
void draw_door(const Door& door, Canvas& canvas) {
  const Point a = canvas(door.from), b = canvas(door.to);
  if (!drawable(a) || !drawable(b)) return;
  constexpr Colour leaf{120, 90, 60};
  canvas.svg.line(a, b, {.stroke = white, .width = thickness_px(door.thickness, canvas) + 0.6, .cap = Cap::butt});
  if (!door.open) {
    canvas.svg.line(a, b, {.stroke = leaf, .width = 1.6, .cap = Cap::butt});
    return;
  }
  const Point end{a.x + (b.y - a.y), a.y - (b.x - a.x)};
  canvas.svg.line(a, end, {.stroke = leaf, .width = 1.2});
  Pen swing;
  swing.move(end);
  swing.arc(std::hypot(b.x - a.x, b.y - a.y), true, b);
  canvas.svg.path(swing, {.stroke = leaf, .width = 0.6, .opacity = 0.6});
}

// Labels avoid a path; points closer than a letter to the last one are skipped.
void keep_clear(const std::vector<Point>& points, Labels& labels) {
  constexpr double letter = 8;  // px
  Point last{NAN, NAN};
  for (const Point p : points) {
    if (drawable(p) && drawable(last) && std::hypot(p.x - last.x, p.y - last.y) < letter) continue;
    if (drawable(p) && drawable(last)) labels.occupy_line(last, p, 0.5);
    last = p;
  }
}

void draw_station(const Station& station, Canvas& canvas) {
  constexpr double size = 6.5;  // px
  const Point p = canvas(station.at);
  if (!drawable(p)) return;
  Pen triangle;
  triangle.move({p.x, p.y - size});
  triangle.line({p.x + 0.87 * size, p.y + size / 2});
  triangle.line({p.x - 0.87 * size, p.y + size / 2});
  triangle.close();
  canvas.svg.path(triangle, {.fill = black, .stroke = white, .width = 1});
  canvas.labels.occupy({p.x - size, p.y - size, 2 * size, 1.5 * size}, 5);
  canvas.labels.beside(p, size, station.name, black);
}

}  // namespace

void draw(const FloorPlan& plan, Colour, Canvas& canvas) {
  draw_walls(plan, canvas);
  canvas.svg.open("doors");
  for (const Door& door : plan.doors) draw_door(door, canvas);
  canvas.svg.close();
}

void draw_stations(const FloorPlan& plan, Canvas& canvas) {
  canvas.svg.open("stations");
  for (const Station& station : plan.stations) draw_station(station, canvas);
  canvas.svg.close();
}

void draw(const Robots& robots, Colour, Canvas& canvas) {
  constexpr double least_radius = 5;  // px
  canvas.svg.open("robots");
  for (std::size_t i = 0; i < robots.robots.size(); ++i) {
    const Robot& robot = robots.robots[i];
    const Point p = canvas(robot.at);
    if (!drawable(p)) continue;
    const Colour colour = robot.colour.value_or(series_colour(i));
    const double radius = std::max(least_radius, robot.radius * canvas.x.pixels());
    const Point nose{p.x + 1.8 * radius * std::cos(robot.heading), p.y - 1.8 * radius * std::sin(robot.heading)};
    if (drawable(nose)) canvas.svg.line(p, nose, {.stroke = white, .width = 3.8});
    canvas.svg.circle(p, radius, {.fill = colour, .stroke = white, .width = 1});
    if (drawable(nose)) {
      canvas.svg.line(p, nose, {.stroke = colour, .width = 1.8});
      canvas.labels.occupy_line(p, nose, 5);
    }
    canvas.labels.occupy({p.x - radius, p.y - radius, 2 * radius, 2 * radius}, 5);
    canvas.labels.beside(p, radius, robot.name, colour);
  }
  canvas.svg.close();
}

void draw(const Path& path, Colour colour, Canvas& canvas) {
  canvas.svg.open("path");
  std::vector<Point> points;
  for (const Point p : path.points) points.push_back(canvas(p));
  keep_clear(points, canvas.labels);
  const auto stroke = [&](const std::vector<Point>& piece, Colour shade) {
    Pen pen;
    pen.polyline(piece);
    canvas.svg.path(pen, {.stroke = shade, .width = 1.6});
  };
  if (path.value.empty()) {
    stroke(points, colour);
  } else {
    // Neighbouring pieces of one shade form one stroke; a point without a value breaks the path.
    std::vector<Point> piece;
    int shade = -1;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const bool there = drawable(path.value[i]) && drawable(points[i]) && drawable(points[i + 1]);
      const int next = there ? canvas.shade(path.value[i]) : -1;
      if (next != shade && shade >= 0) stroke(piece, canvas.shade_colour(shade));
      if (next != shade) piece = {points[i]};
      shade = next;
      piece.push_back(points[i + 1]);
    }
    if (shade >= 0) stroke(piece, canvas.shade_colour(shade));
  }
  canvas.svg.close();
}

void draw(const Links& links, Colour colour, Canvas& canvas) {
  canvas.svg.open("links");
  for (const Link& link : links.links) {
    const Point a = canvas(link.from), b = canvas(link.to);
    if (!drawable(a) || !drawable(b)) continue;
    const bool weak = links.threshold && link.value < *links.threshold;
    const Colour shade = weak ? vermillion : colour;
    canvas.svg.line(a, b, {.stroke = shade, .width = 0.9, .dash = weak ? "4 3" : "", .cap = Cap::butt});
    canvas.labels.occupy_line(a, b, 0.5);
    if (!drawable(link.value)) continue;
    std::string label = number_label(link.value, links.decimals);
    if (!links.unit.empty()) label += ' ' + links.unit;
    canvas.labels.along(a, b, std::move(label), weak ? vermillion : Colour{70, 70, 70});
  }
  canvas.svg.close();
}

}  // namespace muster::plotting
