#include "diagnosis/planning/measurement_plans.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "diagnosis/inference/thresholds.hpp"
#include "diagnosis/planning/standing_radios.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr Index most_rows = 400;
constexpr int most_readings = 6;      // of one row
constexpr double millisecond = 1e-3;  // s, between readings of one link at least

// Builds plans. Repeats each planned place `repeats` times, so that its noise is that of an average row.
struct Maker {
  const RowSummary& seen;
  std::vector<Index> rows;            // of the data, spread over all
  std::vector<StandingRadio> radios;  // stationary
  int repeats;
  bool timed;
  double begin = 0, end = 0;  // s

  explicit Maker(const RowSummary& s) : seen(s), radios(standing_radios(s)), timed(s.t.size() > 0) {
    const auto n = static_cast<Index>(s.tx.size());
    const Index every = std::max<Index>(1, (n + most_rows - 1) / most_rows);
    for (Index i = 0; i < n; i += every) rows.push_back(i);
    repeats = std::clamp(static_cast<int>(std::lround(s.count.mean())), 1, most_readings);
    if (timed) begin = s.t.minCoeff(), end = s.t.maxCoeff();
  }

  double span() const { return end - begin; }
  // Time of row i if its path is driven once more, a minute later.
  double once_more(Index i) const { return timed ? seen.t[i] + span() + 60 : 0; }

  void add(LinkReadings& out, const RowEnd& tx, const RowEnd& rx, double t) const {
    const Index first = out.size();
    out.tx_at.conservativeResize(3, first + repeats);
    out.rx_at.conservativeResize(3, first + repeats);
    for (int k = 0; k < repeats; ++k) {
      out.tx.push_back(tx.radio);
      out.rx.push_back(rx.radio);
      out.tx_at.col(first + k) = tx.at;
      out.rx_at.col(first + k) = rx.at;
      if (timed) out.t.push_back(t + millisecond * k);
      if (seen.tx_yaw.size() > 0) out.tx_yaw.push_back(tx.yaw);
      if (seen.rx_yaw.size() > 0) out.rx_yaw.push_back(rx.yaw);
    }
  }

  // The end of row i that moves, the receiver if both do.
  std::optional<RowEnd> roaming_end(Index i) const {
    for (const bool sends : {false, true}) {
      const RowEnd e = end_of(seen, i, sends);
      if (!is_standing(radios, e.radio, sends)) return e;
    }
    return {};
  }

  // `turned`: change of heading of the moving ends, rad.
  void add_row(LinkReadings& out, Index i, double t, double turned) const {
    RowEnd tx = end_of(seen, i, true), rx = end_of(seen, i, false);
    if (!is_standing(radios, tx.radio, true)) tx.yaw += turned;
    if (!is_standing(radios, rx.radio, false)) rx.yaw += turned;
    add(out, tx, rx, t);
  }

  void add_link(LinkReadings& out, const StandingRadio& s, const RowEnd& other, double t) const {
    add(out, s.sends ? s.end : other, s.sends ? other : s.end, t);
  }
};

PlannedReadings in_reverse(const Maker& make) {
  PlannedReadings out{"drive the same ways again right away, in reverse order", {}};
  for (const Index i : make.rows) make.add_row(out.readings, i, 2 * make.end - make.seen.t[i] + 5, M_PI);
  return out;
}

PlannedReadings later(const Maker& make) {
  const double pause = 0.6180339887498949 * make.span();  // s: golden section, against aliasing
  PlannedReadings out{fmt::format("drive the same ways again in the same order, after a pause of {:.0f} s", pause), {}};
  for (const Index i : make.rows) make.add_row(out.readings, i, make.seen.t[i] + make.span() + pause, 0);
  return out;
}

// All links in both directions; no plan if any was already read in both.
PlannedReadings both_ways(const Maker& make) {
  std::set<std::pair<int, int>> known;
  for (std::size_t k = 0; k < make.seen.tx.size(); ++k) known.insert({make.seen.tx[k], make.seen.rx[k]});
  if (std::any_of(known.begin(), known.end(), [&](const auto& p) { return known.count({p.second, p.first}) > 0; }))
    return {};
  PlannedReadings out{"drive the same ways again and let both ends of every link send and hear", {}};
  for (const Index i : make.rows) {
    const double t = make.once_more(i);
    const RowEnd tx = end_of(make.seen, i, true), rx = end_of(make.seen, i, false);
    make.add(out.readings, tx, rx, t);
    make.add(out.readings, rx, tx, t);
  }
  return out;
}

PlannedReadings turning(const Maker& make) {
  constexpr int places = 24, headings = 12;
  PlannedReadings out{fmt::format("turn once around on the spot, at {} places spread along the way", places), {}};
  double t = make.end + 5;
  for (int p = 0; p < places; ++p) {
    std::optional<RowEnd> r = make.roaming_end(make.rows[make.rows.size() * static_cast<std::size_t>(p) / places]);
    for (int h = 0; r && r->faces && h < headings; ++h, t += 2) {
      r->yaw = 2 * M_PI * h / headings;
      for (const StandingRadio& s : make.radios) make.add_link(out.readings, s, *r, t);
    }
  }
  return out;
}

bool is_about(const CauseEstimate& c, const std::string& radio) { return c.row == radio; }

bool may_be_about(const CauseEstimate& c, const std::string& radio) {
  return std::any_of(c.alternatives.begin(), c.alternatives.end(), [&](const inference::Alternative& r) {
    const std::string rows = ' ' + r.label + ' ';
    return r.separability < inference::thresholds::decided && rows.find(" radio/" + radio + ' ') != std::string::npos;
  });
}

// The stationary radio of a finding, else of an undecided alternative, else the first one. Null if there is none.
const StandingRadio* station(const Maker& make, const std::vector<CauseEstimate>& about) {
  for (const auto& is : {is_about, may_be_about}) {
    for (const StandingRadio& s : make.radios) {
      const std::string& name = make.seen.radios[static_cast<std::size_t>(s.end.radio)];
      if (std::any_of(about.begin(), about.end(), [&](const CauseEstimate& c) { return is(c, name); })) return &s;
    }
  }
  return make.radios.empty() ? nullptr : &make.radios.front();
}

// Repeats all paths with one stationary radio changed, as sender and as receiver.
void add_ways(LinkReadings& out, const Maker& make, int radio, const std::function<RowEnd(RowEnd)>& otherwise) {
  for (const Index i : make.rows) {
    const std::optional<RowEnd> r = make.roaming_end(i);
    if (!r) continue;
    for (const StandingRadio& s : make.radios) {
      if (s.end.radio != radio) continue;
      const RowEnd there = otherwise(s.end);
      if ((r->at - there.at).norm() >= 0.5) make.add_link(out, {there, s.sends}, *r, make.once_more(i));
    }
  }
}

PlannedReadings turned_station(const Maker& make, int radio) {
  PlannedReadings out{fmt::format("turn {} by 90 degrees where it stands and drive the same ways again",
                                  make.seen.radios[static_cast<std::size_t>(radio)]),
                      {}};
  add_ways(out.readings, make, radio, [](RowEnd e) {
    e.yaw += M_PI / 2;
    return e;
  });
  return out;
}

// Moves the radio to the visited place farthest from all stationary radios.
PlannedReadings moved_station(const Maker& make, int radio) {
  Eigen::Vector2d to(0, 0);
  double farthest = 0;
  for (const Index i : make.rows) {
    const std::optional<RowEnd> r = make.roaming_end(i);
    if (!r) continue;
    double nearest = 1e300;
    for (const StandingRadio& s : make.radios) nearest = std::min(nearest, (s.end.at - r->at).head<2>().norm());
    if (nearest > farthest) farthest = nearest, to = r->at.head<2>();
  }
  if (farthest < 2) return {};
  PlannedReadings out{fmt::format("move {} to ({:.1f}, {:.1f}) and drive the same ways again",
                                  make.seen.radios[static_cast<std::size_t>(radio)], to.x(), to.y()),
                      {}};
  add_ways(out.readings, make, radio, [&](RowEnd e) {
    e.at.head<2>() = to;
    return e;
  });
  return out;
}

double value_of(const CauseEstimate& c, const std::string& name) {
  for (const CauseValue& v : c.values) {
    if (v.name == name) return v.value;
  }
  return std::nan("");
}

// Place of a finding, or the middle of the driven paths.
Vector3d middle_of(const RowSummary& seen, const std::vector<CauseEstimate>& about) {
  for (const CauseEstimate& c : about) {
    const double x = value_of(c, "x"), y = value_of(c, "y");
    if (!std::isnan(x + y)) return {x, y, 0};
    Vector3d middle((value_of(c, "x0") + value_of(c, "x1")) / 2, (value_of(c, "y0") + value_of(c, "y1")) / 2, 0);
    if (!middle.hasNaN()) return middle;
  }
  return (seen.tx_at.rowwise().mean() + seen.rx_at.rowwise().mean()) / 2;
}

// Grid points in the bounding box of the walls, at least 1.5 m from all visited places, nearest to `to` first.
std::vector<Vector3d> not_visited(const RowSummary& seen, const Vector3d& to) {
  Eigen::AlignedBox2d box;
  for (const MappedWall& w : seen.walls) {
    box.extend(Eigen::Vector2d(w.x0, w.y0));
    box.extend(Eigen::Vector2d(w.x1, w.y1));
  }
  std::vector<Vector3d> out;
  if (box.isEmpty() || box.volume() > 1e4) return out;
  const Eigen::Vector2d size = box.sizes();
  for (int i = 0; i + 0.5 < size.x(); ++i) {
    for (int j = 0; j + 0.5 < size.y(); ++j) {
      const Vector3d at(box.min().x() + 0.5 + i, box.min().y() + 0.5 + j, 0);
      const auto near = [&](const Eigen::Matrix3Xd& ends) {
        return (ends.topRows<2>().colwise() - at.head<2>()).colwise().squaredNorm().minCoeff() < 1.5 * 1.5;
      };
      if (!near(seen.tx_at) && !near(seen.rx_at)) out.push_back(at);
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [&](const Vector3d& a, const Vector3d& b) { return (a - to).norm() < (b - to).norm(); });
  if (out.size() > 40) out.resize(40);
  return out;
}

PlannedReadings elsewhere(const Maker& make, const std::vector<CauseEstimate>& about) {
  const auto places = not_visited(make.seen, middle_of(make.seen, about));
  std::optional<RowEnd> r = make.roaming_end(make.rows.front());
  if (places.size() < 8 || !r) return {};
  PlannedReadings out{fmt::format("drive where nothing was measured yet, about ({:.1f}, {:.1f}), if it can be reached",
                                  places.front().x(), places.front().y()),
                      {}};
  double t = make.end + 5;
  for (std::size_t p = 0; p < places.size(); ++p, t += 2) {
    r->at.head<2>() = places[p].head<2>();
    r->yaw = 0.5 * M_PI * static_cast<double>(p);
    for (const StandingRadio& s : make.radios) make.add_link(out.readings, s, *r, t);
  }
  return out;
}

// Spaces readings of a link by at least 1 ms, the resolution of written times: rows may have the same middle.
void space_out(LinkReadings& r) {
  std::map<std::pair<int, int>, std::vector<std::size_t>> of_link;
  for (std::size_t k = 0; k < r.t.size(); ++k) of_link[{r.tx[k], r.rx[k]}].push_back(k);
  for (auto& [link, readings] : of_link) {
    std::stable_sort(readings.begin(), readings.end(), [&](std::size_t a, std::size_t b) { return r.t[a] < r.t[b]; });
    long long last = std::numeric_limits<long long>::min();
    for (const std::size_t k : readings) {
      last = std::max(std::llround(r.t[k] / millisecond), last + 1);
      r.t[k] = static_cast<double>(last) * millisecond;
    }
  }
}

}  // namespace

std::vector<PlannedReadings> planned_readings(const RowSummary& seen, const std::vector<CauseEstimate>& about) {
  if (!seen.places_known) return {};
  const Maker make(seen);
  std::vector<PlannedReadings> out;
  if (make.timed && make.span() > 0) out.insert(out.end(), {in_reverse(make), later(make)});
  out.push_back(both_ways(make));
  out.push_back(turning(make));
  if (const StandingRadio* const s = station(make, about)) {
    if (s->end.faces) out.push_back(turned_station(make, s->end.radio));
    out.push_back(moved_station(make, s->end.radio));
  }
  out.push_back(elsewhere(make, about));
  std::erase_if(out, [](const PlannedReadings& p) { return p.readings.size() == 0; });
  for (PlannedReadings& p : out) space_out(p.readings);
  return out;
}

}  // namespace muster::diagnosis
