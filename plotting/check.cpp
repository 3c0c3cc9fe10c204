// Refuses figures that cannot be drawn truthfully.
#include <fmt/format.h>

#include <stdexcept>

#include "view.hpp"

namespace muster::plotting {
namespace {

struct Check {
  const std::string& which;

  [[noreturn]] void refuse(const std::string& what) const { throw std::invalid_argument(which + ": " + what); }
  void same(std::string_view layer, std::size_t rows, std::initializer_list<std::size_t> columns) const {
    for (const std::size_t column : columns) {
      if (column != rows)
        refuse(fmt::format("{}: columns of {} and {} rows; expected the same length", layer, rows, column));
    }
  }
  void same_or_none(std::string_view layer, std::size_t rows, std::size_t column) const {
    if (column != 0) same(layer, rows, {column});
  }

  void operator()(const Line& l) const { same("line", l.x.size(), {l.y.size()}); }
  void operator()(const Points& p) const {
    same("points", p.x.size(), {p.y.size()});
    same_or_none("points", p.x.size(), p.value.size());
  }
  void operator()(const Rule&) const {}
  void operator()(const Band& b) const { same("band", b.x.size(), {b.low.size(), b.high.size()}); }
  void operator()(const Histogram& h) const {
    if (h.edges.size() == 1) refuse("histogram: one edge; expected none or at least two");
    for (std::size_t i = 0; i < h.edges.size(); ++i) {
      if (!drawable(h.edges[i]) || (i > 0 && h.edges[i] <= h.edges[i - 1])) refuse("histogram: edges must rise");
    }
  }
  void operator()(const ErrorBars& e) const {
    same("error bars", e.x.size(), {e.y.size(), e.low.size(), e.high.size()});
  }
  void operator()(const Cells& c) const {
    same("cells", c.x.size(), {c.y.size(), c.value.size()});
    same_or_none("cells", c.x.size(), c.count.size());
    if (!drawable(c.size) || c.size <= 0) refuse(fmt::format("cells: size {}; expected more than 0 m", c.size));
  }
  void operator()(const FloorPlan&) const {}
  void operator()(const Robots&) const {}
  void operator()(const Path& p) const { same_or_none("path", p.points.size(), p.value.size()); }
  void operator()(const Links&) const {}

  void axis(std::string_view name, const Axis& axis) const {
    for (const auto& limit : {axis.from, axis.to}) {
      if (limit && !drawable(*limit)) refuse(fmt::format("{} axis: limit {}; expected a finite number", name, *limit));
      if (limit && axis.log && *limit <= 0)
        refuse(fmt::format("{} axis: limit {}; expected more than 0 on a log axis", name, *limit));
    }
    if (axis.from && axis.to && *axis.from >= *axis.to) {
      refuse(fmt::format("{} axis: from {} to {}; expected from < to", name, *axis.from, *axis.to));
    }
  }
};

}  // namespace

void check(const Panel& panel, const std::string& which) {
  const Check checks{which};
  for (const Layer& layer : panel.layers) std::visit(checks, layer);
  checks.axis("x", panel.x);
  checks.axis("y", panel.y);
  checks.axis("value", panel.value);
  if (equal_units(panel) && (panel.x.log || panel.y.log))
    checks.refuse("log axis; expected linear where units are equal");
}

}  // namespace muster::plotting
