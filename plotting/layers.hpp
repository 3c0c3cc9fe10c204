// Layers of a panel. Each is plain data; a value that is NaN or infinite is left out, never drawn at a wrong place.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "colour.hpp"
#include "scale.hpp"

namespace muster::plotting {

// A layer without a colour takes the next of series_colour(); a Band takes that of the line that follows it.

// A curve, broken where x or y is not drawable. Its label is at its right end.
struct Line {
  std::vector<double> x{}, y{};
  std::string label{};
  std::optional<Colour> colour{};
  double width = 1.5;  // px
  bool dashed = false;
};

struct Points {
  std::vector<double> x{}, y{};
  std::vector<double> value{};  // coloured by the panel's map where given
  std::string label{};
  std::optional<Colour> colour{};
  double radius = 0;  // px; 0: by the number of points
};

// A straight line across the panel, such as a threshold.
struct Rule {
  double at = 0;
  std::string label{};
  bool vertical = false;
  Colour colour = grey;
  bool dashed = true;
};

struct Band {
  std::vector<double> x{}, low{}, high{};
  std::string label{};
  std::optional<Colour> colour{};
};

// Counts of values in [edge, next edge), the last bin closed; a note gives the number of values outside.
struct Histogram {
  std::vector<double> values{}, edges{};
  std::string label{};
  std::optional<Colour> colour{};
  bool density = false;  // the area is 1, to compare with a distribution
};

struct ErrorBars {
  std::vector<double> x{}, y{}, low{}, high{};  // low and high are ends, not lengths
  std::string label{};
  std::optional<Colour> colour{};
};

// Square cells coloured by value; x and y are centres. Those with fewer than min_count samples are grey.
struct Cells {
  std::vector<double> x{}, y{}, value{};
  std::vector<double> count{};
  double min_count = 0;
  double size = 0.25;  // m
};

struct Wall {
  Point from{}, to{};
  double thickness = 0.1;  // m
  std::string material{};
};

struct Door {
  Point from{}, to{};
  bool open = true;
  double thickness = 0.1;  // m, of its wall
};

struct Station {
  Point at{};
  std::string name{};
};

// A floor plan: walls shaded by material, in the order of the materials' first walls.
struct FloorPlan {
  std::vector<Wall> walls{};
  std::vector<Door> doors{};
  std::vector<Station> stations{};
};

struct Robot {
  Point at{};
  double heading = 0;  // rad
  std::string name{};
  std::optional<Colour> colour{};
  double radius = 0.15;  // m; drawn with a minimum visible size
};

struct Robots {
  std::vector<Robot> robots{};
};

struct Path {
  std::vector<Point> points{};
  std::vector<double> value{};  // one time for each point: coloured by the panel's map
  std::optional<Colour> colour{};
};

struct Link {
  Point from{}, to{};
  double value = 0;  // NaN: no label
};

// Links below the threshold are dashed and vermillion.
struct Links {
  std::vector<Link> links{};
  std::string unit = "dBm";
  std::optional<double> threshold{};
  int decimals = 0;
};

using Layer = std::variant<Line, Points, Rule, Band, Histogram, ErrorBars, Cells, FloorPlan, Robots, Path, Links>;

}  // namespace muster::plotting
