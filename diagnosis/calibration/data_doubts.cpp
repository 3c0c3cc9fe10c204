#include "diagnosis/calibration/data_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <muster/tables.hpp>
#include <set>
#include <tuple>

#include "diagnosis/data/thresholds.hpp"
#include "text/names.hpp"

namespace muster::diagnosis {
namespace {

struct PlanBox {
  double x0 = 1e300, y0 = 1e300, x1 = -1e300, y1 = -1e300, top = -1e300, foot = 1e300;

  void add(double x, double y) {
    x0 = std::min(x0, x), x1 = std::max(x1, x);
    y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  double size() const { return std::hypot(x1 - x0, y1 - y0); }
  // m; 0 inside.
  double beside(double x, double y) const {
    return std::hypot(std::max({x0 - x, x - x1, 0.0}), std::max({y0 - y, y - y1, 0.0}));
  }
};

PlanBox plan_of(const LinkModel& model) {
  PlanBox plan;
  const Table* table = model.simulation().board().find("wall/*/shape");
  for (std::size_t i = 0; table && i < table->now().rows; ++i) {
    const Wall& w = reinterpret_cast<const Wall*>(table->now().data.data())[i];
    plan.add(w.x0, w.y0), plan.add(w.x1, w.y1);
    plan.top = std::max(plan.top, w.base + w.height);
    plan.foot = std::min(plan.foot, w.base);
  }
  return plan;
}

// Places of one radio in the data.
struct RadioTrack {
  std::vector<Point> places;
  PlanBox box;
  double nearest = 1e300, furthest = 0;  // m, beside the plan

  RadioTrack(const Dataset& data, std::size_t radio, const std::vector<Point>& at, const Factor& end,
             const PlanBox& plan) {
    for (std::size_t row = 0; row < data.rows(); ++row) {
      if (end.level[row] != radio) continue;
      places.push_back(at[row]);
      box.add(at[row][0], at[row][1]);
      const double beside = plan.beside(at[row][0], at[row][1]);
      nearest = std::min(nearest, beside), furthest = std::max(furthest, beside);
    }
  }
  std::size_t distinct() const {
    std::set<std::pair<double, double>> seen;
    for (const Point& p : places) seen.emplace(p[0], p[1]);
    return seen.size();
  }
  // True if the places, times this factor, cover much of the plan and lie within it, or not far around it: a robot
  // drives before the house, too.
  bool fits(const PlanBox& plan, double factor) const {
    const double margin = std::max(1.0, 0.25 * plan.size());  // m
    return factor * box.size() > 0.25 * plan.size() && std::all_of(places.begin(), places.end(), [&](const Point& p) {
             return plan.beside(factor * p[0], factor * p[1]) <= margin;
           });
  }
};

std::string size_of(const PlanBox& plan) {
  return fmt::format("{:.3g} x {:.3g} m", plan.x1 - plan.x0, plan.y1 - plan.y0);
}

// `end`: "rx", whose columns hold the places.
std::string place_doubt(const std::string& name, const RadioTrack& track, const PlanBox& plan, const char* end) {
  const bool is_far = track.furthest > thresholds::plans_beside * plan.size();
  for (const auto& [factor, unit] : {std::pair(0.01, "centimetres"), {0.001, "millimetres"}}) {
    if (is_far && track.fits(plan, factor))
      return fmt::format(
          "places of {3} reach from x = {4:.4g}, y = {5:.4g} to x = {6:.4g}, y = {7:.4g} m, far beyond the plan of the "
          "walls, {8}, and lie in it as {0}; are they {0}? expected metres (a map of muster import: {1}_x[m] = "
          "{2}*COLUMN, {1}_y[m] "
          "alike)",
          unit, end, factor, quote(name), track.box.x0, track.box.y0, track.box.x1, track.box.y1, size_of(plan));
  }
  if (track.nearest > thresholds::degrees_beside && track.box.size() < thresholds::degrees_extent &&
      track.distinct() >= thresholds::degrees_places)
    return fmt::format(
        "all {} places of {} lie within {:.2g} m, {:.3g} m beside the plan of the walls; are these latitude and "
        "longitude? expected metres of the plan (a map of muster import: {}_x[m] = east LATITUDE LONGITUDE)",
        track.distinct(), quote(name), track.box.size(), track.nearest, end);
  if (track.nearest > thresholds::plans_beside * plan.size())
    return fmt::format(
        "all places of {} lie {:.4g} to {:.4g} m beside the plan of the walls, {}; are they of another site, or from "
        "another origin? expected metres of the plan",
        quote(name), track.nearest, track.furthest, size_of(plan));
  return "";
}

// "data.csv:1:40: " of the column of one end: a unit is a matter of its header.
std::string at_column(const Dataset& data, const std::string& name) {
  const auto found = data.table->find(name);
  return found ? data.table->header_place(*found).text() + ": " : "";
}

// A height in metres that the walls have only as millimetres, or all of them below the feet of the walls.
std::string height_doubt(const std::string& name, const RadioTrack& track, const PlanBox& plan, const char* end) {
  double low = 1e300, high = -1e300;
  for (const Point& p : track.places) {
    low = std::min(low, std::isnan(p[2]) ? -1e300 : p[2]);
    high = std::max(high, std::isnan(p[2]) ? 1e300 : p[2]);
  }
  if (high < 0 && high < plan.foot && plan.top > 0)
    return fmt::format(
        "{} is {:.4g} m or more below the ground (z = 0), throughout; is z down in the data, as in PX4 (NED)? expected "
        "metres up (a map of muster import: {}_z[m] = -1*COLUMN)",
        quote(name), -high, end);
  if (!(low > plan.top + thresholds::height_above) || low / 1000 > plan.top) return "";
  return fmt::format(
      "{} stands {:.4g} m high, and the walls end at {:.3g} m; are these millimetres? expected metres (a map of muster "
      "import: {}_z[m] = 0.001*COLUMN)",
      quote(name), low, plan.top, end);
}

double distance(const std::array<End, 2>& ends) {
  return std::hypot(ends[0].x - ends[1].x, ends[0].y - ends[1].y, ends[0].z - ends[1].z);
}

// Levels of Bel: near 0, and a tenth of what distance alone makes of them.
std::string level_doubt(const LinkModel& model, const Dataset& data) {
  double low = 1e300, high = -1e300, near = 1e300, far = 0;
  std::size_t heard = 0;
  for (std::size_t row = 0; row < data.rows(); ++row) {
    if (std::isnan(data.rssi[row])) continue;
    ++heard;
    low = std::min(low, data.rssi[row]), high = std::max(high, data.rssi[row]);
    near = std::min(near, distance(model.ends()[row])), far = std::max(far, distance(model.ends()[row]));
  }
  if (heard < thresholds::bel_readings || low < -thresholds::bel_level || high > thresholds::bel_level ||
      !(far > thresholds::bel_distances * std::max(near, 1.0)))
    return "";
  const bool loss = data.reading == "path_loss";
  return fmt::format(
      "{} lie from {:.3g} to {:.3g} {} over distances from {:.3g} to {:.3g} m, closer to 0 and to one another than "
      "radio levels do; are these Bel? expected {} (a map of muster import: {} = 10*COLUMN)",
      loss ? "all losses" : "all levels", loss ? -high : low, loss ? -low : high, loss ? "dB" : "dBm", near, far,
      loss ? "dB" : "dBm", loss ? "path_loss[dB]" : "rssi[dBm]");
}

// Columns walls_NAME of materials that the world has not.
std::vector<std::string> material_doubts(const LinkModel& model, const Dataset& data) {
  std::vector<std::string> result, known;
  if (const Set* materials = model.simulation().board().find_set("material")) known = materials->names;
  for (const TextColumn& column : data.table->columns()) {
    const std::string start = "walls_", name = column.name.substr(0, start.size()) == start
                                                   ? column.name.substr(start.size())
                                                   : std::string();
    if (name.empty() || known.empty() || std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::vector<std::string> columns;
    for (const std::string& material : known) columns.push_back(start + material);
    result.push_back("column " + quote(column.label()) + ": the world has no material " + quote(name) + "; " +
                     suggest(column.name, columns));
  }
  return result;
}

}  // namespace

std::vector<std::string> doubts_of(const LinkModel& model, const Dataset& data) {
  std::vector<std::string> result = material_doubts(model, data);
  const auto add = [&](const std::string& column, const std::string& doubt) {
    if (!doubt.empty()) result.push_back(at_column(data, column) + doubt);
  };
  add(data.reading, level_doubt(model, data));
  const PlanBox plan = plan_of(model);
  if (!data.has_places() || !(plan.x1 > plan.x0 && plan.y1 > plan.y0)) return result;
  for (const auto& [name, end, at] :
       {std::tuple("tx", &data.tx, &data.tx_at), std::tuple("rx", &data.rx, &data.rx_at)}) {
    const std::string begin(name);
    for (std::size_t radio = 0; radio < end->levels.size(); ++radio) {
      const RadioTrack track(data, radio, *at, *end, plan);
      add(begin + "_x", place_doubt(end->levels[radio], track, plan, name));
      add(begin + "_z", height_doubt(end->levels[radio], track, plan, name));
    }
  }
  return result;
}

}  // namespace muster::diagnosis
