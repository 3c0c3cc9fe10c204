#include "diagnosis/search/stated_look.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/search/integrated.hpp"

namespace muster::search {
namespace {

// With the stated size and distance, each of these families; those that are much less likely than the best are left
// out.
std::vector<noise::Fit> fitted_as_stated(const Bench& bench, const Eigen::MatrixXd& design,
                                         const std::vector<noise::Family>& families) {
  constexpr double likely = 3;  // nats
  std::vector<noise::Fit> fits;
  for (const noise::Family family : families) {
    const auto start = as_stated(bench.problem().stated, family, bench.fit.covariance.theta);
    fits.push_back(noise::fit(bench.field(), bench.y(), design, bench.options().prior, start, 6, noise::unstated));
  }
  std::sort(fits.begin(), fits.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  std::erase_if(fits, [&](const noise::Fit& fit) { return fit.value > fits[0].value + likely; });
  return fits;
}

// The family of the fit and those that lay near it at first.
std::vector<noise::Family> likely_families(const Bench& bench) {
  constexpr double likely = 3;  // nats
  std::vector<noise::Family> result{bench.fit.covariance.family};
  for (const noise::Fit& first : bench.families) {
    if (first.covariance.family != result[0] && first.value < bench.families[0].value + likely)
      result.push_back(first.covariance.family);
  }
  return result;
}

// Whether the stated field, with the lead in the model, is as likely as the best one: both its numbers together are
// within what 99 % of fits err by.
bool stands_as_stated(const Bench& bench, const Eigen::MatrixXd& both, const noise::Fit& stated) {
  constexpr double within = 4.6;  // nats
  double best =
      std::min(bench.fitted(both, bench.fit.covariance, 6).value, bench.fitted(both, stated.covariance, 6).value);
  return stated.value <= best + within;
}

}  // namespace

std::optional<Lead> stated_look(Bench& bench, const std::function<bool(const Candidate&)>& usable) {
  if (bench.problem().stated.shadowing <= 0 || bench.problem().bounds.any()) return {};
  constexpr int looked_at = 3;
  const double threshold = bench.threshold() - std::log(2.0);  // a second chance
  const Eigen::MatrixXd design = bench.design();
  const std::vector<noise::Family> families = likely_families(bench);
  const Stand alone = bench.stand(design, fitted_as_stated(bench, design, families)[0].covariance);
  std::vector<Lead> passing;
  for (const Entry& entry : bench.entries()) {
    const Candidate& c = *entry.candidate;
    if (!(c.slow || c.kind == Kind::smooth) || !usable(c)) continue;
    Index at = 0;
    const double gain = gains(c, unit_atoms(entry, alone), alone.at.residual).maxCoeff(&at);
    Lead lead{&entry,
              c.grid[static_cast<std::size_t>(at)],
              entry.atom(at),
              gain,
              bench.evidence(c, gain, c.width, false),
              bench.log_p(c, gain, c.width, false),
              false,
              {}};
    if (lead.log_p < threshold) passing.push_back(std::move(lead));
  }
  std::stable_sort(passing.begin(), passing.end(), [](const Lead& a, const Lead& b) { return a.log_p < b.log_p; });
  passing.resize(std::min<std::size_t>(passing.size(), looked_at), passing.empty() ? Lead{} : passing[0]);
  for (Lead& lead : passing) {
    const Candidate& c = lead.candidate();
    const Eigen::MatrixXd both = beside(design, lead.columns);
    const std::vector<noise::Fit> fits = fitted_as_stated(bench, both, families);
    // Few near neighbours overstate what is slow, and which family it is nobody says.
    for (std::size_t k = 0; k < fits.size(); ++k) {
      const Stand stand = bench.stand(design, fits[k].covariance);
      const double gain =
          std::min(gain_of(c, stand, lead.columns), bench.far_gain(design, lead.columns, fits[k].covariance));
      const double log_p = bench.log_p(c, gain, c.width, false) + stand.skew_charge(lead.columns);
      lead.gain = k == 0 ? gain : std::min(lead.gain, gain);
      lead.log_p = k == 0 ? log_p : std::max(lead.log_p, log_p);
    }
    if (lead.log_p < threshold && stands_as_stated(bench, both, fits[0])) return lead;
  }
  return {};
}

}  // namespace muster::search
