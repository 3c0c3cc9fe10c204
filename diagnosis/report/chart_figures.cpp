// Charts: held-out errors step by step, partial residuals of causes, and residuals along covariates.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "diagnosis/radio/thresholds.hpp"
#include "diagnosis/report/abscissa.hpp"
#include "diagnosis/report/advice.hpp"
#include "diagnosis/report/bins.hpp"
#include "diagnosis/report/figures.hpp"
#include "diagnosis/report/places.hpp"

namespace muster::report {
namespace {

namespace pic = plotting;
using Eigen::Index;
using Eigen::VectorXd;

constexpr Index most_dots = 4000;
constexpr double least_side = 1;  // m, of a block

std::vector<int> blocks_for(const Diagnosis& d) {
  return blocks_of(places_of(d.seen), d.time_unit > 0 ? least_side : std::max(3 * d.noise.decorrelation(), least_side));
}

struct Curve {
  std::vector<double> x, mean, low, high;
};

Curve curve_of(const std::vector<Bin>& bins) {
  Curve out;
  for (const Bin& b : bins) {
    out.x.push_back(b.at);
    out.mean.push_back(b.mean);
    out.low.push_back(b.low);
    out.high.push_back(b.high);
  }
  return out;
}

// Dots, spread sideways over names to avoid overlap.
pic::Points dots(const VectorXd& x, const VectorXd& y, bool names) {
  pic::Points out{.colour = pic::light_grey, .radius = 1.5};
  const Index every = std::max<Index>(1, (x.size() + most_dots - 1) / most_dots);
  for (Index i = 0; i < x.size(); i += every) {
    constexpr double golden = 0.6180339887498949;
    const double aside = names ? 0.5 * (std::fmod(static_cast<double>(i) * golden, 1.0) - 0.5) : 0;
    out.x.push_back(x[i] + aside);
    out.y.push_back(y[i]);
  }
  return out;
}

// Limits of the central 99 %, with a margin.
std::pair<double, double> limits_of(const VectorXd& x, const VectorXd& y) {
  std::vector<double> shown;
  for (Index i = 0; i < y.size(); ++i) {
    if (std::isfinite(x[i])) shown.push_back(y[i]);
  }
  if (shown.empty()) return {-1, 1};
  std::sort(shown.begin(), shown.end());
  const auto at = [&](double share) {
    return shown[static_cast<std::size_t>(share * static_cast<double>(shown.size() - 1))];
  };
  return {std::floor(at(0.005) - 1), std::ceil(at(0.995) + 1)};
}

struct Along {
  std::string name, unit, check;  // check: the candidate whose p is in the title
  VectorXd values;
  bool log = false;
  std::vector<std::string> names{};
};

void add_geometry(const diagnosis::RowSummary& rows, std::vector<Along>& out) {
  const Eigen::Matrix3Xd way = rows.tx_at - rows.rx_at;
  out.push_back({"distance", "m", "~logd", way.colwise().norm().transpose().cwiseMax(0.1), true});
  if (rows.t.size()) out.push_back({"time", "s", "~time", rows.t});
  VectorXd from_tx(way.cols());
  for (Index i = 0; i < way.cols(); ++i) from_tx[i] = in_degrees(std::atan2(-way(1, i), -way(0, i)));
  if (rows.heading.size()) {
    out.push_back({"bearing of the other radio", "deg", "~bearing", rows.bearing.unaryExpr(&in_degrees)});
    out.push_back({"heading", "deg", "~heading", rows.heading.unaryExpr(&in_degrees)});
  }
  if (!rows.places_known) return;
  out.push_back({"direction from the transmitter", "deg", "~txbearing", from_tx});
  const Places places = places_of(rows);
  if (!places.vary()) return;
  out.push_back({"x", "m", "~position", places.place.row(0).transpose()});
  out.push_back({"y", "m", "~position", places.place.row(1).transpose()});
  const VectorXd z = places.place.row(2).transpose();
  if (z.maxCoeff() - z.minCoeff() > diagnosis::thresholds::least_climb) out.push_back({"height", "m", "~height", z});
}

std::vector<Along> everything(const diagnosis::RowSummary& rows) {
  std::vector<Along> out;
  add_geometry(rows, out);
  for (const auto& c : rows.columns) out.push_back({c.name, "", "~" + c.name, c.values});
  for (const auto& f : rows.factors) {
    Along along{f.name, "", "~" + f.name, VectorXd(static_cast<Index>(f.level.size()))};
    const int most = f.level.empty() ? 0 : *std::max_element(f.level.begin(), f.level.end());
    for (int k = 0; k <= most; ++k) along.names.push_back(std::to_string(k));
    for (std::size_t i = 0; i < f.level.size(); ++i) along.values[static_cast<Index>(i)] = f.level[i];
    out.push_back(std::move(along));
  }
  return out;
}

std::string chance_of(const Diagnosis& d, const std::string& id) {
  for (const inference::Check& c : d.checks) {
    if (c.id == id) return chance(c.log_p);
  }
  return "";
}

pic::ErrorBars bars_of(const std::vector<Bin>& bins, pic::Colour colour) {
  const Curve c = curve_of(bins);
  return {.x = c.x, .y = c.mean, .low = c.low, .high = c.high, .colour = colour};
}

// Rows of the directions of links that a cause in time ever concerns, such as those of one sender: among all others
// its step would be as small as their share. All rows of another cause.
std::vector<Index> concerned_by(const CauseEstimate& c, const diagnosis::RowSummary& seen) {
  std::set<std::pair<int, int>> links;
  const auto link = [&](Index row) {
    return std::pair(seen.tx[static_cast<std::size_t>(row)], seen.rx[static_cast<std::size_t>(row)]);
  };
  for (Index row = 0; row < c.effect.size(); ++row) {
    if (c.effect[row] != 0 || !c.changes_in_time() || c.effect.isZero(0)) links.insert(link(row));
  }
  std::vector<Index> result;
  for (Index row = 0; row < c.effect.size(); ++row) {
    if (links.count(link(row)) > 0) result.push_back(row);
  }
  return result;
}

}  // namespace

pic::Figure staircase(const Diagnosis& d) {
  pic::ErrorBars bars{.colour = pic::blue};
  pic::Line steps{.colour = pic::blue, .width = 2};
  pic::Panel panel{.y = {.label = "held-out error", .unit = "dB", .from = 0}, .aspect = 0.45};
  for (std::size_t k = 0; k < d.stairs.size(); ++k) {
    const auto x = static_cast<double>(k);
    panel.x.names.push_back(name_of_step(d, k));
    bars.x.push_back(x);
    bars.y.push_back(d.stairs[k].rmse);
    bars.low.push_back(d.stairs[k].lower95);
    bars.high.push_back(d.stairs[k].upper95);
    for (const double side : {-0.5, 0.5}) {
      steps.x.push_back(x + side);
      steps.y.push_back(d.stairs[k].rmse);
    }
  }
  panel.layers = {pic::Rule{.at = noise_floor(d), .label = fmt::format("noise alone, {:.2f} dB", noise_floor(d))},
                  steps, bars};
  return {
      .title = "Error on held-out " + what_is_held_out(d) + ", cause by cause",
      .caption = fmt::format("Root mean square over readings of held-out blocks, {} in all; intervals by resampling "
                             "blocks. A perfect model would come down to the dashed line.",
                             d.held_out ? d.held_out->blocks : 0),
      .panels = {panel}};
}

pic::Figure partial_residual(const Diagnosis& d, const CauseEstimate& c) {
  Abscissa along = abscissa_of(d.seen, c);
  const std::vector<Index> rows = concerned_by(c, d.seen);
  const bool some = static_cast<Index>(rows.size()) < c.effect.size();
  along.values = along.values(rows).eval();
  // An effect set aside is not in the model, so the residual still contains it.
  const VectorXd effect = c.effect(rows), after = d.seen.after(rows);
  const VectorXd partial = confidence_of(c) == Confidence::set_aside ? after : VectorXd(after + effect);
  const auto [low, high] = limits_of(along.values, partial);
  pic::Panel panel{.x = {.label = along.label, .unit = along.unit, .log = along.log, .names = along.names},
                   .y = {.label = "measured − all but this cause", .unit = "dB", .from = low, .to = high},
                   .aspect = 0.45,
                   .legend = true};
  const std::vector<int> of_all = blocks_for(d);
  std::vector<int> block;
  for (const Index row : rows) block.push_back(of_all[static_cast<std::size_t>(row)]);
  panel.layers.emplace_back(dots(along.values, partial, !along.names.empty()));
  panel.layers.emplace_back(pic::Rule{.at = 0});
  if (!along.names.empty()) {
    const auto edges = edges_of_names(along.names.size());
    const Curve fitted = curve_of(means_over(edges, along.values, effect, block));
    panel.layers.emplace_back(
        pic::Points{.x = fitted.x, .y = fitted.mean, .label = "the cause", .colour = pic::vermillion, .radius = 6});
    pic::ErrorBars bars = bars_of(means_over(edges, along.values, partial, block), pic::blue);
    bars.label = "mean and 95 % interval";
    panel.layers.emplace_back(std::move(bars));
  } else {
    const Curve measured = curve_of(means_over(edges_of(along.values, 24, along.log), along.values, partial, block, 3));
    const Curve fitted = curve_of(means_over(edges_of(along.values, 40, along.log), along.values, effect, block, 1));
    panel.layers.emplace_back(pic::Band{.x = measured.x,
                                        .low = measured.low,
                                        .high = measured.high,
                                        .label = "95 % band of the mean",
                                        .colour = pic::blue});
    panel.layers.emplace_back(
        pic::Line{.x = measured.x, .y = measured.mean, .label = "mean of the rows", .colour = pic::blue});
    panel.layers.emplace_back(
        pic::Line{.x = fitted.x, .y = fitted.mean, .label = "the cause", .colour = pic::vermillion, .width = 2});
  }
  std::string title = sentence(c);
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  return {.title = (confidence_of(c) == Confidence::confirmed ? "" : "Suspected: ") + title,
          .caption = std::string("Each dot is a row") + (some ? " of the links that it concerns" : "") +
                     ", less all that the extended world says but for this cause. The band is of the mean over a part "
                     "of the axis, by resampling blocks of space.",
          .panels = {panel}};
}

pic::Figure residual_by_covariate(const Diagnosis& d) {
  pic::Figure figure{
      .title = "What is left along everything that was measured",
      .caption =
          "Means of whitened residuals (in their standard deviation, without what neighbours share) with "
          "95 % intervals. Grey: the world as given; blue: with all that was found. p: that chance alone does as well.",
      .columns = 3,
      .width = 1000,
      .share_y = true};
  for (const Along& along : everything(d.seen)) {
    const auto edges = along.names.empty() ? edges_of(along.values, 12, along.log) : edges_of_names(along.names.size());
    const std::string p = chance_of(d, along.check);
    pic::Panel panel{.title = along.name + (p.empty() || along.name == "x" || along.name == "y" ? "" : ": " + p),
                     .x = {.label = along.name, .unit = along.unit, .log = along.log, .names = along.names},
                     .y = {.label = "whitened residual", .unit = "sd"}};
    panel.layers = {pic::Rule{.at = 0, .dashed = false},
                    bars_of(whitened_means_over(edges, along.values, d.seen.white_before), pic::light_grey),
                    bars_of(whitened_means_over(edges, along.values, d.seen.white_after), pic::blue)};
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

std::vector<Picture> pictures_of(const Diagnosis& d) {
  std::vector<Picture> out;
  if (d.seen.before.size() == 0) return out;
  const bool map = d.seen.places_known && places_of(d.seen).vary();
  if (map) out.push_back({"residual_map", residual_map(d)});
  if (d.stairs.size() > 1) out.push_back({"steps", staircase(d)});
  for (std::size_t k = 0; k < d.causes.size(); ++k) {
    if (d.causes[k].effect.size() == d.seen.after.size())
      out.push_back({fmt::format("cause_{}", k + 1), partial_residual(d, d.causes[k])});
  }
  if (map && !d.stairs.empty() && (d.named() || !d.unexplained.empty()))
    out.push_back({"before_after", before_and_after(d)});
  out.push_back({"covariates", residual_by_covariate(d)});
  return out;
}

}  // namespace muster::report
