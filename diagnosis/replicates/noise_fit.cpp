#include "diagnosis/replicates/noise_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <muster/random.hpp>

#include "diagnosis/calibration/distributions.hpp"
#include "diagnosis/replicates/replicates.hpp"
#include "diagnosis/replicates/thresholds.hpp"
#include "diagnosis/replicates/variance_components.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

using Values = std::map<std::string, double>;

// Of those that are numbers: a sensor that has not read yet gives none.
double largest(const Eigen::VectorXd& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::isnan(value) ? 0 : std::abs(value));
  return result;
}

bool contains(const std::vector<std::string>& list, const std::string& path) {
  return std::find(list.begin(), list.end(), path) != list.end();
}

class NoiseFitter {
 public:
  NoiseFitter(const World& world, const Options& running, const std::string& table, const std::filesystem::path& data,
              const FitOptions& options)
      : runs_(world, running, table, data), table_(table) {
    find_parameters(options);
    run_without();
    find_moved();
    run_without();
    refuse_degrees();
    residual_ = runs_.pieces().difference(runs_.measured(), without_);
  }

  NoiseFit fitted() {
    for (int round = 0; round < thresholds::noise_rounds; ++round)
      if (step() < thresholds::noise_settled) break;
    check();
    result_.runs = runs_.runs();
    return result_;
  }

 private:
  uint64_t seed(int i) const { return combined(key_of("replicate"), static_cast<uint64_t>(i)); }
  Eigen::VectorXd difference(const Eigen::VectorXd& run) const { return runs_.pieces().difference(run, without_); }

  // All noise at 0 but what is given.
  Values at(const Values& given) const {
    Values result = fixed_;
    for (const auto& p : candidates_) result[p.path] = 0;
    for (const auto& [path, value] : given) result[path] = value;
    return result;
  }

  void run_without() {
    without_ = runs_.run(seed(0), at({}));
    if (largest(difference(runs_.run(seed(1), at({})))) > 0) refuse_drawn();
  }

  // A heading that turns some 57 times as far as the world's, were it in radians.
  void refuse_degrees() const {
    double turned = 0;
    for (Eigen::Index i = 0; i < without_.size(); ++i)
      if (runs_.pieces().kinds()[kind_of(i)].name == "turn" && !std::isnan(without_[i]))
        turned += std::abs(without_[i]);
    constexpr double degrees = 57.29577951308232, around = 1.4;
    const RecordedTable& read = runs_.recorded();
    if (!(turned > 0) || read.turned < degrees / around * turned || read.turned > degrees * around * turned) return;
    throw invalid(read.yaw_at,
                  "column \"yaw[rad]\" turns " + printed(read.turned / turned) +
                      " times as far as the world; are these degrees? expected radians, a degree is 0.017453293");
  }

  static std::string printed(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
  }

  void find_parameters(const FitOptions& options) {
    std::vector<std::string> held;
    for (const std::string& word : options.fix) {
      const auto equals = word.find('=');
      const std::string path = word.substr(0, equals);
      held.push_back(path);
      fixed_[path] = runs_.parameter(path).value;  // throws with the nearest path
      if (equals == word.npos) continue;
      const auto value = parse_real(word.substr(equals + 1));
      if (!value) throw Error(Exit::invalid_input, "--fix " + path + ": " + why_not_real(word.substr(equals + 1)));
      fixed_[path] = *value;
    }
    for (const std::string& path : options.free) {
      if (contains(held, path))
        throw Error(Exit::invalid_input, quote(path) + " is both free and fixed; expected one of them");
      if (const auto info = runs_.parameter(path); info.declared->min > 0)
        throw Error(Exit::invalid_input, "--free " + path + ": it is at least " + print_real(info.declared->min) +
                                             ", and noise may be 0; expected the standard deviation of a noise");
    }
    for (const ParameterInfo& info : runs_.parameters()) {
      const bool is_declared = (info.declared->flags & MUSTER_FREE) && info.declared->kind == MUSTER_REAL;
      if ((!is_declared && !contains(options.free, info.path)) || contains(held, info.path)) continue;
      if (info.declared->min != 0) {
        result_.held.push_back(info.path);
        continue;
      }
      NoiseParameter p{.path = info.path, .unit = info.declared->unit};
      p.start = info.value > 0 ? info.value : thresholds::noise_start_share * info.declared->max;
      p.value = p.start, p.freedom = 1;
      candidates_.push_back(p);
      most_[p.path] = info.declared->max;
    }
  }

  [[noreturn]] void refuse_drawn() const {
    throw Error(Exit::invalid_input,
                "--table: " + table_ +
                    " is drawn anew by each seed also where no noise is free, so that the world has " +
                    "no course to compare with; expected recorded courses: <physics.replay> of poses, " +
                    "<control.recorded> of commands, or --free of the noise that draws it");
  }

  // Noise is what makes two seeds differ. Parameters that do not are held as the world has them.
  void find_moved() {
    std::vector<NoiseParameter> moved;
    for (const auto& p : candidates_) {
      const Eigen::VectorXd a = runs_.run(seed(0), at({{p.path, p.start}})),
                            b = runs_.run(seed(1), at({{p.path, p.start}}));
      if (largest(runs_.pieces().difference(a, b)) > 0)
        moved.push_back(p);
      else
        result_.held.push_back(p.path);
    }
    candidates_ = moved;
    if (moved.empty())
      throw Error(Exit::invalid_input, "no free parameter is a noise of " + table_ +
                                           (result_.held.empty() ? "" : " (tried: " + list_of(result_.held) + ")") +
                                           "; expected one, such as <robots.odometry noise=\"0.01\"/>, or --free PATH");
    result_.parameters = std::move(moved);
  }

  static std::string list_of(const std::vector<std::string>& words) {
    std::string result;
    for (const auto& word : words) result += (result.empty() ? "" : ", ") + word;
    return result;
  }

  // Variances of each piece where each parameter alone has its value: of the first half of the runs, and of the second.
  void draw() {
    const auto count = static_cast<Eigen::Index>(result_.parameters.size());
    constexpr int half = thresholds::noise_replicates / 2;
    for (auto& half_of : halves_) half_of = Eigen::MatrixXd::Zero(without_.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const auto& p = result_.parameters[static_cast<std::size_t>(k)];
      for (int i = 0; i < 2 * half; ++i)
        halves_[i / half].col(k) += difference(runs_.run(seed(i), at({{p.path, drawn_[p.path]}}))).cwiseAbs2() / half;
    }
  }

  // A kind that noise moves far less than another of the same unit is left to it: what it has is of second order, and
  // where noise is small its least error would count for much.
  void find_kinds() {
    const auto& kinds = runs_.pieces().kinds();
    std::vector<double> variance(kinds.size(), 0);
    for (Eigen::Index i = 0; i < without_.size(); ++i)
      if (const double sum = halves_[0].row(i).sum() + halves_[1].row(i).sum(); !std::isnan(sum))
        variance[kind_of(i)] += sum;
    is_used_.assign(kinds.size(), 1);
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      constexpr double share = thresholds::least_noise_share;
      if (variance[k] == 0) is_used_[k] = 0;
      for (std::size_t other = 0; other < kinds.size(); ++other)
        if (kinds[other].unit == kinds[k].unit && variance[k] < share * share * variance[other]) is_used_[k] = 0;
      if (!is_used_[k]) result_.left_out.push_back(kinds[k].name);
    }
  }

  std::size_t kind_of(Eigen::Index piece) const {
    return static_cast<std::size_t>(piece) % runs_.pieces().kinds().size();
  }

  void find_used() {
    if (is_used_.empty()) find_kinds();
    used_.clear();
    result_.noiseless = 0;
    for (Eigen::Index i = 0; i < without_.size(); ++i) {
      const bool has_noise = halves_[0].row(i).sum() > 0 && halves_[1].row(i).sum() > 0 && !std::isnan(residual_[i]);
      if (is_used_[kind_of(i)] && has_noise) used_.push_back(i);
      if (is_used_[kind_of(i)] && !has_noise) ++result_.noiseless;
    }
    if (used_.size() < 2 * result_.parameters.size() + 2)
      throw Error(Exit::invalid_input, std::to_string(used_.size()) + " pieces of " + table_ +
                                           " have noise in the world, which are too few to fit it");
  }

  // Shapes for the weights: beside its own variance each piece has a share of the mean of its kind. Where the world has
  // next to no noise, as in the first tick of a start, any other error would count for all.
  Eigen::MatrixXd weights() const {
    const Eigen::MatrixXd drawn = halves_[0](used_, Eigen::all);
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(is_used_.size()), drawn.cols());
    Eigen::VectorXd counts = Eigen::VectorXd::Zero(sums.rows());
    const auto kind = [&](std::size_t i) { return static_cast<Eigen::Index>(kind_of(used_[i])); };
    for (std::size_t i = 0; i < used_.size(); ++i)
      sums.row(kind(i)) += drawn.row(static_cast<Eigen::Index>(i)), ++counts[kind(i)];
    Eigen::MatrixXd result = drawn;
    for (std::size_t i = 0; i < used_.size(); ++i)
      result.row(static_cast<Eigen::Index>(i)) += thresholds::mean_noise_share * sums.row(kind(i)) / counts[kind(i)];
    return result;
  }

  // One fit; the largest change of a parameter, as a share of its value.
  double step() {
    for (const auto& p : result_.parameters) drawn_[p.path] = p.value > 0 ? p.value : p.start;
    draw();
    find_used();
    const Eigen::VectorXd squares = residual_(used_).cwiseAbs2();
    const Eigen::MatrixXd shapes = halves_[1](used_, Eigen::all), by = weights();
    VarianceComponents found = variance_components(squares, shapes, by);
    const Eigen::VectorXd at_fit = (by * found.value).cwiseMax(1e-300);
    const double second = (squares.array() / at_fit.array()).mean();
    const double fourth = (squares.array() / at_fit.array()).square().mean() / (second * second);
    // Of normal values it lies within two standard errors of 3.
    const double kurtosis = fourth - 2 * std::sqrt(24.0 / static_cast<double>(used_.size()));
    if (kurtosis > 3) found = variance_components(squares, shapes, by, kurtosis);
    variance_ = shapes * found.value;
    split_ = halves_[0](used_, Eigen::all) * found.value;
    double change = 0;
    for (std::size_t k = 0; k < result_.parameters.size(); ++k) {
      auto& p = result_.parameters[k];
      const double before = drawn_[p.path], value = before * std::sqrt(found.value[static_cast<Eigen::Index>(k)]);
      change = std::max(change, value == 0 && p.freedom == 0 ? 0 : std::abs(value - p.value) / before);
      p.at_bound = value >= most_[p.path];
      p.value = std::min(value, most_[p.path]);
      constexpr double half = thresholds::noise_replicates / 2.0;
      p.freedom = found.freedom[static_cast<Eigen::Index>(k)] * half / (half + 1);  // the shapes are drawn, too
      p.lower95 = p.freedom > 0 ? p.value * std::sqrt(p.freedom / chi_square_quantile(p.freedom, 0.975)) : 0;
      p.upper95 = p.freedom > 0 ? p.value * std::sqrt(p.freedom / chi_square_quantile(p.freedom, 0.025))
                                : before * std::sqrt(1.96 * found.stderror[static_cast<Eigen::Index>(k)]);
    }
    return change;
  }

  void check() {
    const auto& kinds = runs_.pieces().kinds();
    std::vector<std::vector<CheckedPiece>> pieces(kinds.size());
    std::vector<Eigen::Index> last(kinds.size(), -1);
    for (std::size_t i = 0; i < used_.size(); ++i) {
      const Eigen::Index piece = used_[i];
      const std::size_t kind = kind_of(piece);
      const bool follows = last[kind] >= 0 && runs_.follows(last[kind], piece);
      const auto row = static_cast<Eigen::Index>(i);
      pieces[kind].push_back({residual_[piece], variance_[row], split_[row], without_[piece], follows});
      last[kind] = piece;
    }
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
      if (const NoiseCheck one = checked(kinds[kind], pieces[kind]); one.pieces > 0) result_.checks.push_back(one);
    constexpr double tests = 5;  // of each kind
    const double alpha =
        thresholds::noise_doubt_alpha / (tests * static_cast<double>(std::max<std::size_t>(1, result_.checks.size())));
    for (const NoiseCheck& one : result_.checks)
      for (std::string& doubt : doubts_of(one, alpha)) result_.doubts.push_back(std::move(doubt));
  }

  Replicates runs_;
  std::string table_;
  NoiseFit result_;
  Values fixed_, most_, drawn_;
  std::vector<NoiseParameter> candidates_;
  Eigen::VectorXd without_, residual_;  // of all pieces
  Eigen::MatrixXd halves_[2];           // pieces x parameters
  std::vector<char> is_used_;           // of each kind
  std::vector<Eigen::Index> used_;      // pieces
  Eigen::VectorXd variance_, split_;    // fitted, of the used pieces, by the second half of the runs and by the first
};

}  // namespace

NoiseFit fit_noise(const World& world, const Options& running, const std::string& table,
                   const std::filesystem::path& data, const FitOptions& options) {
  return NoiseFitter(world, running, table, data, options).fitted();
}

}  // namespace muster::diagnosis
