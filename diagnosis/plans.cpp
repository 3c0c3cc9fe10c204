#include "diagnosis/plans.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr Index most_rows = 200;
constexpr int most_readings = 6;  // of one row

// A place on a link, taken so many times that the noise counts it as a row of the data counts.
struct Maker {
  const SeenRows& seen;
  std::vector<Index> rows;  // of the data, spread over all
  int repeats;
  bool timed, headed;
  double begin = 0, end = 0;  // s

  explicit Maker(const SeenRows& s) : seen(s), timed(s.t.size() > 0), headed(s.yaw.size() > 0) {
    const auto n = static_cast<Index>(s.tx.size());
    const Index every = std::max<Index>(1, (n + most_rows - 1) / most_rows);
    for (Index i = 0; i < n; i += every) rows.push_back(i);
    repeats = std::clamp(static_cast<int>(std::lround(s.count.mean())), 1, most_readings);
    if (timed) begin = s.t.minCoeff(), end = s.t.maxCoeff();
  }

  double span() const { return end - begin; }

  void add(noise::Readings& out, int tx, int rx, const Vector3d& tx_at, const Vector3d& rx_at, double t,
           double yaw) const {
    const Index first = out.size();
    out.tx_at.conservativeResize(3, first + repeats);
    out.rx_at.conservativeResize(3, first + repeats);
    for (int k = 0; k < repeats; ++k) {
      out.tx.push_back(tx);
      out.rx.push_back(rx);
      out.tx_at.col(first + k) = tx_at;
      out.rx_at.col(first + k) = rx_at;
      if (timed) out.t.push_back(t + 1e-3 * k);
      if (headed) out.rx_yaw.push_back(yaw);
    }
  }

  void add_row(noise::Readings& out, Index i, double t, double turned) const {
    const auto k = static_cast<std::size_t>(i);
    add(out, seen.tx[k], seen.rx[k], seen.tx_at.col(i), seen.rx_at.col(i), t, headed ? seen.yaw[i] + turned : 0);
  }
};

struct Standing {
  int radio;
  bool sends;
  Vector3d at;
};

// Radios that do not move, as they send or hear.
std::vector<Standing> standing_radios(const SeenRows& seen) {
  std::map<std::pair<int, bool>, std::pair<Standing, bool>> known;
  for (std::size_t k = 0; k < seen.tx.size(); ++k) {
    for (const bool sends : {true, false}) {
      const Vector3d at = (sends ? seen.tx_at : seen.rx_at).col(static_cast<Index>(k));
      const int radio = sends ? seen.tx[k] : seen.rx[k];
      auto& [first, stays] = known.try_emplace({radio, sends}, Standing{radio, sends, at}, true).first->second;
      stays = stays && (first.at - at).norm() < 0.2;
    }
  }
  std::vector<Standing> out;
  for (const auto& [key, value] : known) {
    if (value.second) out.push_back(value.first);
  }
  return out;
}

// The end of row i that is not a standing radio's.
struct Roaming {
  int radio;
  Vector3d at;
};
Roaming roaming_end(const SeenRows& seen, Index i, const Standing& other) {
  const auto k = static_cast<std::size_t>(i);
  return other.sends ? Roaming{seen.rx[k], seen.rx_at.col(i)} : Roaming{seen.tx[k], seen.tx_at.col(i)};
}

void add_link(const Maker& make, noise::Readings& out, const Standing& s, const Roaming& r, double t, double yaw) {
  if (s.sends)
    make.add(out, s.radio, r.radio, s.at, r.at, t, yaw);
  else
    make.add(out, r.radio, s.radio, r.at, s.at, t, yaw);
}

PlannedReadings in_reverse(const Maker& make) {
  PlannedReadings out{"drive the same ways again right away, in reverse order", {}};
  for (const Index i : make.rows) make.add_row(out.readings, i, 2 * make.end - make.seen.t[i] + 5, M_PI);
  return out;
}

PlannedReadings later(const Maker& make) {
  const double pause = 0.6180339887498949 * make.span();  // s: no simple share of the run, for what swings
  PlannedReadings out{fmt::format("drive the same ways again in the same order, after a pause of {:.0f} s", pause), {}};
  for (const Index i : make.rows) make.add_row(out.readings, i, make.seen.t[i] + make.span() + pause, 0);
  return out;
}

PlannedReadings turning(const Maker& make, const std::vector<Standing>& radios) {
  constexpr int places = 12, headings = 12;
  PlannedReadings out{fmt::format("turn once around on the spot, at {} places spread along the way", places), {}};
  double t = make.end + 5;
  for (int p = 0; p < places; ++p) {
    const Index row = make.rows[make.rows.size() * static_cast<std::size_t>(p) / places];
    for (int h = 0; h < headings; ++h, t += 2) {
      for (const Standing& s : radios) {
        if (s.sends) add_link(make, out.readings, s, roaming_end(make.seen, row, s), t, 2 * M_PI * h / headings);
      }
    }
  }
  return out;
}

// To the visited place that lies farthest from all standing radios.
PlannedReadings moved(const Maker& make, const std::vector<Standing>& radios) {
  const Standing* mover = nullptr;
  for (const Standing& s : radios) {
    if (s.sends && !mover) mover = &s;
  }
  if (!mover) return {};
  Vector3d to = mover->at;
  double farthest = 0;
  for (const Index i : make.rows) {
    const Vector3d at = roaming_end(make.seen, i, *mover).at;
    double nearest = 1e300;
    for (const Standing& s : radios) nearest = std::min(nearest, (s.at - at).head<2>().norm());
    if (nearest > farthest) farthest = nearest, to.head<2>() = at.head<2>();
  }
  if (farthest < 2) return {};
  PlannedReadings out{fmt::format("move {} to ({:.1f}, {:.1f}) and drive the same ways again",
                                  make.seen.radios[static_cast<std::size_t>(mover->radio)], to.x(), to.y()),
                      {}};
  Standing there = *mover;
  there.at = to;
  for (const Index i : make.rows) {
    const Roaming r = roaming_end(make.seen, i, *mover);
    if (r.radio == mover->radio || (r.at - to).norm() < 0.5) continue;
    add_link(make, out.readings, there, r, make.timed ? make.seen.t[i] + make.span() + 60 : 0,
             make.headed ? make.seen.yaw[i] : 0);
  }
  return out;
}

double value_of(const FoundCause& c, const std::string& name) {
  for (const CauseValue& v : c.values) {
    if (v.name == name) return v.value;
  }
  return std::nan("");
}

// Where something was found, or the middle of what was driven.
Vector3d middle_of(const SeenRows& seen, const std::vector<FoundCause>& about) {
  for (const FoundCause& c : about) {
    const double x = value_of(c, "x"), y = value_of(c, "y");
    if (!std::isnan(x + y)) return {x, y, 0};
    const Vector3d middle((value_of(c, "x0") + value_of(c, "x1")) / 2, (value_of(c, "y0") + value_of(c, "y1")) / 2, 0);
    if (!middle.hasNaN()) return middle;
  }
  return (seen.tx_at.rowwise().mean() + seen.rx_at.rowwise().mean()) / 2;
}

// Points of a grid inside the walls' box that are 1.5 m and more from all visited places, those near `to` first.
std::vector<Vector3d> not_visited(const SeenRows& seen, const Vector3d& to) {
  Eigen::AlignedBox2d box;
  for (const MappedWall& w : seen.walls) {
    box.extend(Eigen::Vector2d(w.x0, w.y0));
    box.extend(Eigen::Vector2d(w.x1, w.y1));
  }
  std::vector<Vector3d> out;
  if (box.isEmpty() || box.volume() > 1e4) return out;
  for (double x = box.min().x() + 0.5; x < box.max().x(); x += 1) {
    for (double y = box.min().y() + 0.5; y < box.max().y(); y += 1) {
      const Vector3d at(x, y, 0);
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

PlannedReadings elsewhere(const Maker& make, const std::vector<Standing>& radios,
                          const std::vector<FoundCause>& about) {
  const auto places = not_visited(make.seen, middle_of(make.seen, about));
  if (places.size() < 8) return {};
  PlannedReadings out{fmt::format("drive where nothing was measured yet, about ({:.1f}, {:.1f}), if it can be reached",
                                  places.front().x(), places.front().y()),
                      {}};
  double t = make.end + 5;
  for (std::size_t p = 0; p < places.size(); ++p, t += 2) {
    for (const Standing& s : radios) {
      if (!s.sends) continue;
      Roaming r = roaming_end(make.seen, make.rows.front(), s);
      r.at.head<2>() = places[p].head<2>();
      if (r.radio != s.radio) add_link(make, out.readings, s, r, t, 0.5 * M_PI * static_cast<double>(p));
    }
  }
  return out;
}

}  // namespace

std::vector<PlannedReadings> planned_readings(const SeenRows& seen, const std::vector<FoundCause>& about) {
  if (!seen.places_known) return {};
  const Maker make(seen);
  const auto radios = standing_radios(seen);
  std::vector<PlannedReadings> out;
  if (make.timed && make.span() > 0) out.insert(out.end(), {in_reverse(make), later(make)});
  if (make.headed && !radios.empty()) out.push_back(turning(make, radios));
  out.push_back(moved(make, radios));
  out.push_back(elsewhere(make, radios, about));
  std::erase_if(out, [](const PlannedReadings& p) { return p.readings.size() == 0; });
  return out;
}

}  // namespace muster::diagnosis
