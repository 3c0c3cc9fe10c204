#include "diagnosis/causes/cause_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <tuple>

#include "diagnosis/causes/applicability.hpp"
#include "diagnosis/causes/parameter_axes.hpp"
#include "diagnosis/causes/start_grid.hpp"
#include "diagnosis/causes/strength_selection.hpp"
#include "diagnosis/inference/noise/basis.hpp"
#include "diagnosis/radio/places/spatial_scan.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double quarter_turn = 1.5707963267948966;
constexpr double least_share = 0.01;  // of readings that a place must concern

void find_place(CauseShape& shape) {
  for (uint32_t k = 0; k < shape.cause.plugin->param_count; ++k) {
    const muster_param& p = shape.cause.plugin->params[k];
    if (p.flags & (MUSTER_EAST | MUSTER_NORTH)) shape.coordinates.push_back(p.name);
  }
  if (shape.coordinates.size() == 2) shape.place = PlaceShape::point;
  if (shape.coordinates.size() == 4) shape.place = PlaceShape::segment;
}

// Two columns stand for all directions where the effect is a wave in the cyclic parameter.
bool is_wave(const CauseSources& sources, const CauseShape& shape, const std::string& parameter) {
  auto others = shape.held;
  const auto at = [&](double angle) {
    others[parameter] = angle;
    VectorXd column(static_cast<Index>(sources.used.size()));
    sources.run->fill(shape.cause, shape.rows, 0, others, sources.used, column);
    return column;
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
bool find_axes(CauseShape& shape, const CauseSources& sources, const MeasurementGeometry& survey) {
  for (uint32_t k = 0; k < shape.cause.plugin->param_count; ++k) {
    const muster_param& p = shape.cause.plugin->params[k];
    if ((p.flags & MUSTER_CYCLIC) && !(p.flags & MUSTER_FREE)) shape.held[p.name] = survey.plan_angle;
  }
  auto parameters = sought(shape.cause);
  for (const muster_param* p : parameters) {
    if ((p->flags & MUSTER_CYCLIC) && shape.wave.empty() && is_wave(sources, shape, p->name)) shape.wave = p->name;
  }
  std::erase_if(parameters, [&](const muster_param* p) { return p->name == shape.wave; });
  for (const muster_param* p : parameters) {
    const auto axis = axis_of(*p, survey, shape, parameters.size() == 1);
    if (!axis) return false;
    shape.axes.push_back(*axis);
  }
  return true;
}

// A place that takes level from links through it cannot stand where a radio was driven.
bool stands(const inference::Candidate& c) { return !c.role.pieces.empty(); }

bool clear_of_ways(const CauseShape& shape, const MeasurementGeometry& survey, const VectorXd& t) {
  if (shape.place == PlaceShape::segment) return driven_across(survey, t[1], t[2], t[3], t[4]) == 0;
  return !driven_through(survey, t[1], t[2], shape.axes.empty() ? 0.5 : std::exp(t[3]));
}

bool is_share(const muster_param& p) { return p.min == 0 && p.max == 1 && std::string_view(p.unit).empty(); }

std::function<Eigen::MatrixXd(const VectorXd&)> columns_at(const std::shared_ptr<const CauseShape>& shape,
                                                           const std::shared_ptr<CauseModel>& run,
                                                           const std::vector<Index>& used) {
  return [shape, run, used](const VectorXd& t) {
    auto parameters = shape->parameters(t);
    Eigen::MatrixXd result(static_cast<Index>(used.size()), shape->columns());
    const auto row = static_cast<std::size_t>(t[0]);
    for (Index j = 0; j < result.cols(); ++j) {
      if (!shape->wave.empty()) parameters[shape->wave] = j ? quarter_turn : 0;
      if (shape->linear.size() > 1) shape->set_one(static_cast<std::size_t>(j), parameters);
      run->fill(shape->cause, shape->rows, row, parameters, used, result.col(j));
    }
    return result;
  };
}

// The same places, with the axes of another theta.
std::vector<VectorXd> shaped_as(const VectorXd& theta, std::vector<VectorXd> places) {
  for (VectorXd& place : places) {
    const Index entries = place.size(), axes = theta.size() - entries;
    place.conservativeResize(theta.size());
    place.tail(axes) = theta.tail(axes);
  }
  return places;
}

struct Maker {
  const MeasurementGeometry& survey;
  const CauseSources& sources;
  const BaseSpace base;
  const noise::Rows& rows;

  // How many sizes of its place the plan gives: it is sought in the plan's rooms, or between its walls, as they are.
  std::size_t given_sizes(const CauseShape& shape) const {
    if (shape.is_room() && !survey.rooms.empty()) return 2;
    return shape.is_strip() && !survey.strips.empty() ? 1 : 0;
  }

  void bounds(const CauseShape& shape, inference::Candidate& c) const {
    constexpr double beyond_map = 10;  // m: a radio may stand outside of all that was mapped and driven through
    const double around = shape.cause.meaning().kind == MUSTER_WORLD_EDIT ? beyond_map : 0;
    const Index places = place_entries(shape.place), n = 1 + places + static_cast<Index>(shape.axes.size());
    c.refinement.lower = c.refinement.upper = c.refinement.step = VectorXd::Zero(n);
    c.refinement.upper[0] = static_cast<double>(shape.rows.size());
    if (places >= 2) {
      c.refinement.lower.segment(1, 2) << survey.east.low - around, survey.north.low - around;
      c.refinement.upper.segment(1, 2) << survey.east.high + around, survey.north.high + around;
      c.refinement.step.segment(1, 2).setConstant(places == 4 ? 0.4 : 0.3);
    }
    if (places == 4) {
      c.refinement.lower.segment(3, 2) << 0.8, -4;
      c.refinement.upper.segment(3, 2) << (shape.is_strip() ? 40 : 9), 4;
      c.refinement.step.segment(3, 2) << 0.8, 0.12;
    }
    for (std::size_t k = 0; k < shape.axes.size(); ++k) {
      const Index at = 1 + places + static_cast<Index>(k);
      c.refinement.lower[at] = shape.axes[k].lower;
      c.refinement.upper[at] = shape.axes[k].upper;
      c.refinement.step[at] = shape.axes[k].step;
    }
    if (const auto sizes = static_cast<Index>(given_sizes(shape)); sizes > 0)
      c.refinement.step.segment(1, places + sizes).setZero();
  }

  // What the search asks of a candidate, from what the plugin declares.
  void describe(const CauseShape& shape, inference::Candidate& c) const {
    const Cause& cause = shape.cause;
    const bool time = needs(cause, "t"), heading = needs(cause, "rx_yaw"), placed = shape.place != PlaceShape::none;
    const std::string column = own_column(cause);
    const bool edit = cause.meaning().kind == MUSTER_WORLD_EDIT;
    const bool decibels = shape.linear.size() == 1 && shape.linear[0]->unit == std::string("dB");
    c.id = cause.id;
    c.design.width = static_cast<int>(shape.columns());
    // A term of sought parameters without a size of its own has that of what is fitted beside it.
    c.design.whole = shape.linear.empty() && (edit || shape.axes.empty());
    c.design.sign = shape.linear.empty() || (c.design.width == 1 && shape.linear[0]->min == 0) ? 1 : 0;
    c.role.time_like = time && column.empty();
    c.role.parameters = static_cast<int>(cause.plugin->param_count + shape.axes.size());
    c.role.slow = !time && !heading && !(placed && c.design.sign && decibels);
    c.role.level_like = shape.set().empty() && !placed && !time;
    if (placed && !c.role.slow) c.role.pieces = "place";
    std::tie(c.covariates, c.role.stands_for) = covariates_of(shape);
    c.role.over_sites = c.own() == "map";
    if (!c.refinement.any()) return;
    c.refinement.starts = stands(c) ? (shape.place == PlaceShape::segment ? 16 : 10) : edit ? 12 : 1;
    c.refinement.evaluations = edit ? 60 : placed ? 110 : 35;
    c.refinement.charge = charge_of(shape, c);
  }

  // refinement_charge() over clean cases of the exam: walls 6.3 and things 5.5 (median of seven), places on a grid 1.7
  // and 1.1, strips on a grid 2.0, rooms of the plan 0.2, radios elsewhere -4.9, all others 0.1 to 1.1 (median of three
  // to five; standard error 0.4). It grows towards the tail, where decisions fall, by half a nat a sought parameter.
  double charge_of(const CauseShape& shape, const inference::Candidate& c) const {
    if (stands(c)) return shape.place == PlaceShape::segment ? 8.3 : 7.0;
    if (shape.cause.meaning().kind == MUSTER_WORLD_EDIT) return 0;
    if (given_sizes(shape) > 0) return 0.5;
    return shape.place != PlaceShape::none ? 4 : 1;
  }

  // What it is a function of, its own covariate first, and the smooths whose place it may take.
  static std::pair<std::vector<std::string>, std::set<std::string>> covariates_of(const CauseShape& shape) {
    if (const std::string column = own_column(shape.cause); !column.empty()) return {{column}, {column}};
    if (needs(shape.cause, "t")) return {{"time"}, {"time", "time_per_tx"}};
    if (needs(shape.cause, "rx_yaw")) return {{"bearing"}, {"bearing", "heading"}};
    if (shape.place != PlaceShape::none || shape.set() == "wall") return {{"map"}, {"position", "txbearing"}};
    if (shape.set() == "radio") return {{"link"}, {"link", "txbearing"}};
    return {{"logd"}, {"logd", "level"}};
  }

  void label(const std::shared_ptr<const CauseShape>& shape, inference::Candidate& c) const {
    c.label = [shape](const VectorXd& t) {
      if (std::string row = shape->row_label(t); !row.empty()) return row;
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

  // A radio is a few metres from where the map has it, hardly ever more. Less than a map or a mount leaves open is no
  // other place: millimetres turn links past the end of a wall, which shows clearly in a smooth field.
  void believe_in_map(const CauseShape& shape, inference::Candidate& c) const {
    constexpr double off = 3, no_other_place = 0.1;  // m
    std::vector<Eigen::Vector2d> mapped;
    for (const CauseRow& row : shape.rows)
      mapped.push_back(place_of_radio(sources.model, row.at(0)).value_or(Eigen::Vector2d(0, 0)));
    const auto moved = [mapped = std::move(mapped)](const VectorXd& t) {
      return (t.segment<2>(1) - mapped[static_cast<std::size_t>(t[0])]).norm();
    };
    c.refinement.belief = [moved](const VectorXd& t) { return -std::pow(moved(t) / off, 2) / 2; };
    c.refinement.admitted = [moved](const VectorXd& t) { return moved(t) < no_other_place ? 0.0 : 1.0; };
  }

  // Where a wall or a thing could stand is swept over.
  void let_sweep(const CauseShape& shape, inference::Candidate& c) const {
    const bool wall = shape.place == PlaceShape::segment && !shape.is_strip();
    if (!wall && !(shape.place == PlaceShape::point && shape.axes.size() == 1)) return;
    const auto link = [&](Index reading) -> std::array<double, 4> {
      const auto& [a, b] =
          sources.model.ends()[static_cast<std::size_t>(sources.used[static_cast<std::size_t>(reading)])];
      return {a.x, a.y, b.x, b.y};
    };
    Links links;
    for (Index row = 0; row < rows.size(); ++row) links.push_back(link(rows.middle(row)));
    if (wall) {
      ReadingLinks readings;
      for (const Index reading : rows.in_order()) {
        const auto row = static_cast<std::size_t>(rows.row_of()[static_cast<std::size_t>(reading)]);
        if (readings.first.size() == row) readings.first.push_back(readings.links.size());
        readings.links.push_back(link(reading));
      }
      readings.first.push_back(readings.links.size());
      c.refinement.proposed =
          [sweep = std::make_shared<const SegmentScan>(survey, std::move(links), std::move(readings)),
           first = c.design.grid[0]](inference::Tally& tally) { return shaped_as(first, (*sweep)(tally)); };
    } else {
      c.refinement.step.tail<3>().setConstant(0.1);  // m: its tops are narrow and lie close
      c.refinement.proposed = [sweep = std::make_shared<const DiskScan>(survey, std::move(links))](
                                  inference::Tally& tally) { return (*sweep)(tally); };
    }
  }

  void grid(const CauseShape& shape, inference::Candidate& c) const {
    std::vector<Eigen::MatrixXf> atoms;
    for (const VectorXd& theta : starts_of(shape, survey, sources.model, stands(c))) {
      if (stands(c) && !clear_of_ways(shape, survey, theta)) continue;
      const Eigen::MatrixXd columns = c.design.columns(theta);
      const double share = (columns.array() != 0).cast<double>().mean();
      if (share < (shape.place == PlaceShape::none ? 0 : least_share) || !base.leaves(columns.col(0))) continue;
      c.design.grid.push_back(theta);
      atoms.push_back(rows.mean(columns).cast<float>());
    }
    noise::Sheet together(rows.size(), c.design.width * static_cast<Index>(atoms.size()));
    for (std::size_t k = 0; k < atoms.size(); ++k)
      together.middleCols(c.design.width * static_cast<Index>(k), c.design.width) = atoms[k];
    c.design.atoms = std::make_shared<const noise::Sheet>(std::move(together));
  }
};

std::string make(const Cause& cause, const Maker& maker, CauseSearch& out) {
  const CauseSources& s = maker.sources;
  if (std::string why = why_not(cause, maker.survey, s.data); !why.empty()) return why;
  auto shape = std::make_shared<CauseShape>();
  shape->cause = cause;
  shape->rows = rows_for(cause, s.model, maker.survey);
  if (shape->rows.empty()) return why_no_rows(cause, s.model, maker.survey);
  find_place(*shape);
  if (!find_axes(*shape, s, maker.survey)) return "not testable: what it depends on does not vary";
  choose_strengths(*shape, s, maker.base);
  if (shape->linear.empty() && !cause.linear().empty())
    return "not testable: no reading depends on it, or the base model takes it up";
  // A share of what the map has: all of it is what there is to be told from another strength.
  if (shape->linear.size() == 1 && is_share(*shape->linear[0])) shape->linear.clear();
  inference::Candidate c;
  if (shape->place != PlaceShape::none || !shape->axes.empty()) maker.bounds(*shape, c);
  maker.describe(*shape, c);
  maker.label(shape, c);
  c.design.columns = columns_at(shape, s.run, s.used);
  maker.grid(*shape, c);
  if (c.design.grid.empty()) return "not testable: no reading depends on it, or the base model takes it up";
  if (cause.meaning().kind == MUSTER_WORLD_EDIT && shape->place == PlaceShape::point) maker.believe_in_map(*shape, c);
  if (stands(c)) {
    c.refinement.admitted = [shape, survey = maker.survey](const VectorXd& t) {
      if (shape->place == PlaceShape::point) return clear_of_ways(*shape, survey, t) ? 1.0 : 0.3;
      return std::pow(0.8, std::min(driven_across(survey, t[1], t[2], t[3], t[4]), 10));
    };
    if (c.refinement.any()) maker.let_sweep(*shape, c);
    if (shape->place == PlaceShape::point && shape->axes.size() == 1)
      c.refinement.moves = [survey = maker.survey](const VectorXd& t) { return moves_of_disk(survey, t); };
    if (shape->place == PlaceShape::segment) {
      c.refinement.moves = [survey = maker.survey](const VectorXd& t) { return moves_of_segment(survey, t); };
      c.refinement.belief = [survey = maker.survey](const VectorXd& t) { return belief_in_segment(survey, t); };
      c.role.spanning = [id = c.id, first = c.design.grid[0]](const std::vector<inference::Piece>& pieces) {
        return shaped_as(first, spans(pieces, id));
      };
    }
  }
  out.found.push_back({shape, std::move(c)});
  return "";
}

// A cause that cannot run in this world, or with this table, says so itself.
std::string made(const Cause& cause, const Maker& maker, CauseSearch& out) {
  try {
    return make(cause, maker, out);
  } catch (const Error& error) {
    maker.sources.run->clear();
    return std::string("not testable: ") + error.what();
  }
}

}  // namespace

inference::Candidate at_readings_of(const CauseCandidate& cause, const CauseSources& s) {
  inference::Candidate result = cause.candidate;
  result.design.columns = columns_at(cause.shape, s.run, s.used);
  result.design.atoms = nullptr;
  result.design.sketch = nullptr;
  result.design.near = nullptr;
  return result;
}

bool shifts_levels(const Cause& cause) {
  const auto kind = cause.meaning().kind;
  return kind != MUSTER_LAW && !(kind == MUSTER_STAGE && cause.linear().empty());
}

CauseSearch cause_candidates(const std::vector<Cause>& causes, const MeasurementGeometry& survey,
                             const CauseSources& sources, const Eigen::MatrixXd& base, const noise::Rows& rows) {
  CauseSearch result;
  const Maker maker{survey, sources, BaseSpace(base), rows};
  for (const Cause& cause : causes) {
    if (!shifts_levels(cause)) continue;
    const std::string why = made(cause, maker, result);
    if (!why.empty()) result.not_tested.push_back(cause.id + ": " + why);
  }
  return result;
}

}  // namespace muster::diagnosis
