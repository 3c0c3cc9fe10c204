#include "diagnosis/radio/links/link_smooths.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/data/recorded_time.hpp"
#include "diagnosis/radio/links/moving_end.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using inference::Candidate;
using noise::Index;

struct Geometry {
  MovingEnds moving;
  Eigen::VectorXd log_distance, from_tx;

  explicit Geometry(const LinkReadings& r) : moving(moving_ends(r)), from_tx(r.size()) {
    const Eigen::Matrix3Xd to_rx = r.rx_at - r.tx_at;
    log_distance = to_rx.colwise().norm().transpose().cwiseMax(0.5).array().log10();
    for (Index i = 0; i < r.size(); ++i) from_tx[i] = std::atan2(to_rx(1, i), to_rx(0, i));
  }
};

std::vector<int> links(const LinkReadings& readings) {
  std::map<std::pair<int, int>, int> number;
  for (std::size_t i = 0; i < readings.tx.size(); ++i) number.try_emplace({readings.tx[i], readings.rx[i]}, 0);
  int next = 0;
  for (auto& [link, k] : number) k = next++;
  std::vector<int> result;
  for (std::size_t i = 0; i < readings.tx.size(); ++i) result.push_back(number.at({readings.tx[i], readings.rx[i]}));
  return result;
}

void add_time(const LinkReadings& readings, const Geometry& geometry, bool places_known, std::vector<Candidate>& out) {
  const auto& t = readings.t;
  if (t.empty()) return;
  Eigen::VectorXd time = Eigen::Map<const Eigen::VectorXd>(t.data(), static_cast<Index>(t.size()));
  if (const RecordedTime recorded(t); recorded.has_pauses())
    time = time.unaryExpr([&](double at) { return recorded.shortened(at); }).eval();
  for (Candidate c : {inference::smooth_of("time", time, 10), inference::chirp("time", time)}) {
    c.role.time_like = true;
    out.push_back(std::move(c));
  }
  out.push_back(inference::smooth_by_level("time_per_tx", readings.tx, inference::cosines(time, 5)));
  if (places_known) out.push_back(inference::product_over("time", time, "position", geometry.moving.place));
}

void add_covariate(const inference::Covariate& c, const Geometry& geometry, bool places_known,
                   std::vector<Candidate>& out) {
  out.push_back(c.angle ? inference::smooth_of_angle(c.name, c.values, (c.functions + 1) / 2)
                        : inference::smooth_of(c.name, c.values, c.functions));
  out.back().role.observed = true;
  if (c.angle) return;
  out.push_back(inference::bend(c.name, c.values));
  if (!c.products) return;
  out.push_back(inference::product_of(c.name, c.values, "logd", geometry.log_distance));
  if (places_known) out.push_back(inference::product_over(c.name, c.values, "position", geometry.moving.place));
}

// Over the directions from one transmitter at a time, of those heard at more places than determine the functions: the
// few links of a radio in a standing network would be fitted one by one.
void add_directions(const LinkReadings& readings, const Geometry& geometry, std::vector<Candidate>& out) {
  constexpr int harmonics = 3;
  std::map<int, std::set<std::pair<long, long>>> places;  // of each transmitter's receivers
  for (std::size_t i = 0; i < readings.tx.size(); ++i) {
    const Eigen::Vector2d at = readings.rx_at.col(static_cast<Index>(i)).head<2>() / thresholds::one_receiver_place;
    places[readings.tx[i]].insert({std::lround(at[0]), std::lround(at[1])});
  }
  Candidate c =
      inference::smooth_by_level("txbearing", readings.tx, inference::harmonics_of(geometry.from_tx, harmonics));
  std::erase_if(c.design.grid, [&](const Eigen::VectorXd& theta) {
    return places.at(static_cast<int>(theta[0])).size() < std::size_t{4} * harmonics;
  });
  if (!c.design.grid.empty()) out.push_back(std::move(c));
}

}  // namespace

std::vector<Candidate> link_smooths(const LinkReadings& readings, const LinkColumns& columns, bool places_known) {
  const Geometry geometry(readings);
  std::vector<Candidate> result;
  result.push_back(inference::smooth_of("logd", geometry.log_distance, 6));
  result.back().role.level_like = true;
  if (geometry.moving.headings_known()) {
    if (places_known) result.push_back(inference::smooth_of_angle("bearing", geometry.moving.bearing, 4));
    result.push_back(inference::smooth_of_angle("heading", geometry.moving.heading, 3));
  }
  if (places_known) {
    add_directions(readings, geometry, result);
    result.push_back(inference::smooth_over("position", geometry.moving.place));
    result.push_back(inference::slope_over("position", geometry.moving.place));
    const bool is_measured = std::any_of(columns.covariates.begin(), columns.covariates.end(),
                                         [](const inference::Covariate& c) { return c.name == "height"; });
    if (geometry.moving.climb > thresholds::least_climb && !is_measured)
      result.push_back(inference::smooth_of("height", geometry.moving.z, 4));
  }
  add_time(readings, geometry, places_known, result);
  result.push_back(inference::factor("link", links(readings)));
  for (const inference::Factor& f : columns.factors) result.push_back(inference::factor(f.name, f.level));
  for (const inference::Covariate& c : columns.covariates) add_covariate(c, geometry, places_known, result);
  return result;
}

}  // namespace muster::diagnosis
