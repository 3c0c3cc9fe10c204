#include "diagnosis/radio/causes/link_cause_domain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "diagnosis/radio/causes/applicability.hpp"
#include "diagnosis/radio/causes/place_axes.hpp"
#include "diagnosis/radio/causes/place_grid.hpp"
#include "diagnosis/radio/causes/place_moves.hpp"
#include "diagnosis/radio/causes/spatial_scan.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// True for objects that attenuate links through them.
bool stands(const inference::Candidate& c) { return !c.role.pieces.empty(); }

// False where a radio was driven through it, which none can be but a hill or a wood; and where a radio stands in that.
bool clear_of_ways(const CauseShape& shape, const MeasurementGeometry& geometry, const VectorXd& t) {
  if (shape.place == PlaceShape::segment) return driven_across(geometry, t[1], t[2], t[3], t[4]) == 0;
  const double radius = shape.axes.empty() ? 0.5 : std::exp(t[3]);
  if (!geometry.is_outdoors() || radius < thresholds::smallest_wood)
    return !driven_through(geometry, t[1], t[2], radius);
  return std::none_of(geometry.standing.begin(), geometry.standing.end(), [&](const auto& at) {
    return std::hypot(at[0] - t[1], at[1] - t[2]) < thresholds::well_inside * radius;
  });
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

// Covariates, its own one first, and the smooths that it may replace.
std::pair<std::vector<std::string>, std::set<std::string>> covariates_of(const CauseShape& shape) {
  if (const std::string column = own_column(shape.cause); !column.empty()) return {{column}, {column}};
  if (needs(shape.cause, "t")) return {{"time"}, {"time", "time_per_tx"}};
  if (needs(shape.cause, "rx_yaw")) return {{"bearing"}, {"bearing", "heading"}};
  if (shape.place != PlaceShape::none || shape.set() == "wall") return {{"map"}, {"position", "txbearing", "height"}};
  if (shape.set() == "radio") return {{"link"}, {"link", "txbearing"}};
  return {{"logd"}, {"logd", "level", "height"}};
}

}  // namespace

LinkCauseDomain::LinkCauseDomain(const LinkModel& model, const Dataset& data, const std::vector<Index>& used,
                                 const noise::Rows& rows)
    : model_(model), data_(data), used_(used), rows_(rows), geometry_(measurement_geometry(model, data)) {}

std::string LinkCauseDomain::why_not(const Cause& cause) const { return diagnosis::why_not(cause, geometry_, data_); }

std::vector<CauseRow> LinkCauseDomain::rows_for(const Cause& cause) const {
  return diagnosis::rows_for(cause, model_, geometry_);
}

std::string LinkCauseDomain::why_no_rows(const Cause& cause) const { return diagnosis::why_no_rows(cause); }

// True if the readings are of enough places to tell a carrier: a wave of any length bends to a few.
bool LinkCauseDomain::tells_carrier() const {
  using Cell = std::array<long, 3>;
  const auto cell_of = [](const End& e) {
    const auto part = [](double x) { return std::lround(x / thresholds::carrier_place); };
    return Cell{part(e.x), part(e.y), part(e.z)};
  };
  std::set<std::pair<Cell, Cell>> links;
  for (const Index i : used_) {
    const auto& [tx, rx] = model_.ends()[static_cast<std::size_t>(i)];
    links.insert(std::minmax({cell_of(tx), cell_of(rx)}));
    if (links.size() >= thresholds::fewest_carrier_places) return true;
  }
  return false;
}

// Fixes headings that are not free at the direction of the plan, and carriers: at that which the world writes, or at
// the default of one of its terms where the readings could tell none.
void LinkCauseDomain::hold(CauseShape& shape) const {
  for (uint32_t k = 0; k < shape.cause.plugin->param_count; ++k) {
    const muster_param& p = shape.cause.plugin->params[k];
    // Hills and houses reach above all radios.
    const bool is_a_height = shape.place != PlaceShape::none && std::string_view(p.unit) == "m" &&
                             !(p.flags & (MUSTER_FREE | MUSTER_EAST | MUSTER_NORTH));
    if (is_a_height && geometry_.is_outdoors() && shape.cause.meaning().kind == MUSTER_TERM)
      shape.held[p.name] = std::max(p.value, geometry_.height.high + 1);
    if ((p.flags & MUSTER_CYCLIC) && !(p.flags & MUSTER_FREE)) shape.held[p.name] = geometry_.plan_angle;
    if (std::string_view(p.unit) != "Hz") continue;
    if (const auto carrier = model_.carrier(); carrier && (carrier->is_written || !tells_carrier()))
      shape.held[p.name] = carrier->frequency;
  }
}

std::optional<Axis> LinkCauseDomain::axis_of(const muster_param& declared, const CauseShape& shape, bool alone) const {
  return diagnosis::axis_of(declared, geometry_, shape, alone);
}

// Number of the place's sizes given by the plan: length and width of a room, or width of a strip between walls.
std::size_t LinkCauseDomain::given_sizes(const CauseShape& shape) const {
  if (shape.is_room() && !geometry_.rooms.empty() && geometry_.halls().empty()) return 2;
  return shape.is_strip() && !geometry_.strips.empty() ? 1 : 0;
}

void LinkCauseDomain::bound_place(const CauseShape& shape, inference::Refinement& out) const {
  // A radio may lie outside the mapped and driven area.
  const double scale = geometry_.scale,
               around = shape.cause.meaning().kind == MUSTER_WORLD_EDIT ? scale * thresholds::beyond_map : 0;
  const Index places = place_entries(shape.place);
  if (places >= 2) {
    out.lower.segment(1, 2) << geometry_.east.low - around, geometry_.north.low - around;
    out.upper.segment(1, 2) << geometry_.east.high + around, geometry_.north.high + around;
    out.step.segment(1, 2).setConstant(scale * (places == 4 ? 0.4 : 0.3));
  }
  if (places == 4) {
    out.lower.segment(3, 2) << 0.8 * scale, -4;
    const double across = std::hypot(geometry_.east.length(), geometry_.north.length());
    out.upper.segment(3, 2) << (shape.is_strip() ? std::max(scale * 40, across) : scale * 9), 4;
    out.step.segment(3, 2) << scale * 0.8, 0.12;
  }
  if (const auto sizes = static_cast<Index>(given_sizes(shape)); sizes > 0)
    out.step.segment(1, places + sizes).setZero();
}

void LinkCauseDomain::describe(const CauseShape& shape, inference::Candidate& c) const {
  const Cause& cause = shape.cause;
  const std::string column = own_column(cause);
  const bool in_time = !column.empty() && column != "walls";  // a column's values change from reading to reading
  const bool time = needs(cause, "t") || in_time, heading = needs(cause, "rx_yaw"),
             placed = shape.place != PlaceShape::none;
  const bool edit = cause.meaning().kind == MUSTER_WORLD_EDIT;
  const bool decibels = shape.linear.size() == 1 && shape.linear[0]->unit == std::string("dB");
  c.role.time_like = time && column.empty();
  c.role.slow = !time && !heading && !(placed && c.design.sign && decibels);
  c.role.level_like = shape.set().empty() && !placed && !time;
  if (placed && !c.role.slow) c.role.pieces = "place";
  std::tie(c.covariates, c.role.replaces) = covariates_of(shape);
  c.role.over_sites = c.own() == "map";
  if (!c.refinement.any()) return;
  c.refinement.starts = stands(c) ? (shape.place == PlaceShape::segment ? 16 : 10) : edit ? 12 : 1;
  c.refinement.edged = shape.is_room() && given_sizes(shape) == 0;
  c.refinement.evaluations = edit ? 60 : placed ? 110 : 35;
  c.refinement.charge = charge_of(shape, c);
}

// refinement_charge() over clean cases of the exam: walls 6.3 and obstacles 5.5 (median of seven), places on a grid 1.7
// and 1.1, strips on a grid 2.0, rooms of the plan 0.2, moved radios -4.9, all others 0.1 to 1.1 (median of three to
// five; standard error 0.4). It grows by half a nat for each searched parameter towards the tail, where decisions fall.
double LinkCauseDomain::charge_of(const CauseShape& shape, const inference::Candidate& c) const {
  if (stands(c) && shape.place == PlaceShape::segment) return thresholds::wall_charge;
  if (stands(c)) return thresholds::thing_charge + (geometry_.is_outdoors() ? thresholds::outdoor_charge : 0);
  if (shape.cause.meaning().kind == MUSTER_WORLD_EDIT) return 0;
  if (given_sizes(shape) > 0) return thresholds::given_place_charge;
  return shape.place != PlaceShape::none ? thresholds::place_charge : thresholds::shape_charge;
}

std::vector<VectorXd> LinkCauseDomain::starts_of(const CauseShape& shape, const inference::Candidate& c) const {
  return diagnosis::starts_of(shape, geometry_, model_, stands(c));
}

bool LinkCauseDomain::admits(const CauseShape& shape, const inference::Candidate& c, const VectorXd& theta) const {
  return !stands(c) || clear_of_ways(shape, geometry_, theta);
}

// Prior: a radio lies within a few metres of its mapped place, in the plan's scale, or, by a blunder, anywhere in the
// area. Displacements within the accuracy of map and mount are excluded. In a smooth field, millimetres that move links
// past the end of a wall would be significant.
void LinkCauseDomain::believe_in_map(const CauseShape& shape, inference::Candidate& c) const {
  std::vector<Eigen::Vector2d> mapped;
  for (const CauseRow& row : shape.rows)
    mapped.push_back(place_of_radio(model_, row.at(0)).value_or(Eigen::Vector2d(0, 0)));
  const auto moved = [mapped = std::move(mapped)](const VectorXd& t) {
    return (t.segment<2>(1) - mapped[static_cast<std::size_t>(t[0])]).norm();
  };
  const double area = std::max(geometry_.east.length() * geometry_.north.length(), 1.0),
               share = thresholds::blunder_share, spread = geometry_.scale * thresholds::misplaced_spread;
  const double anywhere = share / (1 - share) * 2 * M_PI * std::pow(spread, 2) / area;
  c.refinement.belief = [moved, anywhere, spread](const VectorXd& t) {
    const double near = std::exp(-std::pow(moved(t) / spread, 2) / 2);
    return std::log((near + anywhere) / (1 + anywhere));
  };
  c.refinement.admitted = [moved](const VectorXd& t) { return moved(t) < thresholds::same_place ? 0.0 : 1.0; };
}

// Proposes walls and obstacles by a scan of all possible places, in units of the plan's scale.
void LinkCauseDomain::let_scan(const CauseShape& shape, inference::Candidate& c) const {
  const bool wall = shape.place == PlaceShape::segment && !shape.is_strip();
  if (!wall && !(shape.place == PlaceShape::point && shape.axes.size() == 1)) return;
  const auto link = [&](Index reading) -> std::array<double, 4> {
    const auto& [a, b] = model_.ends()[static_cast<std::size_t>(used_[static_cast<std::size_t>(reading)])];
    const double unit = geometry_.scale;
    return {a.x / unit, a.y / unit, b.x / unit, b.y / unit};
  };
  const MeasurementGeometry own = in_own_unit(geometry_);
  const auto in_metres = [place = shape.place, unit = geometry_.scale](std::vector<VectorXd> thetas) {
    for (VectorXd& theta : thetas) theta = in_unit(place, std::move(theta), 1 / unit);
    return thetas;
  };
  // What stands in the way is in the way of both twins: their differences are links without length, which meet nothing.
  constexpr std::array<double, 4> nowhere{};
  Links links;
  for (Index row = 0; row < rows_.size(); ++row)
    links.push_back(rows_.is_difference(row) ? nowhere : link(rows_.middle(row)));
  if (wall) {
    ReadingLinks readings;
    for (const Index reading : rows_.in_order()) {
      const auto row = static_cast<std::size_t>(rows_.row_of()[static_cast<std::size_t>(reading)]);
      if (readings.first.size() == row) readings.first.push_back(readings.links.size());
      readings.links.push_back(link(reading));
    }
    for (Index row = rows_.means(); row < rows_.size(); ++row) {
      readings.first.push_back(readings.links.size());
      readings.links.push_back(nowhere);
    }
    readings.first.push_back(readings.links.size());
    c.refinement.proposed = [sweep = std::make_shared<const SegmentScan>(own, std::move(links), std::move(readings)),
                             in_metres, first = c.design.grid[0]](inference::Tally& tally) {
      return shaped_as(first, in_metres((*sweep)(tally)));
    };
  } else {
    // Maxima are narrow and close together.
    c.refinement.step.tail<3>() << 0.1 * geometry_.scale, 0.1 * geometry_.scale, 0.1;
    c.refinement.proposed = [sweep = std::make_shared<const DiskScan>(own, std::move(links)),
                             in_metres](inference::Tally& tally) { return in_metres((*sweep)(tally)); };
  }
}

void LinkCauseDomain::finish(const std::shared_ptr<const CauseShape>& shape, inference::Candidate& c) const {
  if (shape->cause.meaning().kind == MUSTER_WORLD_EDIT && shape->place == PlaceShape::point) believe_in_map(*shape, c);
  if (!stands(c)) return;
  inference::Refinement& r = c.refinement;
  r.admitted = [shape, geometry = geometry_](const VectorXd& t) {
    if (shape->place == PlaceShape::point)
      return clear_of_ways(*shape, geometry, t) ? 1.0 : thresholds::driven_through_share;
    return std::pow(thresholds::driven_across_share, std::min(driven_across(geometry, t[1], t[2], t[3], t[4]), 10));
  };
  if (r.any()) let_scan(*shape, c);
  if (shape->place == PlaceShape::point && shape->axes.size() == 1)
    r.moves = [own = in_own_unit(geometry_), unit = geometry_.scale](const VectorXd& t) {
      Eigen::MatrixXd moves = moves_of_disk(own, in_unit(PlaceShape::point, t, unit));
      moves.middleRows(1, 2) *= unit;
      return moves;
    };
  if (shape->place != PlaceShape::segment) return;
  r.moves = [own = in_own_unit(geometry_), unit = geometry_.scale](const VectorXd& t) {
    Eigen::MatrixXd moves = moves_of_segment(own, in_unit(PlaceShape::segment, t, unit));
    moves.middleRows(1, 3) *= unit;
    return moves;
  };
  r.belief = [geometry = geometry_](const VectorXd& t) { return belief_in_segment(geometry, t); };
  c.role.spanning = [id = c.id, first = c.design.grid[0]](const std::vector<inference::Piece>& pieces) {
    return shaped_as(first, spans(pieces, id));
  };
}

}  // namespace muster::diagnosis
