#include "diagnosis/pipeline/cause_self_test.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include "diagnosis/inference/score/candidate_scores.hpp"
#include "diagnosis/pipeline/cause_estimate.hpp"
#include "diagnosis/pipeline/extended_world.hpp"
#include "diagnosis/pipeline/setup.hpp"
#include "diagnosis/radio/thresholds.hpp"
#include "muster/random.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int tries = 200;

// Place and strength of a hidden cause.
struct Hidden {
  VectorXd theta, coefficients;
  double lambda = 0;
};

bool within_bounds(const CauseShape& shape, const Hidden& hidden) {
  for (std::size_t k = 0; k < shape.linear.size(); ++k) {
    const double size = shape.wave.empty() ? hidden.coefficients[static_cast<Index>(k)] : hidden.coefficients.norm();
    if (size < shape.linear[k]->min || size > shape.linear[k]->max) return false;
  }
  const auto parameters = shape.parameters(hidden.theta);
  for (uint32_t k = 0; k < shape.cause.plugin->param_count; ++k) {
    const muster_param& p = shape.cause.plugin->params[k];
    const auto given = parameters.find(p.name);
    if (given != parameters.end() && (given->second < p.min || given->second > p.max)) return false;
  }
  return true;
}

// Draws a place of the candidate's grid, moved by up to half a step, and scales the strength to the requested energy.
std::optional<Hidden> hide(const CauseCandidate& cause, const inference::ModelState& state, double lambda,
                           uint64_t seed) {
  const inference::Candidate& c = cause.candidate;
  const Stream stream(combined(key_of("hidden cause"), seed));
  const inference::WhitenedModel model = state.whitened_model(state.design());
  for (uint64_t k = 0; k < tries; ++k) {
    Hidden hidden;
    hidden.theta =
        c.design.grid[static_cast<std::size_t>(stream.uniform(k, 0) * static_cast<double>(c.design.grid.size()))];
    for (Index j = 0; j < c.refinement.step.size(); ++j)
      hidden.theta[j] += c.refinement.step[j] * (stream.uniform(k, 1 + static_cast<uint64_t>(j)) - 0.5);
    if (c.refinement.lower.size() > 0)
      hidden.theta = hidden.theta.cwiseMax(c.refinement.lower).cwiseMin(c.refinement.upper);
    if (c.refinement.admitted && c.refinement.admitted(hidden.theta) < 1) continue;
    const MatrixXd columns = state.columns_of(c, hidden.theta);
    VectorXd weights(columns.cols());
    for (Index j = 0; j < weights.size(); ++j) weights[j] = stream.normal(k, 100 + static_cast<uint64_t>(j));
    if (c.design.width == 1) weights[0] = c.design.sign || weights[0] > 0 ? 1 : -1;
    const VectorXd effect = columns * weights;
    if ((effect.array() != 0).cast<double>().mean() < thresholds::hidden_concern) continue;
    const double energy = model.at.basis.rest(model.whitener(effect)).squaredNorm();
    const bool has_strength = !cause.shape->linear.empty();
    hidden.coefficients = weights * (has_strength ? std::sqrt(lambda / energy) : 1);
    hidden.lambda = has_strength ? lambda : energy;
    if (within_bounds(*cause.shape, hidden)) return hidden;
  }
  return {};
}

// Writes the table with `shift` added to its column rssi; whole dB stay whole.
void write_measured(const DiagnosisSetup& clean, const VectorXd& shift, const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(clean.file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  const auto cells = [](const std::string& line) {
    std::vector<std::string> result(1);
    for (const char c : line) {
      if (c == ',')
        result.emplace_back();
      else
        result.back() += c;
    }
    return result;
  };
  const auto heads = cells(lines.at(0));
  const auto rssi = static_cast<std::size_t>(
      std::find_if(heads.begin(), heads.end(), [](const std::string& h) { return h.rfind("rssi", 0) == 0; }) -
      heads.begin());
  std::ofstream out(file);
  out << lines[0] << '\n';
  for (std::size_t row = 0; row < clean.data.rows(); ++row) {
    auto words = cells(lines.at(row + 1));
    const double measured = clean.data.rssi[row], shifted = measured + shift[static_cast<Index>(row)];
    if (!std::isnan(measured))
      words[rssi] = print_real(measured == std::round(measured) ? std::round(shifted) : shifted);
    for (std::size_t k = 0; k < words.size(); ++k) out << (k ? "," : "") << words[k];
    out << '\n';
  }
}

// Share of the hidden effect that each other cause explains at its best place.
std::map<std::string, double> likenesses(inference::ModelState& state, const VectorXd& effect, const std::string& own) {
  std::map<std::string, double> result;
  const inference::WhitenedModel model = state.whitened_model(state.design());
  const VectorXd left = model.at.basis.rest(model.whitener(effect));
  for (const inference::Entry& entry : state.entries()) {
    const inference::Candidate& c = *entry.candidate;
    if (c.kind != inference::Kind::named || c.id == own) continue;
    result[c.id] = inference::gains(c, inference::unit_atoms(entry, model), left).maxCoeff() / left.squaredNorm();
  }
  return result;
}

std::string named_in(const Diagnosis& d) {
  std::string result;
  for (const CauseEstimate& c : d.causes) {
    if (c.status == inference::Status::named) result += (result.empty() ? "" : ", ") + c.id + ' ' + c.label;
  }
  for (const Unexplained& u : d.unexplained) result += (result.empty() ? "~" : ", ~") + u.covariate;
  return result;
}

bool names(const Diagnosis& d, const std::string& id) {
  return std::any_of(d.causes.begin(), d.causes.end(),
                     [&](const CauseEstimate& c) { return c.id == id && c.status == inference::Status::named; });
}

class Checker {
 public:
  Checker(std::string id, const Library::SearchPath& plugins, const SelfTestOptions& options)
      : id_(std::move(id)), plugins_(plugins), options_(options) {}

  HiddenCase one(const fs::path& world, uint64_t number) const {
    HiddenCase result;
    result.world = world;
    DiagnosisSetup clean(world, world / "measured.csv", plugins_);
    const auto cause = std::find_if(clean.sought.found.begin(), clean.sought.found.end(),
                                    [&](const CauseCandidate& c) { return c.candidate.id == id_; });
    if (cause == clean.sought.found.end()) return result.why_not = reason(clean), result;
    inference::ModelState state(clean.problem, clean.options);
    const auto hidden = hide(*cause, state, options_.lambda, combined(options_.seed, number));
    if (!hidden) return result.why_not = "nothing within its bounds has that strength here", result;
    const MatrixXd rows = state.columns_of(cause->candidate, hidden->theta);
    result.where = cause->candidate.label_of(hidden->theta);
    result.lambda = hidden->lambda;
    result.alike = likenesses(state, rows * hidden->coefficients, id_);
    VectorXd shift = VectorXd::Zero(static_cast<Index>(clean.data.rows()));
    shift(clean.used.rows) = cause->candidate.design.columns(hidden->theta) * hidden->coefficients;
    clean.run->clear();
    result.difference = against_simulator(clean, *cause, *hidden, shift);
    look(clean, shift, number, result);
    return result;
  }

 private:
  std::string reason(const DiagnosisSetup& clean) const {
    for (const std::string& why : clean.sought.not_tested) {
      if (why.rfind(id_ + ": ", 0) == 0) return why.substr(id_.size() + 2);
    }
    throw std::logic_error(id_);
  }

  // Largest difference, dB, between `shift` and the simulated effect of the cause's instance in an extended world.
  double against_simulator(DiagnosisSetup& clean, const CauseCandidate& cause, const Hidden& hidden,
                           const VectorXd& shift) const {
    inference::Finding finding{};
    finding.id = id_;
    finding.theta = hidden.theta;
    finding.coefficients = hidden.coefficients;
    finding.uncertainty = MatrixXd::Zero(hidden.coefficients.size(), hidden.coefficients.size());
    Diagnosis extended;
    extended.causes.push_back(cause_estimate(finding, cause));
    const VectorXd before = clean.model.expected();
    for (std::size_t k = 0; k < clean.base.paths.size(); ++k)
      extended.parameters[clean.base.paths[k]] = clean.base.values[static_cast<Index>(k)];
    const fs::path file = write_extended_world(extended, clean.file.parent_path(), options_.scratch / "extended");
    LinkModel model(file, clean.file, plugins_);
    const VectorXd executed = model.expected() - before;
    return (executed - shift)(clean.used.rows).cwiseAbs().maxCoeff();
  }

  void look(const DiagnosisSetup& clean, const VectorXd& shift, uint64_t number, HiddenCase& result) const {
    const fs::path world = clean.file.parent_path(),
                   file = options_.scratch / ("hidden_" + std::to_string(number) + ".csv");
    write_measured(clean, shift, file);
    const Diagnosis d = diagnose(world, file, plugins_);
    result.named = named_in(d);
    result.found = !d.causes.empty() && d.causes[0].id == id_ && d.causes[0].status == inference::Status::named;
    result.alone = result.found && result.named.find(", ") == result.named.npos;
    result.named_on_clean = names(diagnose(world, clean.file, plugins_), id_);
  }

  std::string id_;
  const Library::SearchPath& plugins_;
  const SelfTestOptions& options_;
};

template <class Counts>
int count(const std::vector<HiddenCase>& cases, Counts counts) {
  return static_cast<int>(std::count_if(cases.begin(), cases.end(), counts));
}

}  // namespace

int CauseSelfTest::tested() const {
  return count(cases, [](const HiddenCase& c) { return c.why_not.empty(); });
}
int CauseSelfTest::found() const {
  return count(cases, [](const HiddenCase& c) { return c.found; });
}
int CauseSelfTest::false_names() const {
  return count(cases, [](const HiddenCase& c) { return c.named_on_clean; });
}
double CauseSelfTest::difference() const {
  double result = 0;
  for (const HiddenCase& c : cases) result = std::max(result, c.difference);
  return result;
}

std::vector<std::pair<std::string, double>> CauseSelfTest::alike() const {
  std::map<std::string, std::pair<double, int>> sums;
  for (const HiddenCase& c : cases) {
    for (const auto& [other, share] : c.alike) sums[other].first += share, ++sums[other].second;
  }
  std::vector<std::pair<std::string, double>> result;
  result.reserve(sums.size());
  for (const auto& [other, sum] : sums) result.emplace_back(other, sum.first / sum.second);
  std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return result;
}

CauseSelfTest self_test_cause(const std::string& id, const std::vector<fs::path>& worlds,
                              const Library::SearchPath& plugins, const SelfTestOptions& options,
                              const std::function<void(double)>& progress) {
  CauseSelfTest result{id, {}};
  const Checker checker(id, plugins, options);
  for (std::size_t k = 0; k < worlds.size(); ++k) {
    progress(static_cast<double>(k) / static_cast<double>(worlds.size()));
    result.cases.push_back(checker.one(worlds[k], k));
  }
  progress(1);
  return result;
}

}  // namespace muster::diagnosis
