#include "diagnosis/pipeline/exchanged_identity.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/pipeline/own_world_hypotheses.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Rows of the table: what was heard of those of the search that the radio sends or receives.
std::vector<Index> rows_of(const std::string& radio, const DiagnosisSetup& setup) {
  const LinkReadings& r = setup.layout->readings();
  std::vector<Index> result;
  for (std::size_t i = 0; i < setup.used.rows.size(); ++i) {
    const Index row = setup.used.rows[i];
    if (std::isfinite(setup.data.rssi[static_cast<std::size_t>(row)]) &&
        (setup.model.radio_name(r.tx[i]) == radio || setup.model.radio_name(r.rx[i]) == radio))
      result.push_back(row);
  }
  return result;
}

double variance(const VectorXd& values) { return (values.array() - values.mean()).square().mean(); }

}  // namespace

std::optional<CauseEstimate> exchange_instead_of(const CauseEstimate& finding, DiagnosisSetup& setup,
                                                 const Diagnosis& found) {
  if (finding.row.empty()) return {};
  const std::vector<Index> rows = rows_of(finding.row, setup);
  if (rows.empty()) return {};
  VectorXd measured(static_cast<Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    measured[static_cast<Index>(i)] = setup.data.rssi[static_cast<std::size_t>(rows[i])];
  ParameterGuard fitted(setup.model);
  for (const auto& [path, value] : found.parameters) fitted.set(path, value);
  double least = thresholds::exchange_alike * variance(measured - found.mean(rows));
  std::optional<CauseEstimate> result;
  for (const Hypothesis& h : hypotheses_of(setup, found).all) {
    if (h.cause->needs_own_world() || h.cause->id == finding.id ||
        std::find(h.row.begin(), h.row.end(), finding.row) == h.row.end())
      continue;
    const Supposed supposed(setup.model, h);
    const double left = variance(measured - setup.model.expected()(rows));
    if (!(left < least)) continue;
    least = left;
    result = stated(h, {});
  }
  if (!result) return {};
  // It needs no numbers, and explains what the finding explains: it is as likely at least.
  result->evidence = finding.evidence;
  result->log_p = finding.log_p;
  result->lambda = finding.lambda;
  result->unseen_without = finding.unseen_without;
  return result;
}

}  // namespace muster::diagnosis
