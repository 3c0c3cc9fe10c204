#include "diagnosis/calibration/residual_scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "diagnosis/calibration/structure_test.hpp"
#include "diagnosis/data/recorded_time.hpp"
#include "diagnosis/radio/links/drawn_term.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

class Scanner {
 public:
  Scanner(const LinkModel& model, const Dataset& data, const Fit& fit, const Features& features)
      : model_(model), data_(data), fit_(fit), features_(features), rows_(fit.rows_used()) {}

  ResidualScan look() {
    // A world whose plugins declare draws, none of them of any size, declares independent errors; others leave it open.
    result_.shared_allowed = !declares_draws(model_) || drawn_field(model_).shadowing > 0;
    look_at_geometry();
    look_at_walls();
    look_at_radios();
    look_at_columns();
    look_at_neighbours();
    for (StructureTest& look : result_.looks) {
      look.alarm = look.p * static_cast<double>(result_.looks.size()) < thresholds::scan_alpha;
      result_.misfits = result_.misfits || look.alarm;
    }
    std::stable_sort(result_.looks.begin(), result_.looks.end(),
                     [](const StructureTest& a, const StructureTest& b) { return a.explains > b.explains; });
    return std::move(result_);
  }

 private:
  std::vector<double> used(const std::vector<double>& all) const {
    std::vector<double> values;
    for (const std::size_t row : rows_) values.push_back(all[row]);
    return values;
  }

  // A wild stamp is put in the middle of the others, where one reading shows nothing.
  std::vector<double> used_times() const {
    std::vector<double> good;
    for (const std::size_t row : rows_) {
      if (!data_.is_wild(row)) good.push_back(data_.t[row]);
    }
    std::vector<double> values = used(data_.t);
    if (good.size() == values.size() || good.empty()) return values;
    std::nth_element(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(good.size() / 2), good.end());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (data_.is_wild(rows_[i])) values[i] = good[good.size() / 2];
    }
    return values;
  }

  static bool is_empty(const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v); });
  }

  static bool varies(const std::vector<double>& values, double least) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double v : values) {  // an empty cell is NaN, and neither less nor more
      low = v < low ? v : low;
      high = v > high ? v : high;
    }
    return high - low > least;
  }

  void add(const Subject& subject) { result_.looks.push_back(structure_along(fit_, subject, result_.shared_allowed)); }

  void add_number(const std::string& by, const std::string& unit, const std::vector<double>& values, int count) {
    add({.by = by, .unit = unit, .values = values, .level = {}, .names = {}, .shapes = waves(values, count)});
  }

  void add_time(const std::vector<double>& t) {
    std::vector<double> along = t;
    if (const RecordedTime recorded(t); recorded.has_pauses()) {
      for (double& v : along) v = recorded.shortened(v);
    }
    add({.by = "time", .unit = "s", .values = t, .level = {}, .names = {}, .shapes = waves(along, 8)});
  }

  void add_angle(const std::string& by, const std::vector<double>& all, int count, const std::string& why_not) {
    const auto values = used(all);
    if (!varies(values, 0.2)) return result_.not_tested.push_back(by + ": " + why_not);
    add({.by = by, .unit = "rad", .values = values, .level = {}, .names = {}, .shapes = lobes(values, count)});
  }

  void look_at_geometry() {
    std::vector<double> log_distance;
    for (const double d : used(features_.distance)) log_distance.push_back(std::log10(std::max(d, 0.01)));
    add_number("distance", "m", log_distance, 5);
    for (Bin& bin : result_.looks.back().bins) {
      bin.from = std::pow(10, bin.from);
      bin.to = std::pow(10, bin.to);
    }
    result_.looks.back().where = in_metres(result_.looks.back());
    add_angle("bearing", features_.azimuth, 8, "all links point the same way");
    if (data_.tx_yaw.empty())
      result_.not_tested.push_back("tx_bearing: the data have no tx_yaw");
    else
      add_angle("tx_bearing", features_.tx_bearing, 4, "it does not vary");
    if (data_.rx_yaw.empty())
      result_.not_tested.push_back("rx_bearing: the data have no rx_yaw");
    else
      add_angle("rx_bearing", features_.rx_bearing, 4, "it does not vary");
    if (data_.t.empty()) return result_.not_tested.push_back("time: the data have none");
    const auto t = used_times();
    if (varies(t, 0))
      add_time(t);
    else
      result_.not_tested.push_back("time: all readings were taken at once");
  }

  // Replaces the text made from logarithms of distance.
  static std::string in_metres(const StructureTest& look) {
    const Bin* worst = nullptr;
    for (const Bin& bin : look.bins) {
      if (bin.stderror > 0 && (!worst || std::abs(bin.mean) / bin.stderror > std::abs(worst->mean) / worst->stderror))
        worst = &bin;
    }
    if (!worst) return "";
    return fmt::format("distance {:.3g} to {:.3g} m: {:+.1f} +- {:.1f} dB", worst->from, worst->to, worst->mean,
                       worst->stderror);
  }

  // Tests walls that enough links cross and enough others do not: the most crossed ones.
  void look_at_walls() {
    std::vector<std::pair<double, int>> weight;
    for (std::size_t w = 0; w < features_.walls.size(); ++w) weight.emplace_back(0, static_cast<int>(w));
    for (const std::size_t row : rows_) {
      for (std::size_t k = features_.first[row]; k < features_.first[row + 1]; ++k)
        --weight[static_cast<std::size_t>(features_.crossed[k])].first;
    }
    std::sort(weight.begin(), weight.end());  // most crossed first, ties in the world's order
    Subject subject{.by = "wall", .unit = "", .values = {}, .level = {}, .names = {}, .shapes = {}, .by_shape = true};
    std::map<int, Eigen::Index> column;
    for (const auto& [crossings, wall] : weight) {
      const double n = -crossings, all = static_cast<double>(rows_.size());
      if (n < thresholds::fewest_crossings || n > all - thresholds::fewest_crossings ||
          column.size() == thresholds::most_names)
        continue;
      column.emplace(wall, static_cast<Eigen::Index>(column.size()));
      subject.names.push_back(features_.walls[static_cast<std::size_t>(wall)]);
    }
    if (column.empty()) return result_.not_tested.push_back("wall: none that enough links cross and others do not");
    subject.shapes =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows_.size()), static_cast<Eigen::Index>(column.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (std::size_t k = features_.first[rows_[i]]; k < features_.first[rows_[i] + 1]; ++k) {
        const auto found = column.find(features_.crossed[k]);
        if (found != column.end()) subject.shapes(static_cast<Eigen::Index>(i), found->second) += 1;
      }
    }
    add(subject);
  }

  void add_names(const std::string& by, const Factor& factor) {
    Subject subject{.by = by, .unit = "", .values = {}, .level = {}, .names = factor.levels, .shapes = {}};
    if (factor.levels.size() > thresholds::most_names)
      return result_.not_tested.push_back(
          fmt::format("{}: {} names; more than {}", by, factor.levels.size(), thresholds::most_names));
    for (const std::size_t row : rows_) subject.level.push_back(static_cast<int>(factor.level[row]));
    subject.shapes = indicators(subject.level, factor.levels.size());
    add(subject);
  }

  void look_at_radios() {
    if (data_.tx.levels.size() > 1)
      add_names("tx", data_.tx);
    else
      result_.not_tested.push_back("tx: there is one, so its offset is part of l0");
    if (data_.rx.levels.size() > 1)
      add_names("rx", data_.rx);
    else
      result_.not_tested.push_back("rx: there is one, so its offset is part of l0");
  }

  void look_at_columns() {
    for (const Covariate& column : data_.covariates) {
      if (!column.no_cause.empty())
        result_.not_tested.push_back(column.name + ": " + column.no_cause);
      else if (column.values.empty())
        add_names(column.name, column.factor);
      else if (const auto values = used(column.values); varies(values, 0))
        add_number(column.name, "", values, 5);
      else
        result_.not_tested.push_back(column.name + (is_empty(values) ? ": it is empty" : ": it is the same") +
                                     " in all readings that are fitted");
    }
  }

  // Tests neighbouring readings for shared errors; skipped where the world declares shadowing.
  void look_at_neighbours() {
    const double declared = drawn_field(model_).shadowing;
    if (declared > 0)
      return result_.not_tested.push_back(fmt::format(
          "neighbours: the world declares shadowing of {:.1f} dB; found {:.1f} dB", declared, fit_.shared_sd));
    StructureTest look;
    look.by = "neighbours";
    look.columns = 2;
    look.p = chance_of_sharing(fit_.shared_evidence);
    look.explains = std::min(1.0, std::pow(fit_.shared_sd / std::max(fit_.residual_sd, 1e-9), 2));
    look.where = fmt::format(
        "readings at neighbouring places err alike, by {:.1f} dB over {:.1f} m, and the world declares no shadowing",
        fit_.shared_sd, fit_.decorrelation);
    result_.looks.push_back(look);
  }

  const LinkModel& model_;
  const Dataset& data_;
  const Fit& fit_;
  const Features& features_;
  std::vector<std::size_t> rows_;
  ResidualScan result_;
};

}  // namespace

ResidualScan residual_scan(const LinkModel& model, const Dataset& data, const Fit& fit, const Features& features) {
  return Scanner(model, data, fit, features).look();
}

}  // namespace muster::diagnosis
