#include "diagnosis/causes/cause_candidates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "diagnosis/causes/strength_selection.hpp"
#include "diagnosis/causes/thresholds.hpp"
#include "diagnosis/inference/noise/basis.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double quarter_turn = 1.5707963267948966;

void find_place(CauseShape& shape) {
  for (uint32_t k = 0; k < shape.cause.plugin->param_count; ++k) {
    const muster_param& p = shape.cause.plugin->params[k];
    if (p.flags & (MUSTER_EAST | MUSTER_NORTH)) shape.coordinates.push_back(p.name);
  }
  if (shape.coordinates.size() == 2) shape.place = PlaceShape::point;
  if (shape.coordinates.size() == 4) shape.place = PlaceShape::segment;
}

// True if the effect is sinusoidal in the cyclic parameter: two quadrature columns then span all directions. With times
// since 1970 a period of a minute turns by 2e8 rad, whose last digit is 3e-8.
bool is_wave(const CauseSources& sources, const CauseShape& shape, const std::string& parameter) {
  auto others = shape.held;
  const auto at = [&](double angle) {
    others[parameter] = angle;
    VectorXd column(static_cast<Index>(sources.used.size()));
    sources.run->fill(shape.cause, shape.rows, 0, others, sources.used, column);
    return column;
  };
  constexpr double rounding = 1e-6;
  const VectorXd zero = at(0), quarter = at(quarter_turn), one = at(1);
  return zero.norm() > 0 && (std::cos(1) * zero + std::sin(1) * quarter - one).norm() < rounding * zero.norm();
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

// Thins the start values of all axes but the longest, until their products are few: refinement does the rest.
void thin_out(std::vector<Axis>& axes) {
  const auto shorter = [](const Axis& a, const Axis& b) { return a.values.size() < b.values.size(); };
  const auto starts = [&] {
    std::size_t product = 1;
    for (const Axis& axis : axes) product *= axis.values.size();
    return product;
  };
  while (axes.size() > 1 && starts() > thresholds::most_starts) {
    const auto longest = std::max_element(axes.begin(), axes.end(), shorter);
    Axis* next = nullptr;
    for (Axis& axis : axes) {
      if (&axis != &*longest && axis.values.size() > 1 && (!next || shorter(*next, axis))) next = &axis;
    }
    if (!next) return;
    std::vector<double> kept;  // every other one, the middle of three
    for (std::size_t k = 1; k < next->values.size(); k += 2) kept.push_back(next->values[k]);
    next->values = std::move(kept);
  }
}

// False if the data cannot identify one of its parameters.
bool find_axes(CauseShape& shape, const CauseSources& sources, const CauseDomain& domain) {
  domain.hold(shape);
  auto parameters = sought(shape.cause);
  std::erase_if(parameters, [&](const muster_param* p) { return shape.held.count(p->name) > 0; });
  for (const muster_param* p : parameters) {
    if ((p->flags & MUSTER_CYCLIC) && shape.wave.empty() && is_wave(sources, shape, p->name)) shape.wave = p->name;
  }
  std::erase_if(parameters, [&](const muster_param* p) { return p->name == shape.wave; });
  for (const muster_param* p : parameters) {
    const auto axis = domain.axis_of(*p, shape, parameters.size() == 1);
    if (!axis) return false;
    shape.axes.push_back(*axis);
  }
  thin_out(shape.axes);
  return true;
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
      if (shape->one_of_several()) shape->set_one(static_cast<std::size_t>(j), parameters);
      run->fill(shape->cause, shape->rows, row, parameters, used, result.col(j));
    }
    return result;
  };
}

struct CandidateBuilder {
  const CauseDomain& domain;
  const CauseSources& sources;
  const BaseSpace base;
  const noise::Rows& rows;

  void bound(const CauseShape& shape, inference::Refinement& r) const {
    const Index places = place_entries(shape.place), n = 1 + places + static_cast<Index>(shape.axes.size());
    r.lower = r.upper = r.step = VectorXd::Zero(n);
    r.upper[0] = static_cast<double>(shape.rows.size());
    for (std::size_t k = 0; k < shape.axes.size(); ++k) {
      const Index at = 1 + places + static_cast<Index>(k);
      r.lower[at] = shape.axes[k].lower;
      r.upper[at] = shape.axes[k].upper;
      r.step[at] = shape.axes[k].step;
    }
    domain.bound_place(shape, r);
  }

  static void identify(const CauseShape& shape, inference::Candidate& c) {
    c.id = shape.cause.id;
    c.design.width = static_cast<int>(shape.columns());
    // A term with searched parameters but no strength takes its size from the terms fitted beside it.
    const bool edit = shape.cause.meaning().kind == MUSTER_WORLD_EDIT;
    c.design.whole = shape.linear.empty() && (edit || shape.axes.empty());
    c.design.sign = shape.linear.empty() || (c.design.width == 1 && shape.linear[0]->min == 0) ? 1 : 0;
    c.role.parameters = static_cast<int>(shape.cause.plugin->param_count + shape.axes.size());
    // What an instrument makes of its readings is asked for where no law of what it measures does as well.
    if (shape.cause.meaning().kind == MUSTER_STAGE) ++c.role.parameters;
  }

  static void label(const std::shared_ptr<const CauseShape>& shape, inference::Candidate& c) {
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

  void grid(const CauseShape& shape, inference::Candidate& c) const {
    std::vector<Eigen::MatrixXf> atoms;
    for (const VectorXd& theta : domain.starts_of(shape, c)) {
      if (!domain.admits(shape, c, theta)) continue;
      const Eigen::MatrixXd columns = c.design.columns(theta);
      const double share = (columns.array() != 0).cast<double>().mean();
      if (share < (shape.place == PlaceShape::none ? 0 : thresholds::least_concern) || !base.leaves(columns.col(0)))
        continue;
      c.design.grid.push_back(theta);
      atoms.push_back(rows.mean(columns).cast<float>());
    }
    noise::Sheet together(rows.size(), c.design.width * static_cast<Index>(atoms.size()));
    for (std::size_t k = 0; k < atoms.size(); ++k)
      together.middleCols(c.design.width * static_cast<Index>(k), c.design.width) = atoms[k];
    c.design.atoms = std::make_shared<const noise::Sheet>(std::move(together));
  }
};

// Atoms of one shape, of the rows that have one there.
using AtomsOfRows = std::map<std::size_t, Index>;

std::vector<AtomsOfRows> by_shape(const inference::Candidate& c) {
  std::vector<AtomsOfRows> result;
  const auto shape_of = [](const VectorXd& theta) { return theta.tail(theta.size() - 1); };
  for (std::size_t k = 0; k < c.design.grid.size(); ++k) {
    const VectorXd& theta = c.design.grid[k];
    if (k == 0 || shape_of(theta) != shape_of(c.design.grid[k - 1])) result.emplace_back();
    result.back()[static_cast<std::size_t>(theta[0])] = static_cast<Index>(k);
  }
  return result;
}

// True if both rows have the same columns at all shapes.
bool are_twins(std::size_t one, std::size_t other, const std::vector<AtomsOfRows>& shapes,
               const inference::Candidate& c) {
  const auto columns = [&](Index atom) { return c.design.atoms->middleCols(atom * c.design.width, c.design.width); };
  return std::all_of(shapes.begin(), shapes.end(), [&](const AtomsOfRows& atoms) {
    const auto a = atoms.find(one), b = atoms.find(other);
    if (a == atoms.end() || b == atoms.end()) return a == b;
    return columns(a->second) == columns(b->second);
  });
}

// Leaves out rows that do what an earlier one does, as all readings are those of the only receiver.
void leave_out_twins(CauseShape& shape, inference::Candidate& c) {
  const std::vector<AtomsOfRows> shapes = by_shape(c);
  std::vector<CauseRow> rows;
  std::map<double, double> number;  // of the rows that are kept, before and after
  for (std::size_t row = 0; row < shape.rows.size(); ++row) {
    const auto is_twin = [&](const auto& kept) {
      return are_twins(static_cast<std::size_t>(kept.first), row, shapes, c);
    };
    if (std::any_of(number.begin(), number.end(), is_twin)) continue;
    number[static_cast<double>(row)] = static_cast<double>(rows.size());
    rows.push_back(shape.rows[row]);
  }
  if (rows.size() == shape.rows.size()) return;
  std::vector<VectorXd> grid;
  std::vector<Index> kept;
  for (std::size_t k = 0; k < c.design.grid.size(); ++k) {
    VectorXd theta = c.design.grid[k];
    const auto row = number.find(theta[0]);
    if (row == number.end()) continue;
    theta[0] = row->second;
    grid.push_back(std::move(theta));
    for (Index j = 0; j < c.design.width; ++j) kept.push_back(static_cast<Index>(k) * c.design.width + j);
  }
  noise::Sheet atoms = (*c.design.atoms)(Eigen::all, kept);
  c.design.atoms = std::make_shared<const noise::Sheet>(std::move(atoms));
  c.design.grid = std::move(grid);
  c.refinement.upper[0] = static_cast<double>(rows.size());
  shape.rows = std::move(rows);
}

// Returns the reason why there is no candidate; empty if there is one.
std::string build(const Cause& cause, const CandidateBuilder& builder, CauseSearch& out) {
  const CauseSources& s = builder.sources;
  const CauseDomain& domain = builder.domain;
  if (std::string why = domain.why_not(cause); !why.empty()) return why;
  auto shape = std::make_shared<CauseShape>();
  shape->cause = cause;
  shape->rows = domain.rows_for(cause);
  if (shape->rows.empty()) return domain.why_no_rows(cause);
  find_place(*shape);
  if (!find_axes(*shape, s, domain)) return "not testable: what it depends on does not vary";
  choose_strengths(*shape, s, builder.base);
  if (shape->linear.empty() && !cause.linear().empty())
    return "not testable: no reading depends on it, or the base model takes it up";
  // A share of a mapped object is held at 1: any other share is another strength of the object.
  if (shape->linear.size() == 1 && is_share(*shape->linear[0])) shape->linear.clear();
  inference::Candidate c;
  if (shape->place != PlaceShape::none || !shape->axes.empty()) builder.bound(*shape, c.refinement);
  CandidateBuilder::identify(*shape, c);
  domain.describe(*shape, c);
  CandidateBuilder::label(shape, c);
  c.design.columns = columns_at(shape, s.run, s.used);
  builder.grid(*shape, c);
  if (c.design.grid.empty()) return "not testable: no reading depends on it, or the base model takes it up";
  // Rows of a cause without axes are also looked up by their number, be they in the grid or not.
  if (shape->place == PlaceShape::none && !shape->axes.empty()) leave_out_twins(*shape, c);
  domain.finish(shape, c);
  out.found.push_back({shape, std::move(c)});
  return "";
}

// Builds a candidate. An Error, of a cause that cannot run in this world or with this table, becomes the reason.
std::string built(const Cause& cause, const CandidateBuilder& builder, CauseSearch& out) {
  try {
    return build(cause, builder, out);
  } catch (const Error& error) {
    builder.sources.run->clear();
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
  return !cause.needs_own_world() && kind != MUSTER_LAW && !(kind == MUSTER_STAGE && cause.linear().empty());
}

CauseSearch cause_candidates(const std::vector<Cause>& causes, const CauseDomain& domain, const CauseSources& sources,
                             const Eigen::MatrixXd& base, const noise::Rows& rows) {
  CauseSearch result;
  const CandidateBuilder builder{domain, sources, BaseSpace(base), rows};
  for (const Cause& cause : causes) {
    if (!shifts_levels(cause)) continue;
    const std::string why = built(cause, builder, result);
    if (!why.empty()) result.not_tested.push_back(cause.id + ": " + why);
  }
  return result;
}

}  // namespace muster::diagnosis
