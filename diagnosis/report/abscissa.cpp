#include "diagnosis/report/abscissa.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

namespace muster::report {
namespace {

using diagnosis::RowSummary;
using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

VectorXd none(const RowSummary& rows) { return VectorXd::Constant(static_cast<Index>(rows.tx.size()), std::nan("")); }

std::optional<double> value_of(const CauseEstimate& c, const std::string& name) {
  for (const CauseValue& v : c.values) {
    if (v.name == name) return v.value;
  }
  return {};
}

std::string row_name(const CauseEstimate& c, const std::string& set) {
  return c.label.rfind(set + '/', 0) == 0 ? c.label.substr(set.size() + 1) : "";
}

// Distance along the wall's line, from its first end, of the crossing with the straight line between the radios.
std::optional<Abscissa> along_wall(const RowSummary& rows, const CauseEstimate& c) {
  const auto x0 = value_of(c, "x0"), y0 = value_of(c, "y0"), x1 = value_of(c, "x1"), y1 = value_of(c, "y1");
  if (!x0 || !y0 || !x1 || !y1) return {};
  const Vector2d from(*x0, *y0), way = Vector2d(*x1, *y1) - from;
  const double length = way.norm();
  if (length == 0) return {};
  const Vector2d along = way / length, across(-along.y(), along.x());
  Abscissa out{"crossed at, from the first end", "m", none(rows)};
  double concerned = 0, agree = 0;
  for (Index i = 0; i < out.values.size(); ++i) {
    const Vector2d a = rows.tx_at.col(i).head<2>() - from, b = rows.rx_at.col(i).head<2>() - from;
    const double ha = a.dot(across), hb = b.dot(across);
    if (ha * hb < 0) out.values[i] = (a + ha / (ha - hb) * (b - a)).dot(along);
    const bool inside = out.values[i] >= -0.5 && out.values[i] <= length + 0.5;
    // Rows farther off than the wall's length are left out.
    if (!(out.values[i] > -std::max(length, 2.0) && out.values[i] < length + std::max(length, 2.0)))
      out.values[i] = std::nan("");
    concerned += c.effect[i] != 0;
    agree += c.effect[i] != 0 && inside;
  }
  if (agree < 0.8 * concerned) return {};  // a corridor, or another shape
  return out;
}

double distance_to_way(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d way = b - a;
  const double length2 = way.squaredNorm();
  const double at = length2 > 0 ? std::clamp((p - a).dot(way) / length2, 0.0, 1.0) : 0.0;
  return (a + at * way - p).norm();
}

std::optional<Abscissa> beside_point(const RowSummary& rows, const CauseEstimate& c) {
  const auto x = value_of(c, "x"), y = value_of(c, "y");
  if (!x || !y) return {};
  Abscissa out{"straight way of the link passes at", "m", none(rows)};
  double far = 0;
  for (Index i = 0; i < out.values.size(); ++i) {
    out.values[i] = distance_to_way({*x, *y}, rows.tx_at.col(i).head<2>(), rows.rx_at.col(i).head<2>());
    if (c.effect[i] != 0) far = std::max(far, out.values[i]);
  }
  // Shows a few radii.
  const double most = std::max(3 * far, 2.0);
  out.values = (out.values.array() <= most).select(out.values, none(rows));
  return out;
}

std::optional<Abscissa> through_wall(const RowSummary& rows, const CauseEstimate& c) {
  const std::string wall = row_name(c, "wall");
  if (wall.empty()) return {};
  Abscissa out{"", "", none(rows), false, {"not through " + wall, "through " + wall}};
  for (Index i = 0; i < out.values.size(); ++i) out.values[i] = c.effect[i] != 0;
  return out;
}

// Bearing from the cause's radio to the other one; a category if the effect is one constant.
std::optional<Abscissa> about_radio(const RowSummary& rows, const CauseEstimate& c) {
  const std::string name = row_name(c, "radio");
  const auto at = std::find(rows.radios.begin(), rows.radios.end(), name);
  if (name.empty() || at == rows.radios.end()) return {};
  const int radio = static_cast<int>(at - rows.radios.begin());
  std::set<long> different;
  for (Index i = 0; i < c.effect.size(); ++i)
    if (c.effect[i] != 0 && different.size() < 4) different.insert(std::lround(c.effect[i] * 1000));
  if (different.size() < 4) {
    Abscissa out{"", "", none(rows), false, {"other links", "links with " + name}};
    for (Index i = 0; i < out.values.size(); ++i) out.values[i] = c.effect[i] != 0;
    return out;
  }
  Abscissa out{"direction from " + name, "deg", none(rows)};
  for (Index i = 0; i < out.values.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (rows.tx[k] != radio && rows.rx[k] != radio) continue;
    const Eigen::Vector3d way = (rows.tx[k] == radio ? 1.0 : -1.0) * (rows.rx_at.col(i) - rows.tx_at.col(i));
    out.values[i] = in_degrees(std::atan2(way.y(), way.x()));
  }
  return out;
}

}  // namespace

double in_degrees(double angle) { return std::remainder(angle, 2 * M_PI) * 180 / M_PI; }

Abscissa abscissa_of(const RowSummary& rows, const CauseEstimate& c) {
  const std::string own = c.covariates.empty() ? "" : c.covariates.front();
  if (own == "time" && rows.t.size()) return {"time", "s", rows.t};
  if (own == "bearing" && rows.bearing.size())
    return {"bearing of the other radio", "deg", rows.bearing.unaryExpr(&in_degrees)};
  if (own == "logd")
    return {"distance", "m", (rows.tx_at - rows.rx_at).colwise().norm().transpose().cwiseMax(0.1), true};
  if (!rows.places_known) return {"effect as fitted", "dB", c.effect, false, {}, true};
  for (const auto& sought : {along_wall, beside_point, through_wall, about_radio}) {
    if (auto out = sought(rows, c)) return *out;
  }
  return {"effect as fitted", "dB", c.effect, false, {}, true};
}

}  // namespace muster::report
