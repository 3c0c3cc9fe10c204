#include "diagnosis/calibration/fit.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/calibration/lost_amid_heard.hpp"
#include "diagnosis/inference/noise/dense_solvers.hpp"
#include "diagnosis/radio/links/stated_clip.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

// Identifiable free parameters as one vector.
struct Search {
  LinkModel& model;
  const std::vector<double>& t;  // of each row, s; empty: the data have none
  std::vector<FitParameter*> parameters;

  Box box() const {
    const auto n = static_cast<Eigen::Index>(parameters.size());
    Box box{Eigen::VectorXd(n), Eigen::VectorXd(n)};
    for (Eigen::Index j = 0; j < n; ++j) {
      box.lower[j] = parameters[static_cast<std::size_t>(j)]->lower;
      box.upper[j] = parameters[static_cast<std::size_t>(j)]->upper;
    }
    return box;
  }
  Eigen::VectorXd start() const {
    Eigen::VectorXd x(static_cast<Eigen::Index>(parameters.size()));
    for (Eigen::Index j = 0; j < x.size(); ++j) x[j] = parameters[static_cast<std::size_t>(j)]->start;
    return x;
  }
  void set(const Eigen::VectorXd& x) const {
    for (std::size_t j = 0; j < parameters.size(); ++j) model.set(parameters[j]->path, x[static_cast<Eigen::Index>(j)]);
  }
  Mean mean() const {
    return [this](const Eigen::VectorXd& x) {
      set(x);
      return model.expected();
    };
  }
};

Readings heard_readings(const Dataset& data) {
  Readings readings{.rssi =
                        Eigen::Map<const Eigen::VectorXd>(data.rssi.data(), static_cast<Eigen::Index>(data.rows()))};
  readings.referred =
      Eigen::Map<const Eigen::VectorXd>(data.referred.data(), static_cast<Eigen::Index>(data.referred.size()));
  for (Eigen::Index i = 0; i < readings.rssi.size(); ++i) {
    if (!std::isnan(readings.rssi[i])) readings.heard.push_back(i);
  }
  return readings;
}

// Holds one parameter for each null direction, so that the others can be fitted.
void hold_blind(Fit& fit, Search& search) {
  const Box box = search.box();
  const Eigen::MatrixXd slopes = jacobian(fit.readings, search.mean(), box.inside(search.start()), box);
  std::vector<std::string> names, units;
  for (const FitParameter* p : search.parameters) {
    names.push_back(p->path);
    units.push_back(p->unit);
  }
  std::vector<FitParameter*> held;
  for (const Blindness& blind : blindnesses(slopes, box.width())) {
    fit.not_identifiable.push_back(in_words(blind, names, units));
    FitParameter* holds = nullptr;
    for (const int j : blind.parameters) {
      FitParameter* p = search.parameters[static_cast<std::size_t>(j)];
      p->identifiable = false;
      if (std::find(held.begin(), held.end(), p) == held.end()) holds = p;
    }
    if (holds) held.push_back(holds);
  }
  search.set(search.start());
  std::erase_if(search.parameters,
                [&](FitParameter* p) { return std::find(held.begin(), held.end(), p) != held.end(); });
}

void check_count(const Fit& fit, const Search& search, const Dataset& data) {
  const auto heard = fit.readings.heard.size(), needed = search.parameters.size() + 1;
  if (heard < needed)
    throw invalid({data.table->file()}, "the table has " + std::to_string(heard) +
                                            " heard readings; expected at least " + std::to_string(needed) +
                                            " to fit " + std::to_string(search.parameters.size()) + " parameters");
}

// A receiver's floor is one of what it received.
MissingData missing_from(const Readings& readings, const Search& search, double sigma) {
  const Eigen::VectorXd received = readings.received(readings.rssi);
  return missing_data(received, readings.received(search.model.expected()), sigma,
                      silent_below(search.model.simulation(), weakest_of_some(received)));
}

// Rows without a reading that were lost for another reason than the floor of the readings.
std::vector<Eigen::Index> lost_otherwise(const Readings& readings, const Minimum& fit, const Search& search) {
  std::vector<LinkPlace> links;
  for (const auto& ends : search.model.ends()) links.push_back(place_of(ends));
  const Eigen::VectorXd mean = search.mean()(fit.parameters);
  double squares = 0;  // of what was heard, which those that were lost otherwise do not widen
  for (const auto i : readings.heard) squares += std::pow(readings.rssi[i] - mean[i], 2);
  const double scatter = std::sqrt(squares / static_cast<double>(readings.heard.size()));
  return lost_amid_heard(readings, links, search.t, mean, scatter);
}

// The test of a fit without those that were lost otherwise; which are counted still.
MissingData missing_but_for(const std::vector<Eigen::Index>& otherwise, const Readings& readings, const Search& search,
                            const Minimum& fit, const MissingData& of_all) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < readings.rssi.size(); ++i) {
    if (!std::binary_search(otherwise.begin(), otherwise.end(), i)) rows.push_back(i);
  }
  const Eigen::VectorXd received = readings.received(readings.rssi);
  MissingData result = missing_data(received(rows), readings.received(search.mean()(fit.parameters))(rows), fit.sigma,
                                    silent_below(search.model.simulation(), weakest_of_some(received)));
  result.count = of_all.count;
  result.bins = of_all.bins;
  return result;
}

// Fits with missing readings below the floor, except those that were lost otherwise.
void fit_censored(Readings& readings, double floor, Minimum& fit, const std::vector<Eigen::Index>& otherwise,
                  const Mean& mean, const Box& box) {
  readings.floor = floor;
  readings.censored.clear();
  for (Eigen::Index i = 0; i < readings.rssi.size(); ++i) {
    if (std::isnan(readings.rssi[i]) && !std::binary_search(otherwise.begin(), otherwise.end(), i))
      readings.censored.push_back(i);
  }
  fit = least_squares(readings, mean, fit.parameters, box);
}

// Where many are lost, what was heard at low levels are the stronger ones, to which a fit of them alone is too near to
// see the floor. Where readings end at the floor that the world states it is asked for beside a fit that knows it, too.
void look_for_stated_floor(Fit& fit, const Search& search, const Mean& mean, const Box& box) {
  const auto stated =
      silent_below(search.model.simulation(), weakest_of_some(fit.readings.received(fit.readings.rssi)));
  if (!stated || fit.missing.censored || !fit.missing.rises() ||
      std::abs(fit.missing.floor - *stated) > thresholds::near_stated_floor)
    return;
  Readings readings = fit.readings;
  Minimum censored = fit.least_squares;
  fit_censored(readings, fit.missing.floor, censored, {}, mean, box);
  search.set(censored.parameters);
  const MissingData missing = missing_from(readings, search, censored.sigma);
  if (missing.censored && censored.sigma < thresholds::wider_beside_floor * fit.least_squares.sigma)
    fit.missing = missing;
  else
    search.set(fit.least_squares.parameters);
}

// Fits by both methods; readings missing below a floor enter the likelihood as censored.
void solve(Fit& fit, const Search& search) {
  const Mean mean = search.mean();
  const Box box = search.box();
  fit.least_squares = least_squares(fit.readings, mean, search.start(), box);
  search.set(fit.least_squares.parameters);
  fit.missing = missing_from(fit.readings, search, fit.least_squares.sigma);
  look_for_stated_floor(fit, search, mean, box);
  if (fit.missing.censored) {
    // A fit of what was heard alone is too near to that. Gross errors among the bounds widen the first one.
    const Readings heard = fit.readings;
    const Minimum of_heard = fit.least_squares;
    std::vector<Eigen::Index> otherwise, before;
    for (int round = 0; round < 6 && (round == 0 || otherwise != before); ++round) {
      before = otherwise;
      fit_censored(fit.readings, fit.missing.floor, fit.least_squares, otherwise, mean, box);
      otherwise = lost_otherwise(fit.readings, fit.least_squares, search);
    }
    if (!otherwise.empty())
      fit.missing = missing_but_for(otherwise, fit.readings, search, fit.least_squares, fit.missing);
    if (fit.missing.censored) {
      fit_censored(fit.readings, fit.missing.floor, fit.least_squares, otherwise, mean, box);
    } else {
      fit.readings = heard;
      fit.least_squares = of_heard;
      search.set(of_heard.parameters);
    }
  }
  fit.search = derivative_free_fit(fit.readings, mean, search.start(), box);
  if (fit.search.deviance < fit.least_squares.deviance - 1e-6)  // another local minimum: descend there as well
    fit.least_squares = least_squares(fit.readings, mean, fit.search.parameters, box);
  const Eigen::VectorXd &a = fit.least_squares.parameters, &b = fit.search.parameters;
  for (Eigen::Index j = 0; j < a.size(); ++j)
    fit.disagreement = std::max(fit.disagreement, std::abs(a[j] - b[j]) / (1 + std::abs(a[j])));
}

void measure_errors(Fit& fit, const Search& search) {
  const Box box = search.box();
  const Eigen::VectorXd at = fit.least_squares.parameters;
  fit.slopes = jacobian(fit.readings, search.mean(), at, box);
  search.set(at);
  fit.mean = search.model.expected();
  fit.residual = residuals(fit.readings, fit.mean, fit.least_squares.sigma);
  std::vector<LinkPlace> links;
  for (const std::size_t row : fit.rows_used()) links.push_back(place_of(search.model.ends()[row]));
  fit.clusters = clusters_of(links, thresholds::most_clusters);
  fit.kernels = kernels_of(fit.clusters);
  ErrorModel errors(fit.clusters, fit.kernels);
  errors.fit(fit.residual, fit.slopes);
  fit.shared_sd = errors.shared_sd();
  fit.decorrelation = errors.decorrelation();
  fit.shared_evidence = errors.shared_evidence();
  fit.white_sd = errors.white_sd();
  const Eigen::MatrixXd gain = noise::regression_gain(fit.slopes);
  for (std::size_t j = 0; j < search.parameters.size(); ++j) {
    FitParameter& p = *search.parameters[j];
    const auto k = static_cast<Eigen::Index>(j);
    const ErrorModel::Spread spread = errors.of_sum(gain.row(k).transpose());
    p.value = at[k];
    p.by_search = fit.search.parameters[k];
    p.stderror = std::sqrt(spread.variance);
    p.freedom = spread.freedom;
    p.at_bound = fit.least_squares.at_bound[j];
    const double reach = spread.reach(0.95);
    p.lower95 = std::max(p.lower, p.value - reach);
    p.upper95 = std::min(p.upper, p.value + reach);
  }
}

void measure_spread(Fit& fit, LinkModel& model) {
  double squares = 0;
  for (const auto i : fit.readings.heard) squares += std::pow(fit.readings.rssi[i] - fit.mean[i], 2);
  const auto spare = static_cast<double>(fit.readings.heard.size()) - static_cast<double>(fit.slopes.cols());
  fit.residual_sd = fit.readings.censored.empty() ? std::sqrt(squares / std::max(spare, 1.0)) : fit.least_squares.sigma;
  const Table* fading = model.simulation().board().find("link/*/fading");
  if (fading && fading->now().rows > 0) fit.fading_mean = 10 * std::log10(fading->now().data[0]);
  const Eigen::VectorXd drawn = model.drawn();
  double sum = 0, count = 0;
  for (Eigen::Index i = 0; i < drawn.size(); ++i) {
    if (std::isnan(drawn[i])) continue;
    sum += std::pow(drawn[i] - fit.mean[i], 2);
    ++count;
  }
  fit.simulated_sd = count > 0 ? std::sqrt(sum / count) : 0;
}

void forget_blind(Fit& fit) {
  for (FitParameter& p : fit.parameters) {
    if (p.identifiable) continue;
    p.value = p.by_search = p.stderror = p.lower95 = p.upper95 = p.freedom = std::nan("");
  }
}

}  // namespace

std::vector<std::size_t> Fit::rows_used() const {
  std::vector<std::size_t> rows;
  for (const auto i : readings.heard) rows.push_back(static_cast<std::size_t>(i));
  for (const auto i : readings.censored) rows.push_back(static_cast<std::size_t>(i));
  return rows;
}

Fit fit(LinkModel& model, const Dataset& data, const FitOptions& options) {
  Fit result;
  result.parameters = free_parameters(model, options);
  result.readings = heard_readings(data);
  Search search{model, data.t, {}};
  for (FitParameter& p : result.parameters) search.parameters.push_back(&p);
  check_count(result, search, data);
  hold_blind(result, search);
  if (search.parameters.empty())
    throw invalid({data.table->file()}, "nothing can be fitted: " + result.not_identifiable.at(0));
  solve(result, search);
  measure_errors(result, search);
  measure_spread(result, model);
  model.expected();
  forget_blind(result);
  return result;
}

}  // namespace muster::diagnosis
