#include "fit_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "diagnosis/calibration/data_doubts.hpp"
#include "diagnosis/calibration/fit_figures.hpp"
#include "diagnosis/radio/links/geometry_checks.hpp"

namespace muster::report {

using namespace diagnosis;

namespace {

Json parameter_json(const FitParameter& p) {
  return {{"name", p.path},       {"value", p.value}, {"stderr", p.stderror},           {"lower95", p.lower95},
          {"upper95", p.upper95}, {"unit", p.unit},   {"identifiable", p.identifiable}, {"at_bound", p.at_bound}};
}

Json search_json(const Fit& fit) {
  Json values = Json::object();
  for (const FitParameter& p : fit.parameters) values[p.path] = p.by_search;
  return {{"method", "BOBYQA, without derivatives"}, {"parameters", values},
          {"largest_difference", fit.disagreement},  {"agrees", fit.disagreement <= 1e-6},
          {"evaluations", fit.search.evaluations},   {"least_squares_evaluations", fit.least_squares.evaluations}};
}

Json missing_json(const MissingData& missing) {
  Json bins = Json::array();
  for (const auto& bin : missing.bins)
    bins.push_back({{"level_dbm", bin.level}, {"rows", bin.rows}, {"not_received", bin.missing}});
  return {{"floor_dbm", missing.floor},
          {"explained_by_floor", missing.by_floor},
          {"lost_at_random", missing.share_at_random},
          {"evidence_for_floor", missing.evidence},
          {"by_predicted_level", bins}};
}

Json look_json(const StructureTest& look) {
  Json bins = Json::array();
  for (const Bin& bin : look.bins) {
    Json one = bin.name.empty() ? Json{{"from", bin.from}, {"to", bin.to}} : Json{{"name", bin.name}};
    one.update({{"rows", bin.rows}, {"mean_db", bin.mean}, {"stderr_db", bin.stderror}});
    bins.push_back(one);
  }
  return {{"by", look.by},       {"p", look.p}, {"alarm", look.alarm}, {"explains", look.explains},
          {"where", look.where}, {"bins", bins}};
}

std::string fading_words(const Fit& fit) { return fmt::format("{:+.3f} dB", fit.fading_mean); }

void print_parameters(const Fit& fit) {
  fmt::print("\n  {:<28} {:>10} {:>10}   {:<22} {}\n", "parameter", "value", "stderr", "95 % interval", "unit");
  for (const FitParameter& p : fit.parameters) {
    if (!p.identifiable) {
      fmt::print("  {:<28} {:>10}\n", p.path, "not identifiable");
      continue;
    }
    fmt::print("  {:<28} {:>10.3f} {:>10.3f}   {:<22} {}{}\n", p.path, p.value, p.stderror,
               fmt::format("{:.3f} to {:.3f}", p.lower95, p.upper95), p.unit, p.at_bound ? "  (at its bound)" : "");
  }
  for (const std::string& words : fit.not_identifiable) fmt::print("  not identifiable: {}\n", words);
}

void print_spread(const Fit& fit) {
  fmt::print("\nResidual sd {:.2f} dB; the world's own draws scatter by {:.2f} dB about its expectation.\n",
             fit.residual_sd, fit.simulated_sd);
  if (fit.fading_mean != 0)
    fmt::print(
        "Means of dB under the world's fading lie {} from the mean power; the expectation includes it, so l0 does not "
        "absorb it.\n",
        fading_words(fit));
  fmt::print("Standard errors allow for errors that neighbouring readings share: {:.2f} dB, alike over {:.1f} m.\n",
             fit.shared_sd, fit.decorrelation);
  fmt::print("Least squares and a search without derivatives agree to {:.1g}.\n", fit.disagreement);
}

void print_missing(const Fit& fit, std::size_t rows) {
  const MissingData& m = fit.missing;
  if (m.count == 0) return;
  fmt::print("\n{} of {} readings were not received: ", m.count, rows);
  const auto share = [](const MissingData::Bin& b) { return 100 * b.missing / b.rows; };
  if (m.censored) {
    fmt::print("censored by a floor at {:.1f} dBm, which explains {:.0f} % of them", m.floor, 100 * m.by_floor);
  } else {
    fmt::print("random loss; a floor at {:.1f} dBm would explain {:.0f} % of them", m.floor, 100 * m.by_floor);
  }
  fmt::print(" ({:.1f} % are missing at {:.0f} dBm, {:.1f} % at {:.0f} dBm).\n", share(m.bins.front()),
             m.bins.front().level, share(m.bins.back()), m.bins.back().level);
}

std::string chance(double p) { return p < 1e-9 ? "p < 1e-9" : fmt::format("p = {:.1g}", p); }

void print_misfit(const ResidualScan& misfit) {
  fmt::print("\n{}\n", misfit.misfits ? "The model misfits:" : "No structure is left in the residual along:");
  std::string fine;
  for (const StructureTest& look : misfit.looks) {
    if (look.alarm)
      fmt::print("  by {:<12} {:<10} {:>4.1f} % of the variance; {}\n", look.by, chance(look.p), 100 * look.explains,
                 look.where);
    else
      fine += fmt::format("{}{} (p = {:.2g})", fine.empty() ? "" : ", ", look.by, look.p);
  }
  if (!fine.empty()) fmt::print("  {}{}\n", misfit.misfits ? "nothing found by " : "", fine);
  fmt::print("  {}\n", misfit.shared_allowed ? "p-values allow for errors that neighbouring readings share"
                                             : "p-values hold the world to its word that readings share no shadowing");
  for (const std::string& words : misfit.not_tested) fmt::print("  not tested: {}\n", words);
}

void print_cells(const CellErrors& errors, const CellOptions& options) {
  if (errors.errors.empty()) {
    fmt::print(
        "\nMeans over cells of {:g} m: none. Each of the {} cells has fewer than {} readings; larger cells (--cell) or "
        "fewer readings (--least) would give some.\n",
        options.size, errors.few, options.least);
    return;
  }
  fmt::print("\nMeans over cells of {:g} m, measured - simulated: {} cells, mean {:+.2f} dB, sd {:.2f} dB;",
             options.size, errors.errors.size(), errors.mean, errors.sd);
  for (const auto& [share, value] : errors.quantiles) fmt::print(" {:g} %: {:+.1f}", 100 * share, value);
  fmt::print("\nWhat their histogram cannot show:\n");
  for (const std::string& words : errors.cannot_show) fmt::print("  - {}\n", words);
}

// `; all readings are at 3 to 3.1 m`, where they are at nearly one distance.
std::string one_distance(const Dataset& data) {
  constexpr double apart = 1.5;  // times; less tells no law of distance
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (std::size_t i = 0; data.has_places() && i < data.rows(); ++i) {
    const double d = std::hypot(data.tx_at[i][0] - data.rx_at[i][0], data.tx_at[i][1] - data.rx_at[i][1]);
    if (data.is_wild(i) || std::isnan(data.rssi[i])) continue;
    low = std::min(low, d), high = std::max(high, d);
  }
  if (!(high > 0) || high > apart * low) return "";
  return fmt::format("; all readings are at {:.3g} to {:.3g} m in plan: expected readings at other distances", low,
                     high);
}

// Parameters of which the interval reaches from bound to bound: the readings say nothing of them, though some differ by
// rounding from what no reading depends on. They are told as not identifiable, with what makes up for a change.
void name_unsettled(Fit& fit, const Dataset& data) {
  std::vector<std::pair<FitParameter*, Eigen::Index>> unsettled;
  Eigen::Index column = 0;
  for (FitParameter& p : fit.parameters) {
    if (std::isnan(p.value)) continue;  // it was held
    if (p.lower95 <= p.lower && p.upper95 >= p.upper && column < fit.slopes.cols()) unsettled.emplace_back(&p, column);
    ++column;
  }
  if (unsettled.empty()) return;
  const auto& [last, of_last] = unsettled.back();
  std::string words = fmt::format("{} lies anywhere from {:g} to {:g}{}{}", last->path, last->lower, last->upper,
                                  last->unit.empty() ? "" : " ", last->unit);
  if (unsettled.size() > 1) {
    const auto& [first, of_first] = unsettled.front();
    const Eigen::VectorXd one = fit.slopes.col(of_last), other = fit.slopes.col(of_first);
    const double makes_up = -one.dot(other) / other.squaredNorm();
    const double left = std::sqrt((one + makes_up * other).squaredNorm() / static_cast<double>(one.size()));
    words = fmt::format("changing {} by 1{}{} together with {} by {:.4g}{}{} changes readings by {:.1g} dB only",
                        last->path, last->unit.empty() ? "" : " ", last->unit, first->path, makes_up,
                        first->unit.empty() ? "" : " ", first->unit, left);
  }
  fit.not_identifiable.push_back(words + one_distance(data));
  for (const auto& [p, at] : unsettled) {
    p->identifiable = false;
    p->value = p->by_search = p->stderror = p->lower95 = p->upper95 = p->freedom = std::nan("");
  }
}

// A parameter of random draws moves no mean, and means are fitted: what tests it is told beside.
void explain_draws(Fit& fit, const Simulation& run) {
  for (const FitParameter& p : fit.parameters) {
    const std::string blind = "no reading depends on " + p.path;
    const auto told = std::find(fit.not_identifiable.begin(), fit.not_identifiable.end(), blind);
    const auto slash = p.path.find('/');
    if (told == fit.not_identifiable.end() || slash == p.path.npos) continue;
    const std::string name = p.path.substr(slash + 1);
    for (const auto& instance : run.instances()) {
      const muster_plugin& plugin = instance->plugin();
      const bool is_of_draws = (plugin.draw && (name == plugin.draw->scale || name == plugin.draw->distance)) ||
                               (plugin.law && name == plugin.law->strength);
      if (instance->name() != p.path.substr(0, slash) || !is_of_draws) continue;
      *told +=
          ", which is of random draws: a fit moves means, and these have none; muster diagnose holds the draws "
          "that the world declares against the scatter of the data";
    }
  }
}

}  // namespace

FitReport::FitReport(const std::filesystem::path& world, const std::filesystem::path& data,
                     const Library::SearchPath& plugins, const FitOptions& options, const CellOptions& cells,
                     const std::function<void(double)>& progress)
    : options_(cells), data_(read_dataset(data)), model_(world, data, plugins) {
  for (const auto& notes : {notes_on_radios(model_, data_), doubts_of(model_, data_),
                            data_.has_places() ? check_places(model_, data_) : std::vector<std::string>{}})
    data_.notes.insert(data_.notes.end(), notes.begin(), notes.end());
  progress(0.2);
  fit_ = diagnosis::fit(model_, data_, options);
  progress(0.5);
  misfit_ = residual_scan(model_, data_, fit_, features_of(model_));
  progress(0.9);
  // Means of power need the fading that expectations leave out.
  maps_ = cell_maps(model_, fit_, options_.average == Average::dB ? fit_.mean : model_.drawn(), options_);
  errors_ = cell_errors(maps_, fit_, options_);
  name_unsettled(fit_, data_);
  explain_draws(fit_, model_.simulation());
}

void FitReport::draw(const std::filesystem::path& folder) {
  pictures_ = write_fit_pictures(folder, model_, fit_, misfit_, maps_, errors_, options_);
}

Json FitReport::cells_json() const {
  Json quantiles = Json::object();
  for (const auto& [share, value] : errors_.quantiles) quantiles[fmt::format("{:g}", share)] = value;
  std::size_t cells = 0;
  for (const CellMap& map : maps_) cells += map.cells.size();
  return {{"size_m", options_.size},
          {"average", options_.average == Average::dB ? "dB" : "power"},
          {"cells", cells},
          {"cells_with_few", errors_.few},
          {"least_readings", options_.least},
          {"error_mean_db", errors_.mean},
          {"error_sd_db", errors_.sd},
          {"error_sd_if_independent_db", errors_.expected_sd},
          {"error_quantiles_db", quantiles},
          {"cannot_show", errors_.cannot_show}};
}

Json FitReport::json() const {
  Json parameters = Json::array(), looks = Json::array(), files = Json::array();
  for (const FitParameter& p : fit_.parameters) parameters.push_back(parameter_json(p));
  for (const StructureTest& look : misfit_.looks) looks.push_back(look_json(look));
  for (const auto& file : pictures_) files.push_back(file.string());
  return {{"world", model_.simulation().world().name},
          {"data", data_.table->file()},
          {"parameters", parameters},
          {"not_identifiable", fit_.not_identifiable},
          {"residual_sd_db", fit_.residual_sd},
          {"simulated_sd_db", fit_.simulated_sd},
          {"fading_mean_db", fit_.fading_mean},
          {"shared_error_sd_db", fit_.shared_sd},
          {"shared_error_decorrelation_m", fit_.decorrelation},
          {"rows", fit_.readings.heard.size()},
          {"not_received", fit_.missing.count},
          {"not_received_is",
           fit_.missing.count == 0 ? Json(nullptr) : Json(fit_.missing.censored ? "censored" : "random")},
          {"not_received_evidence", missing_json(fit_.missing)},
          {"search", search_json(fit_)},
          {"misfit",
           {{"misfits", misfit_.misfits},
            {"shared_errors_allowed", misfit_.shared_allowed},
            {"looks", looks},
            {"not_tested", misfit_.not_tested}}},
          {"cells", cells_json()},
          {"notes", data_.notes},
          {"pictures", files}};
}

void FitReport::print() const {
  fmt::print("{}: {} readings heard of {} in {}\n", model_.simulation().world().name, fit_.readings.heard.size(),
             data_.rows(), data_.table->file());
  for (const std::string& note : data_.notes) fmt::print("note: {}\n", note);
  print_parameters(fit_);
  print_spread(fit_);
  print_missing(fit_, data_.rows());
  print_misfit(misfit_);
  print_cells(errors_, options_);
  for (const auto& file : pictures_)
    fmt::print("{}{}", &file == &pictures_.front() ? "\nPictures: " : " ", file.string());
  if (!pictures_.empty()) fmt::print("\n");
}

}  // namespace muster::report
