#include "svg.hpp"

#include <fmt/format.h>

namespace muster::plotting {
namespace {

std::string pixels(double v, int decimals = 2) {
  std::string text = fmt::format("{:.{}f}", v, decimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string pair(Point p, int decimals = 2) { return pixels(p.x, decimals) + ' ' + pixels(p.y, decimals); }

std::string attributes(const Ink& ink) {
  std::string result = fmt::format(" fill=\"{}\"", ink.fill ? ink.fill->hex() : "none");
  if (ink.stroke) {
    result += fmt::format(" stroke=\"{}\" stroke-width=\"{}\"", ink.stroke->hex(), pixels(ink.width));
    if (ink.cap == Cap::round) result += " stroke-linecap=\"round\" stroke-linejoin=\"round\"";
    if (ink.cap == Cap::square) result += " stroke-linecap=\"square\"";
    if (!ink.dash.empty()) result += fmt::format(" stroke-dasharray=\"{}\"", ink.dash);
  }
  if (ink.opacity < 1) result += fmt::format(" opacity=\"{}\"", pixels(ink.opacity));
  if (ink.crisp) result += " shape-rendering=\"crispEdges\"";
  return result;
}

// The length of the valid UTF-8 sequence at the start of `text`, 0 if there is none (RFC 3629).
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xC2 && lead < 0xE0   ? 2
                             : lead >= 0xE0 && lead < 0xF0 ? 3
                             : lead >= 0xF0 && lead < 0xF5 ? 4
                                                           : 0;
  if (length == 0 || text.size() < length) return 0;
  unsigned code = lead & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return 0;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  const bool overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return overlong || surrogate || code > 0x10FFFF || code == 0xFFFE || code == 0xFFFF ? 0 : length;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    const char c = text[0];
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&#39;";
    else if (length == 0 || (length == 1 && static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n'))
      result += "\uFFFD";
    else
      result += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

void Pen::move(Point p) { data_ += 'M' + pair(p); }
void Pen::line(Point p) { data_ += 'L' + pair(p); }
void Pen::dot(Point p) { data_ += 'M' + pair(p, 1) + "h0"; }

void Pen::rectangle(const Box& box) {
  data_ +=
      fmt::format("M{}h{}v{}h{}z", pair({box.x, box.y}), pixels(box.width), pixels(box.height), pixels(-box.width));
}

void Pen::polyline(const std::vector<Point>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!drawable(points[i])) continue;
    const bool begins = i == 0 || !drawable(points[i - 1]);
    const bool ends = i + 1 == points.size() || !drawable(points[i + 1]);
    if (begins && ends)
      dot(points[i]);
    else if (begins)
      move(points[i]);
    else
      line(points[i]);
  }
}

void Pen::arc(double radius, bool clockwise, Point to) {
  data_ += fmt::format("A{0} {0} 0 0 {1} {2}", pixels(radius), clockwise ? 1 : 0, pair(to));
}

void Svg::open(std::string_view name, const Box* clip) {
  if (clip) {
    // A nested picture in the same coordinates clips without the ids that a clipPath needs.
    body_ += fmt::format("<svg class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" viewBox=\"{} {} {} {}\">\n",
                         name, pixels(clip->x), pixels(clip->y), pixels(clip->width), pixels(clip->height),
                         pixels(clip->x), pixels(clip->y), pixels(clip->width), pixels(clip->height));
  } else {
    body_ += fmt::format("<g class=\"{}\">\n", name);
  }
  open_.push_back(clip ? "svg" : "g");
}

void Svg::close() {
  body_ += fmt::format("</{}>\n", open_.back());
  open_.pop_back();
}

void Svg::path(const Pen& pen, const Ink& ink) {
  if (!pen.empty()) body_ += fmt::format("<path d=\"{}\"{}/>\n", pen.data(), attributes(ink));
}

void Svg::line(Point a, Point b, const Ink& ink) {
  body_ += fmt::format("<line x1=\"{}\" y1=\"{}\" x2=\"{}\" y2=\"{}\"{}/>\n", pixels(a.x), pixels(a.y), pixels(b.x),
                       pixels(b.y), attributes(ink));
}

void Svg::circle(Point centre, double radius, const Ink& ink) {
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}/>\n", pixels(centre.x), pixels(centre.y), pixels(radius),
                       attributes(ink));
}

void Svg::rectangle(const Box& box, const Ink& ink) {
  body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>\n", pixels(box.x), pixels(box.y),
                       pixels(box.width), pixels(box.height), attributes(ink));
}

void Svg::text(Point at, std::string_view text, const Lettering& lettering) {
  std::string style = fmt::format(" font-size=\"{}\" fill=\"{}\"", pixels(lettering.size), lettering.colour.hex());
  if (lettering.anchor == Anchor::middle) style += " text-anchor=\"middle\"";
  if (lettering.anchor == Anchor::end) style += " text-anchor=\"end\"";
  if (lettering.bold) style += " font-weight=\"bold\"";
  if (lettering.halo) {
    style += " stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
  }
  if (lettering.turn != 0) style += fmt::format(" transform=\"rotate({} {})\"", pixels(lettering.turn), pair(at));
  body_ += fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", pixels(at.x), pixels(at.y), style, escaped(text));
}

std::string Svg::document(double width, double height, std::string_view title, std::string_view description) const {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
      "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\">\n"
      "<title>{2}</title>\n<desc>{3}</desc>\n<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n{4}</svg>\n",
      pixels(width), pixels(height), escaped(title), escaped(description), body_);
}

}  // namespace muster::plotting
