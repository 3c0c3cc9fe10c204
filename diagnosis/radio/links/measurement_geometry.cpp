#include "diagnosis/radio/links/measurement_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <muster/tables.hpp>
#include <numeric>

#include "diagnosis/radio/links/link_features.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

constexpr double quarter_turn = 1.5707963267948966;

void widen(Span& span, double value, bool first) {
  span.low = first ? value : std::min(span.low, value);
  span.high = first ? value : std::max(span.high, value);
}

// Common direction of walls modulo quarter turns: circular mean of fourfold angles, weighted by length.
double direction_of_walls(const LinkModel& model) {
  const Table* table = model.simulation().board().find("wall/*/shape");
  if (!table) return 0;
  const auto* walls = reinterpret_cast<const Wall*>(table->now().data.data());
  double c = 0, s = 0;
  for (std::size_t k = 0; k < table->now().rows; ++k) {
    const double x = walls[k].x1 - walls[k].x0, y = walls[k].y1 - walls[k].y0, length = std::hypot(x, y);
    c += length * std::cos(4 * std::atan2(y, x));
    s += length * std::sin(4 * std::atan2(y, x));
  }
  constexpr double rounding = 1e-3;  // of millimetres: a plan along the axes is not turned by nearly a quarter
  const double angle = std::atan2(s, c) / 4;
  return angle < -rounding ? angle + quarter_turn : std::max(angle, 0.0);
}

// Collinear walls, merged.
struct Line {
  double angle, offset, from, to;  // rad in [0, pi); m across and along that direction
};

std::vector<Line> lines_of(const LinkModel& model) {
  std::vector<Line> lines;
  const Table* table = model.simulation().board().find("wall/*/shape");
  if (!table) return lines;
  const auto* walls = reinterpret_cast<const Wall*>(table->now().data.data());
  for (std::size_t k = 0; k < table->now().rows; ++k) {
    const Wall& w = walls[k];
    if (std::hypot(w.x1 - w.x0, w.y1 - w.y0) < 1) continue;
    double angle = std::atan2(w.y1 - w.y0, w.x1 - w.x0);
    if (angle < 0) angle += 2 * quarter_turn;
    if (angle > 2 * quarter_turn - 0.03) angle -= 2 * quarter_turn;
    const auto same = std::find_if(lines.begin(), lines.end(), [&](const Line& l) {
      const double across = -std::sin(l.angle) * w.x0 + std::cos(l.angle) * w.y0;
      return std::abs(l.angle - angle) < 0.05 && std::abs(across - l.offset) < 0.3;
    });
    const double a = same != lines.end() ? same->angle : angle;
    const double at0 = std::cos(a) * w.x0 + std::sin(a) * w.y0, at1 = std::cos(a) * w.x1 + std::sin(a) * w.y1;
    if (same == lines.end()) {
      lines.push_back({a, -std::sin(a) * w.x0 + std::cos(a) * w.y0, std::min(at0, at1), std::max(at0, at1)});
    } else {
      same->from = std::min({same->from, at0, at1});
      same->to = std::max({same->to, at0, at1});
    }
  }
  return lines;
}

std::vector<OrientedRectangle> strips_of(const LinkModel& model) {
  constexpr std::size_t most = 12;
  std::vector<OrientedRectangle> strips;
  const std::vector<Line> lines = lines_of(model);
  for (const Line& a : lines) {
    for (const Line& b : lines) {
      const double width = b.offset - a.offset, from = std::max(a.from, b.from), to = std::min(a.to, b.to);
      if (std::abs(a.angle - b.angle) > 0.05 || width < thresholds::narrowest_strip ||
          width > thresholds::widest_strip || to - from < thresholds::shortest_strip)
        continue;
      const double along = (from + to) / 2, across = (a.offset + b.offset) / 2, c = std::cos(a.angle),
                   s = std::sin(a.angle);
      strips.push_back({c * along - s * across, s * along + c * across, to - from, a.angle, width});
    }
  }
  std::stable_sort(strips.begin(), strips.end(),
                   [](const OrientedRectangle& a, const OrientedRectangle& b) { return a.length > b.length; });
  if (strips.size() > most) strips.resize(most);
  return strips;
}

// Rooms with at least one in 50 readings of moving radios.
std::vector<OrientedRectangle> rooms_visited(const LinkModel& model, const MeasurementGeometry& survey) {
  const Table* table = model.simulation().board().find("wall/*/shape");
  if (!table) return {};
  const auto* walls = reinterpret_cast<const Wall*>(table->now().data.data());
  std::vector<std::array<double, 4>> lines;
  for (std::size_t k = 0; k < table->now().rows; ++k)
    lines.push_back({walls[k].x0, walls[k].y0, walls[k].x1, walls[k].y1});
  std::vector<std::array<double, 2>> places;
  for (const auto& ends : model.ends()) {
    for (const End& end : ends) {
      if (survey.moves[static_cast<std::size_t>(end.radio)]) places.push_back({end.x, end.y});
    }
  }
  std::vector<OrientedRectangle> result;
  for (const Room& room : rooms_of(lines, survey.plan_angle, places)) {
    if (static_cast<std::size_t>(room.visits) * thresholds::places_of_visit >= places.size())
      result.push_back(room.bounds);
  }
  return result;
}

double height_above_moving(const LinkModel& model, const MeasurementGeometry& survey) {
  double top = -1e300, next = 1e300;
  const auto each = [&](const auto& use) {
    for (const auto& ends : model.ends())
      for (const End& end : ends) use(end);
  };
  each([&](const End& end) {
    if (survey.moves[static_cast<std::size_t>(end.radio)]) top = std::max(top, end.z);
  });
  each([&](const End& end) { next = end.z > top ? std::min(next, end.z) : next; });
  return top < -1e299 || next > 1e299 ? survey.height.high : (top + next) / 2;
}

// A heading past one half of a turn begins anew at the other.
double turned(double yaw, double from) { return std::remainder(yaw - from, 2 * M_PI); }

struct Trail {
  Span east, north, yaw;                      // yaw from the first one
  std::array<double, 2> readings = {};        // that it sends, that it receives
  std::vector<std::array<double, 2>> places;  // at least 0.2 m from one to the next
  std::vector<double> headings;               // at least 0.2 rad

  // A radio set up at a few places counts as stationary.
  bool moves() const {
    return east.length() + north.length() > thresholds::moving_extent && places.size() > thresholds::most_set_ups;
  }
  bool does_both() const {
    return std::min(readings[0], readings[1]) > thresholds::both_ends_share * (readings[0] + readings[1]);
  }
  bool turns() const {
    return yaw.length() > thresholds::turning_range && (moves() || headings.size() > thresholds::most_set_ups);
  }
};

// A step of more than 2 m is no driven path, nor is one that is as long for its area.
void follow(Trail& trail, const End& end, MeasurementGeometry& survey) {
  const bool first = trail.places.empty();
  widen(trail.east, end.x, first);
  widen(trail.north, end.y, first);
  widen(trail.yaw, first ? 0 : turned(end.yaw, trail.headings.front()), first);
  if (first || std::abs(turned(end.yaw, trail.headings.back())) > thresholds::least_turn)
    trail.headings.push_back(end.yaw);
  if (!first) {
    const auto [x, y] = trail.places.back();
    const double moved = std::hypot(end.x - x, end.y - y);
    if (moved < thresholds::least_step) return;
    if (moved < thresholds::longest_step * survey.scale) survey.ways.push_back({x, y, end.x, end.y});
  }
  trail.places.push_back({end.x, end.y});
}

std::vector<std::size_t> by_time(const Dataset& data) {
  std::vector<std::size_t> order(data.rows());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  if (!data.t.empty())
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return data.t[a] < data.t[b]; });
  return order;
}

// From the first tenth to all but the last hundredth of the levels.
Span middle_of(std::vector<double> levels) {
  std::erase_if(levels, [](double level) { return std::isnan(level); });
  if (levels.empty()) return {};
  std::sort(levels.begin(), levels.end());
  const auto quantile = [&](double share) {
    return levels[static_cast<std::size_t>(share * static_cast<double>(levels.size() - 1))];
  };
  return {quantile(0.1), quantile(0.99)};
}

// Interval between samples: half of the run, without its longest pauses, passes in gaps of at least this length. A
// schedule of snapshots an hour apart has an hour, whatever the order of readings within.
double sampling_interval(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  std::vector<double> gaps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) gaps.push_back(times[i] - times[i - 1]);
  }
  if (gaps.size() <= thresholds::longest_pauses) return 0;
  std::sort(gaps.begin(), gaps.end());
  gaps.resize(gaps.size() - thresholds::longest_pauses);
  const double all = std::accumulate(gaps.begin(), gaps.end(), 0.0);
  double passed = 0;
  for (const double gap : gaps) {
    passed += gap;
    if (passed >= all / 2) return gap;
  }
  return gaps.back();
}

}  // namespace

std::vector<OrientedRectangle> MeasurementGeometry::halls() const {
  std::vector<OrientedRectangle> result = rooms;
  std::erase_if(result, [&](const OrientedRectangle& room) {
    return std::min(room.length, room.width) <= thresholds::widest_room * scale;
  });
  return result;
}

// From the area over which radios move, or else over which they stand: a far gateway makes no yard larger.
double scale_of(const LinkModel& model) {
  struct Area {
    Span east, north;
    bool is_empty = true;

    void widen_to(double x, double y) {
      widen(east, x, is_empty);
      widen(north, y, is_empty);
      is_empty = false;
    }
  };
  std::map<int, Area> of_radio;
  for (const auto& ends : model.ends()) {
    for (const End& end : ends) of_radio[end.radio].widen_to(end.x, end.y);
  }
  Area all, moving;
  for (const auto& [radio, area] : of_radio) {
    const bool moves = area.east.length() + area.north.length() > thresholds::moving_extent;
    for (const double x : {area.east.low, area.east.high}) {
      for (const double y : {area.north.low, area.north.high}) {
        all.widen_to(x, y);
        if (moves) moving.widen_to(x, y);
      }
    }
  }
  const Area& area = moving.is_empty ? all : moving;
  return std::max(1.0, std::sqrt(area.east.length() * area.north.length()) / thresholds::extent_of_a_building);
}

MeasurementGeometry measurement_geometry(const LinkModel& model, const Dataset& data) {
  MeasurementGeometry survey;
  survey.has_time = !data.t.empty();
  survey.sampling = sampling_interval(data.t);
  survey.level = middle_of(data.rssi);
  survey.has_yaw = !data.rx_yaw.empty() || !data.tx_yaw.empty();
  survey.has_places = data.has_places();
  for (const Covariate& c : data.covariates) {
    const bool whole = std::none_of(c.values.begin(), c.values.end(), [](double v) { return std::isnan(v); });
    if (c.name.rfind("walls_", 0) == 0 && whole && !c.values.empty())
      survey.counted.insert(c.name.substr(6, c.name.find('[') - 6));
  }
  survey.plan_angle = direction_of_walls(model);
  survey.strips = strips_of(model);
  std::map<int, Trail> trails;
  std::vector<double> distances, times;
  Span heading;  // of the receiving ends, from the first of them
  double first_heading = 0;
  bool first = true;
  for (const auto& ends : model.ends()) {
    for (const End& end : ends) {
      widen(survey.east, end.x, first);
      widen(survey.north, end.y, first);
      widen(survey.height, end.z, first);
      first = false;
    }
  }
  survey.scale = scale_of(model);
  for (const std::size_t row : by_time(data)) {
    const auto& ends = model.ends()[row];
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const End& end = ends[k];
      follow(trails[end.radio], end, survey);
      ++trails[end.radio].readings[k];
      if (k == 1 && distances.empty()) first_heading = end.yaw;
      if (k == 1) widen(heading, turned(end.yaw, first_heading), distances.empty());
    }
    if (survey.has_time && !data.is_wild(row)) times.push_back(data.t[row]);
    distances.push_back(std::hypot(std::hypot(ends[0].x - ends[1].x, ends[0].y - ends[1].y), ends[0].z - ends[1].z));
  }
  survey.receivers_turn = !data.rx_yaw.empty() && heading.length() > thresholds::turning_range;
  survey.time = RecordedTime(std::move(times));
  std::sort(survey.ways.begin(), survey.ways.end());
  survey.has_height = survey.height.length() > thresholds::least_heights;
  std::sort(distances.begin(), distances.end());
  const auto quantile = [&](double share) {
    return distances.at(static_cast<std::size_t>(share * static_cast<double>(distances.size() - 1)));
  };
  survey.distance = {std::max(quantile(0.1), 0.5), quantile(0.85)};
  for (const auto& [radio, trail] : trails) {
    survey.turns.resize(static_cast<std::size_t>(radio) + 1, false);
    survey.moves.resize(static_cast<std::size_t>(radio) + 1, false);
    survey.both_ends.resize(static_cast<std::size_t>(radio) + 1, false);
    survey.both_ends[static_cast<std::size_t>(radio)] = trail.does_both();
    survey.turns[static_cast<std::size_t>(radio)] = trail.turns();
    survey.moves[static_cast<std::size_t>(radio)] = trail.moves();
    if (!trail.moves()) survey.standing.insert(survey.standing.end(), trail.places.begin(), trail.places.end());
  }
  survey.rooms = rooms_visited(model, survey);
  survey.above_moving = height_above_moving(model, survey);
  return survey;
}

}  // namespace muster::diagnosis
