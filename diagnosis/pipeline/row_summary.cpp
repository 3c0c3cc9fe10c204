#include "diagnosis/pipeline/row_summary.hpp"

#include <algorithm>
#include <cmath>
#include <muster/tables.hpp>

#include "diagnosis/inference/assess/coefficient_covariance.hpp"
#include "diagnosis/inference/noise/exact_covariance.hpp"
#include "diagnosis/radio/links/moving_end.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd mean_of(const noise::Rows& rows, const std::vector<double>& values) {
  if (values.empty()) return {};
  return rows.by_stream(rows.mean(Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()))));
}

// Value at each row's first reading, for angles: a mean fails at the wrap-around, and rows end before readings turn
// far.
VectorXd first_of(const noise::Rows& rows, const Eigen::Ref<const VectorXd>& values) {
  if (values.size() == 0) return {};
  VectorXd result(rows.size());
  for (Index i = 0; i < rows.size(); ++i) result[i] = values[rows.example(i)];
  return result;
}

VectorXd left_by(const inference::ModelState& state, const Eigen::MatrixXd& design,
                 const inference::WhitenedModel& model) {
  return state.rows().by_stream(state.left_by(design, model));
}

std::vector<MappedWall> mapped_walls(const Simulation& run) {
  std::vector<MappedWall> out;
  const Table* table = run.board().find("wall/*/shape");
  if (!table) return out;
  const auto& walls = run.board().find_set("wall")->names;
  const Set* materials = run.board().find_set("material");
  for (std::size_t i = 0; i < table->now().rows; ++i) {
    const Wall& w = reinterpret_cast<const Wall*>(table->now().data.data())[i];
    out.push_back(
        {walls.at(i), materials->names.at(static_cast<std::size_t>(w.material)), w.x0, w.y0, w.x1, w.y1, w.thickness});
  }
  return out;
}

// Mean over readings. Where the world states its field, that of a short link may be smaller. A censored reading misses
// its bound by nothing, as at left-out places.
double noise_variance(const inference::ModelState& state, const Eigen::MatrixXd& design,
                      const inference::WhitenedModel& model) {
  const VectorXd& count = state.rows().count();
  const VectorXd of_field = state.rows().by_stream(noise::field_variances(state.field(), state.fit.covariance));
  const double variance = of_field.dot(count) / count.sum() + state.fit.covariance.reading_variance() -
                          inference::taken_up_by_fit(state, design, model);
  const auto& known = state.problem().bounds.known;
  const auto values = std::count(known.begin(), known.end(), noise::Known::value);
  const double share = known.empty() ? 1 : static_cast<double>(values) / static_cast<double>(known.size());
  return std::max(0.0, share * variance);
}

}  // namespace

VectorXd white_by_stream(const noise::Rows& rows, const VectorXd& white) {
  VectorXd result = rows.by_stream(white);
  for (Index i = rows.means(); i < rows.size(); ++i) result[i] /= std::sqrt(2);
  for (const Index i : rows.with_twins()) result[i] /= std::sqrt(2);
  return result;
}

RowSummary row_summary(const inference::ModelState& state, const LinkLayout& layout, const LinkColumns& columns,
                       const LinkModel& model) {
  const LinkReadings& readings = layout.readings();
  const noise::Rows& rows = state.rows();
  RowSummary out;
  int radios = 0;
  for (Index i = 0; i < rows.size(); ++i) {
    const auto reading = static_cast<std::size_t>(rows.example(i));
    out.tx.push_back(readings.tx[reading]);
    out.rx.push_back(readings.rx[reading]);
    radios = std::max({radios, out.tx.back() + 1, out.rx.back() + 1});
  }
  for (int k = 0; k < radios; ++k) out.radios.push_back(model.radio_name(k));
  out.tx_at = rows.by_stream(rows.mean(readings.tx_at.transpose())).transpose();
  out.rx_at = rows.by_stream(rows.mean(readings.rx_at.transpose())).transpose();
  out.count = rows.count();
  out.t = mean_of(rows, readings.t);
  out.tx_yaw =
      first_of(rows, Eigen::Map<const VectorXd>(readings.tx_yaw.data(), static_cast<Index>(readings.tx_yaw.size())));
  out.rx_yaw =
      first_of(rows, Eigen::Map<const VectorXd>(readings.rx_yaw.data(), static_cast<Index>(readings.rx_yaw.size())));
  if (const MovingEnds moving = moving_ends(readings); moving.headings_known()) {
    out.heading = first_of(rows, moving.heading);
    out.bearing = first_of(rows, moving.bearing);
  }
  const Eigen::MatrixXd full = state.design();
  const inference::WhitenedModel before = state.whitened_model(state.base()), after = state.whitened_model(full);
  out.before = left_by(state, state.base(), before);
  out.after = left_by(state, full, after);
  out.noise_variance = noise_variance(state, full, after);
  out.white_before = white_by_stream(rows, before.at.residual);
  out.white_after = white_by_stream(rows, after.at.residual);
  for (const inference::Covariate& c : columns.covariates) {
    out.columns.push_back(c);
    out.columns.back().values = rows.by_stream(rows.mean(c.values));
  }
  for (const inference::Factor& f : columns.factors) {
    out.factors.push_back({f.name, {}});
    for (Index i = 0; i < rows.size(); ++i)
      out.factors.back().level.push_back(f.level[static_cast<std::size_t>(rows.example(i))]);
  }
  out.walls = mapped_walls(model.simulation());
  out.places_known = layout.sites_known();
  return out;
}

VectorXd effect_of(const inference::ModelState& state, const inference::Candidate& candidate,
                   const inference::Finding& finding) {
  return state.rows().by_stream(state.columns_of(candidate, finding.theta) * finding.coefficients);
}

std::vector<WorldValue> world_values(const inference::ModelState& state, const std::vector<std::string>& paths,
                                     const VectorXd& values, const LinkModel& model) {
  const Eigen::MatrixXd spread = inference::coefficient_covariance(state, state.design());
  std::vector<WorldValue> out;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const auto at = static_cast<Index>(k);
    const muster_param* declared = model.parameter(paths[k]).declared;
    out.push_back({paths[k], declared ? declared->unit : "", values[at], std::sqrt(spread(at, at))});
  }
  return out;
}

}  // namespace muster::diagnosis
