#include "diagnosis/found_cause.hpp"

#include <algorithm>
#include <cmath>

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double normal95 = 1.96;
constexpr double fall95 = 3.84;  // of the deviance, chi-squared with one degree of freedom

const muster_param& declared(const CauseShape& shape, const std::string& name) {
  const muster_plugin& plugin = *shape.cause.plugin;
  return *std::find_if(plugin.params, plugin.params + plugin.param_count,
                       [&](const muster_param& p) { return p.name == name; });
}

CauseValue value_of(const muster_param& p, double value, double below, double above) {
  const double at = std::clamp(value, p.min, p.max);
  return {p.name, p.unit, at, (below + above) / (2 * normal95), at - below, at + above, p.min, p.max};
}

// How far an entry of theta moves, the others held, until the deviance that the term takes away falls by 3.84.
double reach(const search::Candidate& c, const VectorXd& theta, Index entry, double direction,
             const std::function<double(const VectorXd&)>& gain) {
  const double least = gain(theta) - fall95;
  const double room = direction > 0 ? c.upper[entry] - theta[entry] : theta[entry] - c.lower[entry];
  double inside = 0, outside = std::min(c.step[entry] / 8, room);
  const auto at = [&](double way) {
    VectorXd moved = theta;
    moved[entry] += direction * way;
    return gain(moved);
  };
  while (outside < room && at(outside) > least) {
    inside = outside;
    outside = std::min(2 * outside, room);
  }
  for (int k = 0; k < 4; ++k) {
    const double middle = (inside + outside) / 2;
    (at(middle) > least ? inside : outside) = middle;
  }
  return outside;
}

struct Reach {
  double below = 0, above = 0;  // squares
};

// Of the sought parameters: the reaches of all entries of theta, added in squares.
std::map<std::string, Reach> reaches(const CauseShape& shape, const search::Candidate& c, const VectorXd& theta,
                                     const search::Bench& bench, const search::Term& term) {
  std::map<std::string, Reach> result;
  const search::Stand stand = bench.stand(bench.design_without(term));
  const auto gain = [&](const VectorXd& t) {
    const Eigen::MatrixXd columns = bench.columns_of(c, t);
    return c.whole ? stand.gain_as_it_is(columns) : stand.gain(columns);
  };
  const auto middle = shape.parameters(theta);
  for (Index entry = 1; entry < c.step.size(); ++entry) {
    if (c.step[entry] == 0) continue;
    for (const double direction : {-1.0, 1.0}) {
      VectorXd moved = theta;
      moved[entry] += direction * reach(c, theta, entry, direction, gain);
      for (const auto& [name, value] : shape.parameters(moved)) {
        const double by = value - middle.at(name);
        (by < 0 ? result[name].below : result[name].above) += by * by;
      }
    }
  }
  return result;
}

void add_linear(FoundCause& out, const CauseShape& shape, const search::Finding& f) {
  if (shape.linear.empty()) {  // sought whole: a strength that it has was 1
    for (const muster_param* p : shape.cause.linear()) {
      const double half = normal95 * std::sqrt(f.uncertainty(0, 0));
      out.values.push_back(value_of(*p, f.coefficients[0], half, half));
    }
    return;
  }
  if (shape.wave.empty()) {
    for (std::size_t k = 0; k < shape.linear.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      const double half = normal95 * std::sqrt(f.uncertainty(at, at));
      out.values.push_back(value_of(*shape.linear[k], f.coefficients[at], half, half));
    }
    return;
  }
  const double size = f.coefficients.norm();
  const Eigen::Vector2d along = f.coefficients / size, across(-along.y(), along.x());
  const double half = normal95 * std::sqrt(along.dot(f.uncertainty * along));
  const double turn = normal95 * std::sqrt(across.dot(f.uncertainty * across)) / size;
  out.values.push_back(value_of(*shape.linear[0], size, half, half));
  out.values.push_back(value_of(declared(shape, shape.wave), std::atan2(along.y(), along.x()), turn, turn));
}

// The first reference is the row that it is about, further ones are attributes beside it.
void add_row(FoundCause& out, const CauseShape& shape, const VectorXd& theta) {
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

}  // namespace

FoundCause found_cause(const search::Finding& f, const CauseCandidate& cause, const search::Bench& bench,
                       const search::Term* term) {
  const CauseShape& shape = *cause.shape;
  FoundCause out;
  out.id = f.id;
  out.label = f.label;
  out.title = shape.cause.meaning().title;
  out.tell_apart = shape.cause.meaning().tell_apart;
  out.status = f.status;
  out.covariates = f.covariates;
  add_row(out, shape, f.theta);
  out.held = shape.held;
  out.evidence = f.evidence;
  out.log_p = f.log_p;
  out.lambda = f.gain;
  out.held_out = f.held_out;
  out.rivals = f.rivals;
  add_linear(out, shape, f);
  auto sure = term ? reaches(shape, cause.candidate, f.theta, bench, *term) : std::map<std::string, Reach>{};
  for (const auto& [name, value] : shape.parameters(f.theta)) {
    if (shape.held.count(name)) continue;
    out.values.push_back(
        value_of(declared(shape, name), value, std::sqrt(sure[name].below), std::sqrt(sure[name].above)));
  }
  return out;
}

}  // namespace muster::diagnosis
