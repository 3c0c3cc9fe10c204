#include "diagnosis/survey.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <muster/tables.hpp>

#include "diagnosis/features.hpp"

namespace muster::diagnosis {
namespace {

constexpr double quarter_turn = 1.5707963267948966;

void widen(Span& span, double value, bool first) {
  span.low = first ? value : std::min(span.low, value);
  span.high = first ? value : std::max(span.high, value);
}

// The direction that walls have in common but for quarter turns, by the mean of fourfold angles, long walls first.
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
  const double angle = std::atan2(s, c) / 4;
  return angle < 0 ? angle + quarter_turn : angle;
}

struct Trail {
  Span east, north, yaw;
  double x = 0, y = 0;
  bool begun = false;
};

// A piece of way ends 0.2 m further on; a leap of more than 2 m is no way that was driven.
void follow(Trail& trail, const End& end, Survey& survey) {
  const bool first = !trail.begun;
  widen(trail.east, end.x, first);
  widen(trail.north, end.y, first);
  widen(trail.yaw, end.yaw, first);
  trail.begun = true;
  const double moved = first ? 0 : std::hypot(end.x - trail.x, end.y - trail.y);
  if (!first && moved < 0.2) return;
  if (!first && moved < 2) survey.ways.push_back({trail.x, trail.y, end.x, end.y});
  trail.x = end.x;
  trail.y = end.y;
}

std::vector<std::size_t> by_time(const Dataset& data) {
  std::vector<std::size_t> order(data.rows());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  if (!data.t.empty())
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return data.t[a] < data.t[b]; });
  return order;
}

}  // namespace

Survey survey_of(const LinkModel& model, const Dataset& data) {
  Survey survey;
  survey.has_time = !data.t.empty();
  survey.has_yaw = !data.rx_yaw.empty();
  survey.has_places = data.has_places();
  for (const Covariate& c : data.covariates) {
    const bool whole = std::none_of(c.values.begin(), c.values.end(), [](double v) { return std::isnan(v); });
    if (c.name.rfind("walls_", 0) == 0 && whole && !c.values.empty())
      survey.counted.insert(c.name.substr(6, c.name.find('[') - 6));
  }
  survey.plan_angle = direction_of_walls(model);
  std::map<int, Trail> trails;
  std::vector<double> distances;
  bool first = true;
  for (const std::size_t row : by_time(data)) {
    const auto& ends = model.ends()[row];
    for (const End& end : ends) {
      follow(trails[end.radio], end, survey);
      widen(survey.east, end.x, first);
      widen(survey.north, end.y, first);
      widen(survey.height, end.z, first);
      first = false;
    }
    if (survey.has_time) widen(survey.time, data.t[row], distances.empty());
    distances.push_back(std::hypot(std::hypot(ends[0].x - ends[1].x, ends[0].y - ends[1].y), ends[0].z - ends[1].z));
  }
  survey.has_height = survey.height.length() > 0.3;
  std::sort(distances.begin(), distances.end());
  const auto quantile = [&](double share) {
    return distances.at(static_cast<std::size_t>(share * static_cast<double>(distances.size() - 1)));
  };
  survey.distance = {std::max(quantile(0.1), 0.5), quantile(0.85)};
  for (const auto& [radio, trail] : trails) {
    survey.turns.resize(static_cast<std::size_t>(radio) + 1, false);
    survey.moves.resize(static_cast<std::size_t>(radio) + 1, false);
    survey.turns[static_cast<std::size_t>(radio)] = trail.yaw.length() > 0.2;
    survey.moves[static_cast<std::size_t>(radio)] = trail.east.length() + trail.north.length() > 0.5;
  }
  return survey;
}

}  // namespace muster::diagnosis
