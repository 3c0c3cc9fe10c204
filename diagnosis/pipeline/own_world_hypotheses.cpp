#include "diagnosis/pipeline/own_world_hypotheses.hpp"

#include <algorithm>
#include <set>
#include <sstream>
#include <string_view>

#include "diagnosis/data/median.hpp"
#include "diagnosis/radio/causes/applicability.hpp"
#include "diagnosis/radio/causes/place_grid.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"
#include "diagnosis/radio/thresholds.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

using Words = std::map<std::string, std::string>;

constexpr const char* supposed = "supposed";  // name of the instance

std::vector<const muster_param*> with_flag(const Cause& cause, uint32_t flag) {
  std::vector<const muster_param*> result;
  for (uint32_t k = 0; k < cause.plugin->param_count; ++k) {
    if (cause.plugin->params[k].flags & flag) result.push_back(&cause.plugin->params[k]);
  }
  return result;
}

// The two numbers in metres to be sought: a place on the map, or how far east and north a plan is moved.
struct Sought {
  const muster_param *east = nullptr, *north = nullptr;
  bool is_place = false;
};

std::optional<Sought> sought_by(const Cause& cause) {
  const auto east = with_flag(cause, MUSTER_EAST), north = with_flag(cause, MUSTER_NORTH);
  if (east.size() == 1 && north.size() == 1) return Sought{east[0], north[0], true};
  auto ways = with_flag(cause, MUSTER_FREE);
  std::erase_if(ways, [](const muster_param* p) { return p->kind != MUSTER_REAL || std::string_view(p->unit) != "m"; });
  if (ways.size() != 2) return {};
  return Sought{ways[0], ways[1], false};
}

std::vector<std::string> values_of(const muster_param& p) {
  std::vector<std::string> result;
  if (p.kind == MUSTER_CHOICE) {
    std::istringstream choices(p.text);
    for (std::string word; std::getline(choices, word, '|');) result.push_back(word);
  } else {
    for (double value = p.min; value <= p.max; ++value) result.push_back(print_real(value));
  }
  return result;
}

std::vector<Words> choices_of(const Cause& cause) {
  std::vector<Words> result{{}};
  for (const muster_param* p : with_flag(cause, MUSTER_EACH)) {
    std::vector<Words> longer;
    for (const Words& begun : result) {
      for (const std::string& value : values_of(*p)) {
        longer.push_back(begun);
        longer.back()[p->name] = value;
      }
    }
    result = std::move(longer);
  }
  return result;
}

class Extent {
 public:
  void add(double x, double y) {
    x_.low = std::min(x_.low, x);
    x_.high = std::max(x_.high, x);
    y_.low = std::min(y_.low, y);
    y_.high = std::max(y_.high, y);
    empty_ = false;
  }
  bool empty() const { return empty_; }
  InPlan middle() const { return {(x_.low + x_.high) / 2, (y_.low + y_.high) / 2}; }

 private:
  Span x_{1e300, -1e300}, y_{1e300, -1e300};
  bool empty_ = true;
};

// About which a plan may be turned: the origin, and the middles of the walls, of the standing radios, of all ways.
std::vector<InPlan> middles_of(const MeasurementGeometry& geometry, const std::vector<MappedWall>& walls) {
  Extent map, standing, ways;
  for (const MappedWall& wall : walls) {
    map.add(wall.x0, wall.y0);
    map.add(wall.x1, wall.y1);
  }
  for (const auto& [x, y] : geometry.standing) standing.add(x, y);
  for (const auto& way : geometry.ways) {
    ways.add(way[0], way[1]);
    ways.add(way[2], way[3]);
  }
  std::vector<InPlan> result{{0, 0}};
  for (const Extent& each : {map, standing, ways}) {
    if (!each.empty()) result.push_back(each.middle());
  }
  return result;
}

// How far the radios that the search puts elsewhere lie from there, as one move: a plan that is moved puts each in
// another place, all by the same way. None of fewer than two.
std::optional<InPlan> common_move(const LinkModel& model, const std::vector<CauseEstimate>& found) {
  std::vector<double> east, north;
  for (const CauseEstimate& c : found) {
    const auto listed = c.row.empty() ? std::nullopt : place_of_radio(model, c.row);
    if (!listed) continue;
    std::vector<double> place;
    for (const CauseValue& v : c.values) {
      if (v.unit == "m") place.push_back(v.value);
    }
    if (place.size() != 2) continue;
    east.push_back(listed->x() - place[0]);
    north.push_back(listed->y() - place[1]);
  }
  if (east.size() < 2) return {};
  return InPlan{median(east), median(north)};
}

// From which the move of a plan is sought: in all directions, and as far as radios have been found to be off.
std::vector<InPlan> first_moves(const LinkModel& model, const std::vector<CauseEstimate>& found, double scale) {
  std::vector<InPlan> result;
  if (const auto move = common_move(model, found)) {
    result.push_back(*move);
    result.push_back({-(*move)[0], -(*move)[1]});
  }
  for (const double far : {thresholds::own_world_near_move, thresholds::own_world_far_move}) {
    for (const InPlan& way :
         {InPlan{1, 0}, {0.7, 0.7}, {0, 1}, {-0.7, 0.7}, {-1, 0}, {-0.7, -0.7}, {0, -1}, {0.7, -0.7}})
      result.push_back({scale * far * way[0], scale * far * way[1]});
  }
  return result;
}

// An exchange of identities without numbers to seek: a rival of the causes with worlds of their own.
bool exchanges_names(const Cause& cause) {
  return cause.meaning().kind == MUSTER_INSTRUMENT && !cause.needs_own_world() &&
         with_flag(cause, MUSTER_FREE).empty() && with_flag(cause, MUSTER_EACH).empty();
}

void add_cause(const Cause& cause, const std::vector<CauseRow>& rows, const std::vector<InPlan>& places,
               const std::vector<InPlan>& moves, std::vector<Hypothesis>& out) {
  const auto sought = sought_by(cause);
  const std::vector<InPlan>& starts = sought && !sought->is_place ? moves : places;
  for (const CauseRow& row : rows) {
    for (const Words& words : choices_of(cause)) {
      if (!sought) out.push_back({&cause, out.size(), row, words, {}});
      for (const InPlan& start : starts)
        if (sought) out.push_back({&cause, out.size(), row, words, start});
    }
  }
}

}  // namespace

std::string Hypothesis::label() const {
  std::string result;
  const auto add = [&](const std::string& word) { result += (result.empty() ? "" : " ") + word; };
  const auto references = cause->rows();
  for (std::size_t k = 0; k < references.size(); ++k) add(std::string(references[k]->text) + '/' + row[k]);
  for (const auto& [name, word] : words) add(name + ' ' + word);
  return result;
}

Supposed::Supposed(LinkModel& model, const Hypothesis& h) : model_(model), cause_(h.cause) {
  if (!cause_) return;
  const Place at{model.simulation().world().file.string()};
  InstanceDeclaration declared = instance_of(*cause_, supposed, h.row, "", 1, at);
  for (const auto& [name, word] : h.words) declared.attributes.push_back({name, word, at, at});
  model.simulation().share(cause_->library);
  model.simulation().insert_all({declared});
  if (h.place) move(*h.place);
}

Supposed::~Supposed() {
  if (cause_) model_.simulation().remove_all({supposed});
}

InPlan Supposed::move(const InPlan& place) {
  const Sought sought = *sought_by(*cause_);
  const InPlan there{std::clamp(place[0], sought.east->min, sought.east->max),
                     std::clamp(place[1], sought.north->min, sought.north->max)};
  model_.set(std::string(supposed) + '/' + sought.east->name, there[0]);
  model_.set(std::string(supposed) + '/' + sought.north->name, there[1]);
  return there;
}

Hypotheses hypotheses_of(const DiagnosisSetup& setup, const Diagnosis& found) {
  const std::vector<MappedWall>& walls = found.seen.walls;
  Hypotheses result;
  const MeasurementGeometry geometry = measurement_geometry(setup.model, setup.data);
  const std::vector<InPlan> places = middles_of(geometry, walls),
                            moves = first_moves(setup.model, found.causes, geometry.scale);
  for (const Cause& cause : setup.causes) {
    if (!cause.needs_own_world() && !exchanges_names(cause)) continue;
    const auto rows = rows_for(cause, setup.model, geometry);
    std::string why = why_not(cause, geometry, setup.data);
    if (why.empty() && rows.empty()) why = why_no_rows(cause);
    if (why.empty() && sought_by(cause) && geometry.standing.size() < thresholds::fewest_standing && walls.empty())
      why = "not testable: a plan without walls shows how it lies only by two radios that stand, or more";
    if (why.empty()) add_cause(cause, rows, places, moves, result.all);
    if (!cause.needs_own_world()) continue;
    why.empty() ? result.searched.push_back(cause.id) : result.not_tested.push_back(cause.id + ": " + why);
  }
  return result;
}

CauseEstimate stated(const Hypothesis& h, const InPlan& place_sd) {
  CauseEstimate out;
  out.id = h.cause->id;
  out.label = h.label();
  out.title = h.cause->meaning().title;
  out.tell_apart = h.cause->meaning().tell_apart;
  out.covariates = {"map"};
  out.words = h.words;
  const auto references = h.cause->rows();
  for (std::size_t k = 0; k < references.size(); ++k) {
    if (k > 0) {
      out.words[references[k]->name] = h.row[k];
      continue;
    }
    out.row_parameter = references[k]->name;
    out.row = h.row[k];
  }
  for (const std::size_t k : {0, 1}) {
    if (!h.place) break;
    const Sought sought = *sought_by(*h.cause);
    const muster_param& p = k == 0 ? *sought.east : *sought.north;
    const double at = (*h.place)[k], half = thresholds::normal95 * place_sd[k];
    out.values.push_back({p.name, p.unit, at, place_sd[k], at - half, at + half, p.min, p.max});
  }
  return out;
}

}  // namespace muster::diagnosis
