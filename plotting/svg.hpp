// Writes SVG elements: no scripts, no ids (so that several pictures may share a page), text as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "colour.hpp"
#include "scale.hpp"

namespace muster::plotting {

struct Box {
  double x = 0, y = 0, width = 0, height = 0;
  double right() const { return x + width; }
  double bottom() const { return y + height; }
};

// `text` as XML character data or attribute value; bytes that XML 1.0 does not allow become U+FFFD.
std::string escaped(std::string_view text);

enum class Cap { round = 1, butt, square };

// Fill and stroke of a shape; an absent colour is not painted.
struct Ink {
  std::optional<Colour> fill{};
  std::optional<Colour> stroke{};
  double width = 1;
  double opacity = 1;
  std::string dash{};
  Cap cap = Cap::round;
  bool crisp = false;  // edges on whole pixels, so that neighbouring cells have no seam
};

enum class Anchor { start = 1, middle, end };

struct Lettering {
  double size = 11;
  Colour colour = black;
  Anchor anchor = Anchor::start;
  bool bold = false;
  bool halo = false;  // white around the letters, for text over lines
  double turn = 0;    // degrees, clockwise
};

// The `d` of a path, in pixels rounded to 0.01 (dots to 0.1: 20,000 of them stay below 300 kB).
class Pen {
 public:
  void move(Point p);
  void line(Point p);
  void dot(Point p);  // of zero length: a round cap makes it a disc
  void rectangle(const Box& box);
  void polyline(const std::vector<Point>& points);  // starts again after each point that is not drawable
  void arc(double radius, bool clockwise, Point to);
  void close() { data_ += 'z'; }
  bool empty() const { return data_.empty(); }
  const std::string& data() const { return data_; }

 private:
  std::string data_;
};

class Svg {
 public:
  // A group of this class, for readers and tests of the file; with `clip`, nothing shows outside the box.
  void open(std::string_view name, const Box* clip = nullptr);
  void close();
  void path(const Pen& pen, const Ink& ink);
  void line(Point a, Point b, const Ink& ink);
  void circle(Point centre, double radius, const Ink& ink);
  void rectangle(const Box& box, const Ink& ink);
  void text(Point at, std::string_view text, const Lettering& lettering);
  // The whole document; screen readers read `title` and `description`.
  std::string document(double width, double height, std::string_view title, std::string_view description) const;

 private:
  std::string body_;
  std::vector<std::string_view> open_;
};

}  // namespace muster::plotting
