// Text layout: width of text, placement of labels with least overlap, and spacing of lines.
#pragma once

#include <string>
#include <vector>

#include "svg.hpp"

namespace muster::plotting {

// Upper bound of the width of `text` in px, in Helvetica or Arial (Liberation Sans has the same metrics) or in DejaVu
// Sans.
double text_width(std::string_view text, double size);

// Upper bound of the width of bold text relative to the same in regular: DejaVu Sans Bold has 1.12 to 1.14 in English.
constexpr double bold_widening = 1.15;

// Wraps `text` into lines of at most `width` px.
std::vector<std::string> wrapped(std::string_view text, double width, double size);

// Positions closest to `wanted` that are at least `gap` apart, in the same order, and inside `range` where they fit.
std::vector<double> spread(const std::vector<double>& wanted, double gap, Range range);

// Labels of a floor plan or a chart: each is placed where it covers least of the existing drawing.
class Labels {
 public:
  // Marks a box as occupied; a greater weight is avoided more.
  void occupy(const Box& box, double weight = 1);
  void occupy_line(Point a, Point b, double weight);
  // Right of, left of, above or below a mark of this radius, whichever is free.
  void beside(Point mark, double radius, std::string text, Colour colour);
  // On a line, near its middle.
  void along(Point a, Point b, std::string text, Colour colour);
  // Writes all labels, inside `area`.
  void write(Svg& svg, const Box& area);

 private:
  struct Candidate {
    Point centre;
    double penalty;  // px^2 of covered area that it must save to be preferred
  };
  struct Request {
    std::string text;
    Colour colour;
    std::vector<Candidate> candidates;
    bool mark;  // a mark's name is placed before labels of lines, which have more freedom
  };
  struct Occupied {
    Box box;
    double weight;
  };
  double cost(const Box& box, const Box& area) const;

  std::vector<Request> requests_;
  std::vector<Occupied> occupied_;
};

}  // namespace muster::plotting
