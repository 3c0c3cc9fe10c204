#include "diagnosis/pipeline/cause_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/radio/causes/place_grid.hpp"
#include "diagnosis/radio/thresholds.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

CauseValue value_of(const muster_param& p, double value, double below, double above) {
  const double at = std::clamp(value, p.min, p.max), sd = (below + above) / (2 * thresholds::normal95);
  if (p.flags & MUSTER_CYCLIC)
    return {p.name, p.unit, at, sd, at - std::min(below, M_PI), at + std::min(above, M_PI), p.min, p.max, true};
  return {p.name,
          p.unit,
          at,
          sd,
          std::max(at - below, p.min),
          std::min(at + above, p.max),
          p.min,
          p.max,
          false,
          (p.flags & MUSTER_LOG) != 0};
}

struct Reach {
  double below = 0, above = 0;  // of a 95 % interval
};

bool is_moment_beside_pauses(const CauseShape& shape, const std::string& name) {
  return std::any_of(shape.axes.begin(), shape.axes.end(),
                     [&](const Axis& axis) { return axis.recorded && axis.parameter == name; });
}

// By quantiles: all of a pause is as likely, and it may be thousands of times as long as what lies beside it.
Reach reach_of_moment(const CauseShape& shape, const inference::Finding& f, const std::string& name, double middle) {
  std::vector<double> moments;
  for (const VectorXd& theta : f.thetas) moments.push_back(shape.parameters(theta).at(name));
  std::sort(moments.begin(), moments.end());
  const auto at = [&](double share) {
    return moments[static_cast<std::size_t>(std::lround(share * static_cast<double>(moments.size() - 1)))];
  };
  return {std::max(0.0, middle - at(0.025)), std::max(0.0, at(0.975) - middle)};
}

// 95 % half-widths of the searched parameters about the found theta, by the posterior samples on each parameter's
// scale.
std::map<std::string, Reach> reaches(const CauseShape& shape, const inference::Finding& f) {
  std::map<std::string, double> sum, squares;
  const auto middle = shape.parameters(f.theta);
  for (const VectorXd& theta : f.thetas) {
    for (const auto& [name, value] : shape.parameters(theta)) {
      const unsigned scale = shape.cause.parameter(name).flags;
      double by = scale & MUSTER_LOG ? std::log(value / middle.at(name)) : value - middle.at(name);
      if (scale & MUSTER_CYCLIC) by = std::remainder(by, 2 * M_PI);
      sum[name] += by;
      squares[name] += by * by;
    }
  }
  std::map<std::string, Reach> result;
  const auto count = static_cast<double>(f.thetas.size());
  for (const auto& [name, total] : sum) {
    constexpr double same = 1e-6;  // equal in all samples but for rounding, as a room's place
    const double mean = total / count, sd = std::sqrt(std::max(0.0, squares[name] / count - mean * mean));
    if (sd + std::abs(mean) < same) continue;
    Reach reach{std::max(0.0, thresholds::normal95 * sd - mean), std::max(0.0, thresholds::normal95 * sd + mean)};
    if (is_moment_beside_pauses(shape, name))
      reach = reach_of_moment(shape, f, name, middle.at(name));
    else if (shape.cause.parameter(name).flags & MUSTER_LOG)
      reach = {middle.at(name) * -std::expm1(-reach.below), middle.at(name) * std::expm1(reach.above)};
    result[name] = reach;
  }
  return result;
}

void add_linear(CauseEstimate& out, const CauseShape& shape, const inference::Finding& f) {
  if (shape.linear.empty()) {  // searched as a whole, with a strength of 1
    for (const muster_param* p : shape.cause.linear()) {
      const double half = thresholds::normal95 * std::sqrt(f.uncertainty(0, 0));
      out.values.push_back(value_of(*p, f.coefficients[0], half, half));
    }
    return;
  }
  if (shape.wave.empty()) {
    for (std::size_t k = 0; k < shape.linear.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      const double half = thresholds::normal95 * std::sqrt(f.uncertainty(at, at));
      out.values.push_back(value_of(*shape.linear[k], f.coefficients[at], half, half));
    }
    return;
  }
  const double size = f.coefficients.norm();
  const Eigen::Vector2d along = f.coefficients / size, across(-along.y(), along.x());
  const double half = thresholds::normal95 * std::sqrt(along.dot(f.uncertainty * along));
  const double turn = thresholds::normal95 * std::sqrt(across.dot(f.uncertainty * across)) / size;
  out.values.push_back(value_of(*shape.linear[0], size, half, half));
  out.values.push_back(value_of(shape.cause.parameter(shape.wave), std::atan2(along.y(), along.x()), turn, turn));
}

// The first reference is the cause's row; further ones are attributes.
void add_row(CauseEstimate& out, const CauseShape& shape, const VectorXd& theta) {
  const auto references = shape.cause.rows();
  for (std::size_t k = 0; k < references.size(); ++k) {
    const std::string& name = shape.row(theta)[k];
    if (name.empty()) continue;
    if (k > 0) {
      out.words[references[k]->name] = name;
      continue;
    }
    out.row_parameter = references[k]->name;
    out.row = name;
  }
}

// Removes slots of parameters without a value from a title, such as powers that no reading has.
std::string with_values(std::string title, const Cause& cause, const std::vector<CauseValue>& values) {
  for (uint32_t i = 0; i < cause.plugin->param_count; ++i) {
    if (cause.plugin->params[i].kind != MUSTER_REAL) continue;
    const std::string name = cause.plugin->params[i].name, slot = '{' + name + '}';
    if (std::any_of(values.begin(), values.end(), [&](const CauseValue& v) { return v.name == name; })) continue;
    for (const std::string& listed : {slot + ", ", ", " + slot}) {
      if (const auto at = title.find(listed); at != title.npos) title.erase(at, listed.size());
    }
  }
  return title;
}

}  // namespace

CauseEstimate cause_estimate(const inference::Finding& f, const CauseCandidate& cause) {
  const CauseShape& shape = *cause.shape;
  CauseEstimate out;
  out.id = out.sought_as = f.id;
  out.label = f.label;
  out.tell_apart = shape.cause.meaning().tell_apart;
  out.status = f.status;
  out.covariates = f.covariates;
  add_row(out, shape, f.theta);
  out.held = shape.held;
  out.evidence = f.evidence;
  out.log_p = f.log_p;
  out.inflation = f.inflation;
  out.lambda = f.gain;
  out.held_out = f.held_out;
  out.unseen_without = f.unseen_without;
  out.elsewhere = f.elsewhere;
  out.alternatives = f.alternatives;
  add_linear(out, shape, f);
  auto sure = reaches(shape, f);
  for (const auto& [name, value] : shape.parameters(f.theta)) {
    if (!shape.held.count(name))
      out.values.push_back(value_of(shape.cause.parameter(name), value, sure[name].below, sure[name].above));
  }
  out.title = with_values(shape.cause.meaning().title, shape.cause, out.values);
  return out;
}

namespace {

// Its distance from a bound, as a share of its range.
double from_bound(const CauseValue& v, double bound) {
  return v.by_ratio ? std::log(v.value / bound) / std::log(v.maximum / v.minimum)
                    : (v.value - bound) / (v.maximum - v.minimum);
}

}  // namespace

std::string doubt_at_own_bound(const CauseEstimate& cause) {
  for (const CauseValue& v : cause.values) {
    const bool is_strength = v.unit == "dB" || v.unit.empty();
    const double bound = from_bound(v, v.minimum) < -from_bound(v, v.maximum) ? v.minimum : v.maximum;
    // Of two at least, and two is as good.
    const bool is_count = v.unit.empty() && bound == v.minimum && bound > 1 && bound == std::floor(bound);
    if (!is_strength || is_count || bound == 0 || (v.unit.empty() && bound == 1)) continue;
    if (std::abs(from_bound(v, bound)) <= thresholds::at_bound)
      return fmt::format("its {} ends at the bound of {}, so that something else may do this", v.name,
                         print_real(bound) + (v.unit.empty() ? "" : ' ' + v.unit));
  }
  return "";
}

std::string doubt_by_map(const CauseShape& shape, const CauseEstimate& cause, const LinkModel& model) {
  if (shape.cause.meaning().kind != MUSTER_WORLD_EDIT || shape.place != PlaceShape::point) return "";
  const auto mapped = place_of_radio(model, cause.row);
  if (!mapped) return "";
  for (std::size_t k = 0; k < shape.coordinates.size(); ++k) {
    const double at = (*mapped)[static_cast<Index>(k)];
    const bool holds = std::any_of(cause.values.begin(), cause.values.end(), [&](const CauseValue& v) {
      return v.name == shape.coordinates[k] && v.lower95 <= at && at <= v.upper95;
    });
    if (!holds) return "";
  }
  return fmt::format("the place on the map, ({:.2f} m, {:.2f} m), lies within the intervals of the fitted one",
                     (*mapped)[0], (*mapped)[1]);
}

}  // namespace muster::diagnosis
