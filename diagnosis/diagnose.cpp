#include "diagnosis/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/base_columns.hpp"
#include "diagnosis/cause_rows.hpp"
#include "diagnosis/extended_world.hpp"
#include "diagnosis/found_cause.hpp"
#include "diagnosis/joint_fit.hpp"
#include "diagnosis/place_checks.hpp"
#include "diagnosis/seen_rows.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Causes that the world holds already keep their places and times; how strong they are is fitted.
FitOptions hold_places_of_causes(const LinkModel& model) {
  FitOptions options;
  for (const auto& instance : model.simulation().instances()) {
    const muster_plugin& plugin = instance->plugin();
    if (!plugin.cause) continue;
    for (uint32_t k = 0; k < plugin.param_count; ++k) {
      const muster_param& p = plugin.params[k];
      if (p.kind == MUSTER_REAL && (p.flags & MUSTER_FREE) && !(p.flags & MUSTER_LINEAR))
        options.fix.push_back(instance->name() + '/' + p.name);
    }
  }
  return options;
}

class Diagnoser {
 public:
  Diagnoser(const std::filesystem::path& world, const std::filesystem::path& file, const Library::SearchPath& plugins)
      : data_(read_dataset(file)), model_(world, file, plugins), file_(file), causes_(causes_on(plugins)) {
    if (data_.has_places()) check_places(model_, data_);
    fit_ = fit(model_, data_, hold_places_of_causes(model_));
    base_ = base_columns(model_, fit_.parameters);
    for (const std::size_t row : fit_.rows_used()) used_.push_back(static_cast<Index>(row));
    run_ = std::make_shared<CauseModel>(model_, world, file, plugins);
  }

  Diagnosis run() {
    fill_readings();
    const Eigen::MatrixXd base = base_.slopes(used_, Eigen::all);
    problem_.base = base;
    // Linear in the parameters about the fit, so that coefficients are values of parameters.
    problem_.measured -= (base_.mean - base_.slopes * base_.values)(used_);
    const CauseSources sources{run_, model_, data_, used_};
    CauseSearch causes = cause_candidates(causes_, survey_of(model_, data_), sources, base);
    for (const CauseCandidate& c : causes.found) problem_.candidates.push_back(c.candidate);
    add_columns();
    problem_.places_known = data_.has_places();
    search::Options options;
    // Readings at like distances are not at one place.
    if (!problem_.places_known) options.rows.way = 0;
    search::Search search(problem_, options);
    const search::Result result = search.run();
    run_->clear();
    Diagnosis out = summed_up(result, causes, search.bench());
    out.not_tested = std::move(causes.not_tested);
    out.not_tested.insert(out.not_tested.end(), untested_.begin(), untested_.end());
    return out;
  }

 private:
  void fill_readings() {
    noise::Readings& r = problem_.readings;
    const auto n = static_cast<Index>(used_.size());
    r.tx_at.resize(3, n);
    r.rx_at.resize(3, n);
    problem_.measured.resize(n);
    for (Index i = 0; i < n; ++i) {
      const auto row = static_cast<std::size_t>(used_[static_cast<std::size_t>(i)]);
      const auto& [tx, rx] = model_.ends()[row];
      r.tx.push_back(tx.radio);
      r.rx.push_back(rx.radio);
      r.tx_at.col(i) << tx.x, tx.y, tx.z;
      r.rx_at.col(i) << rx.x, rx.y, rx.z;
      if (!data_.t.empty()) r.t.push_back(data_.t[row]);
      if (!data_.rx_yaw.empty()) r.rx_yaw.push_back(rx.yaw);
      const bool censored = std::isnan(data_.rssi[row]);
      problem_.measured[i] = censored ? fit_.readings.floor : data_.rssi[row];
      if (!fit_.readings.censored.empty())
        problem_.bounds.known.push_back(censored ? noise::Known::below : noise::Known::value);
    }
    problem_.bounds.half_code = 0;  // the fitted floor is a level, not a code
  }

  // A number of few values is a setting: each value stands for itself.
  void add_columns() {
    for (const Covariate& column : data_.covariates) {
      const std::string name = column.name.substr(0, column.name.find('['));
      if (column.values.empty()) {
        search::Factor factor{name, {}};
        for (const Index row : used_)
          factor.level.push_back(static_cast<int>(column.factor.level[static_cast<std::size_t>(row)]));
        problem_.factors.push_back(std::move(factor));
        continue;
      }
      VectorXd values(static_cast<Index>(used_.size()));
      std::set<double> different;
      for (Index i = 0; i < values.size(); ++i) {
        values[i] = column.values[static_cast<std::size_t>(used_[static_cast<std::size_t>(i)])];
        if (different.size() <= 8) different.insert(values[i]);
      }
      if (!values.allFinite()) {
        untested_.push_back(column.name + ": it has empty cells");
      } else if (different.size() > 8) {
        problem_.covariates.push_back({name, values});
      } else if (different.size() > 1) {
        search::Factor factor{name, {}};
        for (const double v : values)
          factor.level.push_back(static_cast<int>(std::distance(different.begin(), different.find(v))));
        problem_.factors.push_back(std::move(factor));
      }
    }
  }

  Diagnosis summed_up(const search::Result& result, const CauseSearch& causes, const search::Bench& bench) {
    Diagnosis out;
    out.notes = data_.notes;
    for (const std::string& blind : fit_.not_identifiable) out.notes.push_back("not identifiable: " + blind);
    out.residual_sd = fit_.residual_sd;
    out.noise = result.noise.covariance;
    out.held_out = result.held_out;
    out.readings = used_.size();
    out.rows = bench.rows().size();
    const VectorXd coefficients = result.base_coefficients.cwiseMax(base_.lower).cwiseMin(base_.upper);
    for (std::size_t j = 0; j < base_.paths.size(); ++j)
      out.parameters[base_.paths[j]] = coefficients[static_cast<Index>(j)];
    for (std::size_t k = 0; k < result.findings.size(); ++k) {
      const search::Finding& f = result.findings[k];
      const auto cause = std::find_if(causes.found.begin(), causes.found.end(),
                                      [&](const CauseCandidate& c) { return c.candidate.id == f.id; });
      if (f.status == search::Status::unexplained || cause == causes.found.end()) {
        out.unexplained.push_back({f.id.substr(f.id.rfind('~') + 1), f.evidence, f.gain, f.held_out});
        continue;
      }
      out.causes.push_back(found_cause(f, *cause, bench, k < bench.terms.size() ? &bench.terms[k] : nullptr));
      out.causes.back().effect = effect_of(bench, cause->candidate, f);
      give_tables(*cause->shape, out.causes.back());
    }
    run_->clear();
    extend(bench, out);
    for (const CauseCandidate& c : causes.found) out.searched.push_back(c.candidate.id);
    out.stairs = result.stairs;
    out.checks = result.checks;
    out.seen = seen_rows(bench, model_);
    out.world_values = world_values(bench, base_.paths, coefficients, model_);
    for (WorldValue& v : out.world_values) v.value = out.parameters.at(v.path);
    return out;
  }

  // A cause that reads a table gets the measured columns that it needs.
  void give_tables(const CauseShape& shape, FoundCause& found) const {
    const muster_param* file = shape.cause.file();
    if (!file) return;
    const std::string column = own_column(shape.cause);
    if (column == "walls") {
      found.files[file->name] = counts_of_walls();
      return;
    }
    const auto values = std::find_if(data_.covariates.begin(), data_.covariates.end(),
                                     [&](const Covariate& c) { return c.name.substr(0, c.name.find('[')) == column; });
    std::string text = "t[s],tx,rx," + values->name + '\n';
    for (std::size_t row = 0; row < data_.rows(); ++row)
      text += print_real(data_.t[row]) + ',' + data_.tx.levels[data_.tx.level[row]] + ',' +
              data_.rx.levels[data_.rx.level[row]] + ',' + print_real(values->values[row]) + '\n';
    found.files[file->name] = text;
  }

  // The columns walls_MATERIAL, in the order of the readings.
  std::string counts_of_walls() const {
    std::vector<const Covariate*> columns;
    std::string text;
    for (const Covariate& c : data_.covariates) {
      if (c.name.rfind("walls_", 0) != 0 || c.values.empty()) continue;
      text += (columns.empty() ? "" : ",") + c.name;
      columns.push_back(&c);
    }
    for (std::size_t row = 0; row < data_.rows(); ++row) {
      for (const Covariate* c : columns) text += (c == columns[0] ? "\n" : ",") + print_real(c->values[row]);
    }
    return text + '\n';
  }

  void extend(const search::Bench& bench, Diagnosis& out) {
    out.mean = VectorXd::Constant(base_.mean.size(), std::nan(""));
    const VectorXd offset = (base_.mean - base_.slopes * base_.values)(used_);
    const VectorXd measured = bench.y() + bench.rows().mean(offset);
    const VectorXd mean =
        fit_jointly({model_, causes_, file_, bench, used_, measured}, base_.lower, base_.upper, base_.paths, out);
    out.mean(used_) = mean(used_);
  }

  Dataset data_;
  LinkModel model_;
  std::filesystem::path file_;
  std::vector<Cause> causes_;
  std::vector<Index> used_;  // rows of the table behind the readings of the search
  std::shared_ptr<CauseModel> run_;
  Fit fit_;
  BaseColumns base_;
  search::Problem problem_;
  std::vector<std::string> untested_;
};

std::string in_words(const Diagnosis& d) {
  std::string result;
  for (const FoundCause& c : d.causes) {
    if (c.status == search::Status::named) result += (result.empty() ? "" : ", ") + c.id + " " + c.label;
  }
  for (const Unexplained& u : d.unexplained) result += (result.empty() ? "~" : ", ~") + u.covariate;
  return result.empty() ? "silent" : result;
}

}  // namespace

bool Diagnosis::named() const {
  return std::any_of(causes.begin(), causes.end(),
                     [](const FoundCause& c) { return c.status == search::Status::named; });
}

const char* Diagnosis::verdict() const {
  return !unexplained.empty() ? "unexplained" : named() ? "extended" : "adequate";
}

Diagnosis diagnose(const std::filesystem::path& world, const std::filesystem::path& data,
                   const Library::SearchPath& plugins) {
  return Diagnoser(world, data, plugins).run();
}

Loop closed_loop(const Diagnosis& found, const std::filesystem::path& world, const std::filesystem::path& data,
                 const std::filesystem::path& out, const Library::SearchPath& plugins) {
  Loop loop{out, 0, ""};
  const std::filesystem::path file = write_extended_world(found, world, out);
  LinkModel model(file, data, plugins);
  const VectorXd& simulated = model.expected();
  for (Index i = 0; i < simulated.size(); ++i) {
    if (!std::isnan(found.mean[i]))
      loop.mean_difference = std::max(loop.mean_difference, std::abs(simulated[i] - found.mean[i]));
  }
  loop.rediagnosis = in_words(diagnose(file, data, plugins));
  return loop;
}

}  // namespace muster::diagnosis
