// Maps: residuals over the floor, with the findings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "diagnosis/report/figures.hpp"
#include "diagnosis/report/places.hpp"

namespace muster::report {
namespace {

namespace pic = plotting;
using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t most_maps = 4;
constexpr pic::Colour found_colour = pic::green;

double cell_size(const Places& places) {
  const double wanted = std::max(places.width, places.depth) / 40;
  for (const double size : {0.25, 0.5, 1.0, 2.0, 5.0}) {
    if (size >= wanted) return size;
  }
  return 10;
}

struct Cell {
  double sum = 0, count = 0;
};

// Means of `values` over cells, of the rows selected by `shown`.
template <class Shown>
pic::Cells cells_of(const Diagnosis& d, const Places& places, const VectorXd& values, Shown shown) {
  pic::Cells out{.size = cell_size(places)};
  std::map<std::pair<long, long>, Cell> cells;
  for (Index i = 0; i < values.size(); ++i) {
    if (!shown(i)) continue;
    Cell& cell = cells[{std::lround(std::floor(places.place(0, i) / out.size)),
                        std::lround(std::floor(places.place(1, i) / out.size))}];
    cell.sum += d.seen.count[i] * values[i];
    cell.count += d.seen.count[i];
  }
  for (const auto& [at, cell] : cells) {
    out.x.push_back((static_cast<double>(at.first) + 0.5) * out.size);
    out.y.push_back((static_cast<double>(at.second) + 0.5) * out.size);
    out.value.push_back(cell.sum / cell.count);
    out.count.push_back(cell.count);
  }
  return out;
}

pic::FloorPlan plan_of(const Diagnosis& d) {
  pic::FloorPlan plan;
  for (const auto& w : d.seen.walls) plan.walls.push_back({{w.x0, w.y0}, {w.x1, w.y1}, w.thickness, w.material});
  return plan;
}

// Stationary radios, one mark each.
std::map<int, pic::Station> stations_of(const Diagnosis& d, const Places& places) {
  std::map<int, pic::Station> out;
  std::set<int> moves;
  for (Index i = 0; i < places.anchor.cols(); ++i) {
    const int radio = places.radio[static_cast<std::size_t>(i)];
    const pic::Point at{places.anchor(0, i), places.anchor(1, i)};
    const auto [known, is_new] =
        out.try_emplace(radio, pic::Station{at, d.seen.radios[static_cast<std::size_t>(radio)]});
    if (!is_new && std::hypot(known->second.at.x - at.x, known->second.at.y - at.y) > 0.5) moves.insert(radio);
  }
  for (const int radio : moves) out.erase(radio);
  return out;
}

std::optional<double> value_of(const CauseEstimate& c, const std::string& name) {
  for (const CauseValue& v : c.values) {
    if (v.name == name) return v.value;
  }
  return {};
}

// An outline in the colour of findings, with a light rim for contrast on any cell.
void add_outline(const std::vector<double>& x, const std::vector<double>& y, std::vector<pic::Layer>& out) {
  out.emplace_back(pic::Line{.x = x, .y = y, .colour = pic::white, .width = 7});
  out.emplace_back(pic::Line{.x = x, .y = y, .colour = found_colour, .width = 3.5});
}

// Outlines of the findings; none for a finding without a place.
void add_found(const Diagnosis& d, std::vector<pic::Layer>& out) {
  for (const CauseEstimate& c : d.causes) {
    if (confidence_of(c) == Confidence::set_aside) continue;
    const auto x0 = value_of(c, "x0"), y0 = value_of(c, "y0"), x1 = value_of(c, "x1"), y1 = value_of(c, "y1");
    const auto x = value_of(c, "x"), y = value_of(c, "y");
    if (x0 && y0 && x1 && y1) add_outline({*x0, *x1}, {*y0, *y1}, out);
    if (x && y) {
      const double radius = std::max(value_of(c, "radius").value_or(0.3), 0.2);
      std::vector<double> xs, ys;
      for (int k = 0; k <= 48; ++k) {
        xs.push_back(*x + radius * std::cos(M_PI * k / 24));
        ys.push_back(*y + radius * std::sin(M_PI * k / 24));
      }
      add_outline(xs, ys, out);
    }
    for (const auto& w : d.seen.walls) {
      if (c.label == "wall/" + w.name) add_outline({w.x0, w.x1}, {w.y0, w.y1}, out);
    }
  }
}

std::string found_in_words(const Diagnosis& d) {
  std::vector<pic::Layer> layers;
  add_found(d, layers);
  return layers.empty() ? "" : " Green: what was found.";
}

// A round limit above nine cells in ten.
double limit_of(const VectorXd& values) {
  VectorXd sizes = values.cwiseAbs();
  if (sizes.size() == 0) return 3;
  auto* const at = sizes.data() + static_cast<Index>(0.9 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.data(), at, sizes.data() + sizes.size());
  return std::max(2.0, std::ceil(*at));
}

pic::Panel panel_of(pic::Cells cells, double limit, const std::string& title) {
  for (double& v : cells.value) v = std::clamp(v, -limit, limit);
  pic::Panel panel{.title = title,
                   .value = {.label = "measured − simulated", .unit = "dB", .from = -limit, .to = limit},
                   .map = pic::Map::diverging,
                   .frame = pic::Frame::scale_bar};
  panel.layers.emplace_back(std::move(cells));
  return panel;
}

std::string cells_in_words(const Places& places) {
  return fmt::format("Means over cells of {:g} m; stronger than the scale's ends is shown as its end.",
                     cell_size(places));
}

}  // namespace

pic::Figure residual_map(const Diagnosis& d) {
  const Places places = places_of(d.seen);
  const auto stations = stations_of(d, places);
  const double limit = limit_of(d.seen.before);
  std::vector<std::pair<double, int>> anchors;  // the strongest residual first
  std::map<int, Cell> by_anchor;
  for (Index i = 0; i < d.seen.before.size(); ++i) {
    Cell& cell = by_anchor[places.radio[static_cast<std::size_t>(i)]];
    const double gone = d.seen.before[i] * d.seen.before[i] - d.seen.after[i] * d.seen.after[i];
    cell.sum += gone;
    cell.count += 1;
  }
  for (const auto& [radio, cell] : by_anchor) anchors.emplace_back(-cell.sum, radio);
  std::stable_sort(anchors.begin(), anchors.end());
  pic::Figure figure{.title = "What the world gets wrong, over the floor",
                     .caption = cells_in_words(places) + found_in_words(d),
                     .columns = anchors.size() > 1 ? 2 : 1,
                     .width = anchors.size() > 1 ? 1000.0 : 800.0,
                     .share_value = true};
  if (anchors.size() > most_maps)
    figure.caption +=
        fmt::format(" The {} of {} radios whose residual the causes explain most of.", most_maps, anchors.size());
  for (std::size_t k = 0; k < std::min(anchors.size(), most_maps); ++k) {
    const int radio = anchors[k].second;
    pic::Panel panel = panel_of(
        cells_of(d, places, d.seen.before, [&](Index i) { return places.radio[static_cast<std::size_t>(i)] == radio; }),
        limit, anchors.size() > 1 ? "links with " + d.seen.radios[static_cast<std::size_t>(radio)] : "");
    pic::FloorPlan plan = plan_of(d);
    if (const auto at = stations.find(radio); at != stations.end()) plan.stations.push_back(at->second);
    panel.layers.emplace_back(std::move(plan));
    add_found(d, panel.layers);
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

pic::Figure before_and_after(const Diagnosis& d) {
  const Places places = places_of(d.seen);
  const auto all = [](Index) { return true; };
  const double limit = limit_of(d.seen.before);
  pic::Figure figure{.title = "Before and after",
                     .caption = cells_in_words(places) + " All links together." + found_in_words(d),
                     .columns = places.width > 2.2 * places.depth ? 1 : 2,
                     .width = places.width > 2.2 * places.depth ? 800.0 : 1000.0,
                     .share_value = true};
  for (const bool after : {false, true}) {
    const VectorXd& values = after ? d.seen.after : d.seen.before;
    const double rms = std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
    pic::Panel panel = panel_of(cells_of(d, places, values, all), limit,
                                fmt::format("{}: rows err by {:.2f} dB", after ? "extended" : "as given, fitted", rms));
    pic::FloorPlan plan = plan_of(d);
    for (const auto& [radio, station] : stations_of(d, places)) plan.stations.push_back(station);
    panel.layers.emplace_back(std::move(plan));
    if (after) add_found(d, panel.layers);
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace muster::report
