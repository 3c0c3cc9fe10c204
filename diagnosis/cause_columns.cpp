#include "diagnosis/cause_columns.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "diagnosis/cause_axes.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double quarter_turn = 1.5707963267948966;
constexpr double least_share = 0.01;  // of readings that a place must concern

bool needs(const Cause& cause, const std::string& column) {
  std::istringstream words(cause.meaning().covariates);
  for (std::string word; words >> word;) {
    if (word == column) return true;
  }
  return false;
}

// Why the data cannot speak of a cause; empty if they can.
std::string why_not(const Cause& cause, const Survey& survey) {
  if (cause.meaning().kind != MUSTER_TERM) return "a stage, law or edit, not a term: not searched yet";
  if (!cause.linear()) return "no single parameter that it is proportional to: not searched yet";
  for (uint32_t k = 0; k < cause.plugin->param_count; ++k) {
    if (cause.plugin->params[k].kind == MUSTER_FILE) return "needs a table of its own: not searched yet";
  }
  if (needs(cause, "t") && !(survey.has_time && survey.time.length() > 0)) return "not testable: the data have no t";
  if (needs(cause, "rx_yaw") && !survey.has_yaw) return "not testable: the data have no rx_yaw";
  if (needs(cause, "tx_z") && !survey.has_height) return "not testable: all radios are at one height";
  return "";
}

// Rows of the world that a cause may be about. What needs a heading is sought in radios that turn; what needs places
// alone, in those that stand.
std::vector<std::string> rows_for(const Cause& cause, const LinkModel& model, const Survey& survey) {
  const muster_param* row = cause.row();
  if (!row) return {""};
  const std::string set = row->text;
  std::vector<std::string> result;
  if (!(row->flags & MUSTER_REQUIRED)) result.push_back("");
  for (const RowDeclaration& declared : model.simulation().world().rows) {
    if (std::find(declared.sets.begin(), declared.sets.end(), set) == declared.sets.end()) continue;
    const auto number = static_cast<std::size_t>(model.simulation().board().find_set(set)->find(declared.name));
    if (set == "radio") {
      if (number >= survey.turns.size()) continue;  // it took part in no reading
      if (needs(cause, "rx_yaw") ? !survey.turns[number] : needs(cause, "tx_x") && survey.moves[number]) continue;
    }
    result.push_back(declared.name);
  }
  return result;
}

void find_place(CauseShape& shape) {
  for (uint32_t k = 0; k < shape.cause.plugin->param_count; ++k) {
    const muster_param& p = shape.cause.plugin->params[k];
    if (p.flags & (MUSTER_EAST | MUSTER_NORTH)) shape.coordinates.push_back(p.name);
  }
  if (shape.coordinates.size() == 2) shape.place = PlaceShape::point;
  if (shape.coordinates.size() == 4) shape.place = PlaceShape::segment;
}

// Two columns stand for all directions where the effect is a wave in the cyclic parameter.
bool is_wave(CauseModel& model, const std::string& parameter, std::map<std::string, double> others) {
  const auto at = [&](double angle) {
    others[parameter] = angle;
    return model.column(0, others);
  };
  const VectorXd zero = at(0), quarter = at(quarter_turn), one = at(1);
  return zero.norm() > 0 && (std::cos(1) * zero + std::sin(1) * quarter - one).norm() < 1e-9 * zero.norm();
}

std::vector<const muster_param*> sought(const Cause& cause) {
  std::vector<const muster_param*> result;
  for (uint32_t k = 0; k < cause.plugin->param_count; ++k) {
    const muster_param& p = cause.plugin->params[k];
    if (p.kind == MUSTER_REAL && (p.flags & MUSTER_FREE) && !(p.flags & (MUSTER_LINEAR | MUSTER_EAST | MUSTER_NORTH)))
      result.push_back(&p);
  }
  return result;
}

// False if the data cannot tell one of its parameters.
bool find_axes(CauseShape& shape, CauseModel& model, const Survey& survey) {
  for (uint32_t k = 0; k < shape.cause.plugin->param_count; ++k) {
    const muster_param& p = shape.cause.plugin->params[k];
    if ((p.flags & MUSTER_CYCLIC) && !(p.flags & MUSTER_FREE)) shape.held[p.name] = survey.plan_angle;
  }
  auto parameters = sought(shape.cause);
  for (const muster_param* p : parameters) {
    if ((p->flags & MUSTER_CYCLIC) && shape.wave.empty() && is_wave(model, p->name, shape.held)) shape.wave = p->name;
  }
  std::erase_if(parameters, [&](const muster_param* p) { return p->name == shape.wave; });
  for (const muster_param* p : parameters) {
    const auto axis = axis_of(*p, survey, shape, parameters.size() == 1);
    if (!axis) return false;
    shape.axes.push_back(*axis);
  }
  return true;
}

Index place_entries(PlaceShape place) { return place == PlaceShape::none ? 0 : place == PlaceShape::point ? 2 : 4; }

VectorXd theta_of(std::size_t row, const VectorXd& place, const std::vector<double>& axes) {
  VectorXd theta(1 + place.size() + static_cast<Index>(axes.size()));
  theta[0] = static_cast<double>(row);
  theta.segment(1, place.size()) = place;
  for (std::size_t k = 0; k < axes.size(); ++k) theta[1 + place.size() + static_cast<Index>(k)] = axes[k];
  return theta;
}

std::vector<std::vector<double>> products(const std::vector<Axis>& axes) {
  std::vector<std::vector<double>> result{{}};
  for (const Axis& axis : axes) {
    std::vector<std::vector<double>> longer;
    for (const auto& begun : result) {
      for (const double value : axis.values) {
        longer.push_back(begun);
        longer.back().push_back(value);
      }
    }
    result = std::move(longer);
  }
  return result;
}

// A place that takes level from links through it cannot stand where a radio was driven.
bool stands(const search::Candidate& c) { return !c.pieces.empty(); }

bool clear_of_ways(const CauseShape& shape, const Survey& survey, const VectorXd& t) {
  if (shape.place == PlaceShape::segment) return driven_across(survey, t[1], t[2], t[3], t[4]) == 0;
  return !driven_through(survey, t[1], t[2], shape.axes.empty() ? 0.5 : std::exp(t[3]));
}

std::function<Eigen::MatrixXd(const VectorXd&)> columns_at(const std::shared_ptr<const CauseShape>& shape,
                                                           const std::shared_ptr<CauseModel>& run,
                                                           const std::vector<Index>& used) {
  return [shape, run, used](const VectorXd& t) {
    auto parameters = shape->parameters(t);
    Eigen::MatrixXd result(static_cast<Index>(used.size()), shape->wave.empty() ? 1 : 2);
    for (Index j = 0; j < result.cols(); ++j) {
      if (!shape->wave.empty()) parameters[shape->wave] = j ? quarter_turn : 0;
      result.col(j) = run->column(static_cast<std::size_t>(t[0]), parameters)(used);
    }
    return result;
  };
}

struct Maker {
  const LinkModel& model;
  const Survey& survey;
  const CauseSources& sources;
  Eigen::HouseholderQR<Eigen::MatrixXd> base;
  Index base_columns;

  // Whether readings tell this column from the base model's parameters.
  bool shows(const VectorXd& column) const {
    VectorXd rest = base.householderQ().transpose() * column;
    return column.norm() > 0 && rest.tail(rest.size() - base_columns).norm() > 1e-6 * column.norm();
  }

  void bounds(const CauseShape& shape, search::Candidate& c) const {
    const Index places = place_entries(shape.place), n = 1 + places + static_cast<Index>(shape.axes.size());
    c.lower = c.upper = c.step = VectorXd::Zero(n);
    c.upper[0] = static_cast<double>(shape.rows.size());
    if (places >= 2) {
      c.lower.segment(1, 2) << survey.east.low, survey.north.low;
      c.upper.segment(1, 2) << survey.east.high, survey.north.high;
      c.step.segment(1, 2).setConstant(places == 4 ? 0.4 : 0.3);
    }
    if (places == 4) {
      c.lower.segment(3, 2) << 0.8, -4;
      c.upper.segment(3, 2) << (shape.axes.empty() ? 9 : 40), 4;
      c.step.segment(3, 2) << 0.8, 0.12;
    }
    for (std::size_t k = 0; k < shape.axes.size(); ++k) {
      const Index at = 1 + places + static_cast<Index>(k);
      c.lower[at] = shape.axes[k].lower;
      c.upper[at] = shape.axes[k].upper;
      c.step[at] = shape.axes[k].step;
    }
  }

  // What the search asks of a candidate, from what the plugin declares.
  void describe(const CauseShape& shape, search::Candidate& c) const {
    const Cause& cause = shape.cause;
    const muster_param& linear = *cause.linear();
    const bool time = needs(cause, "t"), heading = needs(cause, "rx_yaw"), placed = shape.place != PlaceShape::none;
    const std::string set = cause.row() ? cause.row()->text : "";
    c.id = cause.id;
    c.width = shape.wave.empty() ? 1 : 2;
    c.sign = c.width == 1 && linear.min == 0 ? 1 : 0;
    c.time_like = time;
    c.offset = set == "radio" && !time && !heading && !needs(cause, "tx_x");
    c.slow = !time && !heading && !(placed && c.sign && linear.unit == std::string("dB"));
    c.level_like = set.empty() && !placed && !time;
    if (placed && !c.slow) c.pieces = "place";
    if (time) {
      c.covariates = {"time"};
      c.stands_for = {"time", "time_per_tx"};
    } else if (heading) {
      c.covariates = {"bearing"};
      c.stands_for = {"bearing", "heading"};
    } else if (placed || set == "wall") {
      c.covariates = {"map"};
      c.stands_for = {"position", "txbearing"};
    } else if (set == "radio") {
      c.covariates = {"link"};
      c.stands_for = {"link", "txbearing"};
    } else {
      c.covariates = {"logd"};
      c.stands_for = {"logd", "level"};
    }
    if (!c.refinable()) return;
    c.starts = stands(c) ? (shape.place == PlaceShape::segment ? 8 : 5) : 1;
    c.evaluations = placed ? 110 : 35;
    c.charge = shape.place == PlaceShape::segment ? 4.5 : placed ? 4 : 0.7;
  }

  void label(const std::shared_ptr<const CauseShape>& shape, search::Candidate& c) const {
    c.label = [shape](const VectorXd& t) {
      const muster_param* row = shape->cause.row();
      if (row && !shape->row(t).empty()) return std::string(row->text) + '/' + shape->row(t);
      std::ostringstream at;
      at.precision(2);
      at << std::fixed;
      if (shape->place == PlaceShape::none) return std::string("all");
      const auto p = shape->parameters(t);
      for (std::size_t k = 0; k < shape->coordinates.size(); k += 2)
        at << (k ? " to (" : "(") << p.at(shape->coordinates[k]) << ", " << p.at(shape->coordinates[k + 1]) << ')';
      return at.str();
    };
  }

  void grid(const CauseShape& shape, search::Candidate& c) const {
    const auto axes = products(shape.axes);
    std::vector<VectorXd> places{VectorXd()};
    if (shape.place != PlaceShape::none) places = places_over(shape.place, survey, !stands(c));
    // Shapes outermost, rows innermost: rows at one shape cost one evaluation.
    for (const VectorXd& place : places) {
      for (const auto& values : axes) {
        for (std::size_t row = 0; row < shape.rows.size(); ++row) {
          const VectorXd theta = theta_of(row, place, values);
          if (stands(c) && !clear_of_ways(shape, survey, theta)) continue;
          const Eigen::MatrixXd columns = c.columns(theta);
          const double share = (columns.array() != 0).cast<double>().mean();
          if (share >= (shape.place == PlaceShape::none ? 0 : least_share) && shows(columns.col(0)))
            c.grid.push_back(theta);
        }
      }
    }
  }
};

// The ends that lie farthest apart of each pair of segments.
std::vector<VectorXd> spans(const std::vector<search::Piece>& pieces, const std::string& id) {
  std::vector<VectorXd> result;
  std::vector<std::array<Eigen::Vector2d, 2>> ends;
  for (const search::Piece& p : pieces) {
    const Eigen::Vector2d middle = p.theta.segment<2>(1);
    const Eigen::Vector2d half =
        p.id == id ? Eigen::Vector2d(p.theta[3] / 2 * std::cos(p.theta[4]), p.theta[3] / 2 * std::sin(p.theta[4]))
                   : Eigen::Vector2d(0, 0);
    ends.push_back({middle - half, middle + half});
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      Eigen::Vector2d from = ends[i][0], to = ends[i][0];
      for (const auto& a : {ends[i][0], ends[i][1], ends[j][0], ends[j][1]}) {
        for (const auto& b : {ends[i][0], ends[i][1], ends[j][0], ends[j][1]}) {
          if ((b - a).norm() > (to - from).norm()) from = a, to = b;
        }
      }
      const Eigen::Vector2d way = to - from, middle = (from + to) / 2;
      result.push_back(Eigen::VectorXd(5));
      result.back() << 0, middle, way.norm(), std::atan2(way.y(), way.x());
    }
  }
  return result;
}

std::string make(const Cause& cause, const Maker& maker, CauseSearch& out) {
  if (const std::string why = why_not(cause, maker.survey); !why.empty()) return why;
  auto shape = std::make_shared<CauseShape>();
  shape->cause = cause;
  shape->rows = rows_for(cause, maker.model, maker.survey);
  if (shape->rows.empty()) return "not testable: the world has no row that it could be about";
  find_place(*shape);
  const CauseSources& s = maker.sources;
  const auto run = std::make_shared<CauseModel>(cause, s.world, s.data, s.plugins, shape->rows, s.world_parameters);
  if (!find_axes(*shape, *run, maker.survey)) return "not testable: what it depends on does not vary";
  search::Candidate c;
  if (shape->place != PlaceShape::none || !shape->axes.empty()) maker.bounds(*shape, c);
  maker.describe(*shape, c);
  maker.label(shape, c);
  c.columns = columns_at(shape, run, maker.sources.used);
  maker.grid(*shape, c);
  if (c.grid.empty()) return "not testable: no reading depends on it, or the base model takes it up";
  if (stands(c)) {
    c.admitted = [shape, survey = maker.survey](const VectorXd& t) {
      if (shape->place == PlaceShape::point) return clear_of_ways(*shape, survey, t) ? 1.0 : 0.3;
      return std::pow(0.8, std::min(driven_across(survey, t[1], t[2], t[3], t[4]), 10));
    };
    if (shape->place == PlaceShape::segment)
      c.spanning = [id = c.id](const std::vector<search::Piece>& pieces) { return spans(pieces, id); };
  }
  out.found.push_back({shape, std::move(c)});
  return "";
}

}  // namespace

std::map<std::string, double> CauseShape::parameters(const VectorXd& theta) const {
  std::map<std::string, double> result = held;
  if (place == PlaceShape::point) {
    result[coordinates[0]] = theta[1];
    result[coordinates[1]] = theta[2];
  } else if (place == PlaceShape::segment) {
    const double x = theta[3] / 2 * std::cos(theta[4]), y = theta[3] / 2 * std::sin(theta[4]);
    result[coordinates[0]] = theta[1] - x;
    result[coordinates[1]] = theta[2] - y;
    result[coordinates[2]] = theta[1] + x;
    result[coordinates[3]] = theta[2] + y;
  }
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const double value = theta[1 + place_entries(place) + static_cast<Index>(k)];
    result[axes[k].parameter] = axes[k].logarithmic ? std::exp(value) : value;
  }
  return result;
}

search::Candidate at_readings_of(const CauseCandidate& cause, const CauseSources& s) {
  const auto run = std::make_shared<CauseModel>(cause.shape->cause, s.world, s.data, s.plugins, cause.shape->rows,
                                                s.world_parameters);
  search::Candidate result = cause.candidate;
  result.columns = columns_at(cause.shape, run, s.used);
  return result;
}

CauseSearch cause_candidates(const LinkModel& model, const Survey& survey, const CauseSources& sources,
                             const Eigen::MatrixXd& base) {
  CauseSearch result;
  const Maker maker{model, survey, sources, Eigen::HouseholderQR<Eigen::MatrixXd>(base), base.cols()};
  for (const Cause& cause : causes_on(sources.plugins)) {
    const std::string why = make(cause, maker, result);
    if (!why.empty()) result.not_tested.push_back(cause.id + ": " + why);
  }
  return result;
}

}  // namespace muster::diagnosis
