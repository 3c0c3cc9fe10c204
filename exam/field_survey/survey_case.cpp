#include "exam/field_survey/survey_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "exam/field_survey/information.hpp"
#include "exam/field_survey/reading_laws.hpp"

namespace muster::exam::survey {
namespace {

Campaign campaign_of(const std::string& style, Draws& draws) {
  if (style == "mesh") return mesh(draws);
  if (style == "walk") return walk(draws);
  if (style == "drive") return drive(draws);
  return flat(draws);
}

int effects_of(const Request& request, const std::string& style, Draws& draws) {
  static const std::vector<std::string> words{"clean", "one", "two", "three", "four"};
  if (!request.kinds.empty()) {
    const std::string& word = draws.one_of(request.kinds);
    return static_cast<int>(std::find(words.begin(), words.end(), word) - words.begin());
  }
  const double u = draws.unit();
  // The flat is made for its missing wall.
  if (request.style == "flat" && style == "flat") return u < 0.2 ? 0 : 1;
  return u < 0.2 ? 0 : u < 0.3 ? 1 : u < 0.55 ? 2 : u < 0.8 ? 3 : 4;
}

// Effects that would hide or contradict one another in one campaign.
bool exclude(const std::string& a, const std::string& b) {
  static const std::vector<std::set<std::string>> once{{"tx_misplaced", "label_swap", "labels_shifted"},
                                                       {"plan_mirrored", "unmapped_wall", "wall_absent"},
                                                       {"rssi_saturation", "rssi_compression"},
                                                       {"outliers", "people"},
                                                       {"two_ray", "dual_slope"},
                                                       {"antenna_tx", "sector_antenna"}};
  return a == b || std::any_of(once.begin(), once.end(),
                               [&](const auto& group) { return group.contains(a) && group.contains(b); });
}

std::vector<Planted> draw_effects(const Request& request, const Campaign& campaign, int count, Draws& draws) {
  std::vector<Planted> planted;
  std::vector<Kind> order = kinds();
  draws.shuffle(order);
  // A flat has been laid out for its missing wall.
  if (campaign.style == "flat")
    std::stable_partition(order.begin(), order.end(),
                          [](const Kind& k) { return k.id == std::string("unmapped_wall"); });
  for (const Kind& kind : order) {
    if (static_cast<int>(planted.size()) >= count) break;
    if (!request.effects.empty() &&
        std::find(request.effects.begin(), request.effects.end(), kind.id) == request.effects.end())
      continue;
    if (std::any_of(planted.begin(), planted.end(), [&](const Planted& p) { return exclude(p.id, kind.id); })) continue;
    if (auto effect = kind.draw(campaign, draws)) {
      effect->in_vocabulary = kind.in_vocabulary;
      planted.push_back(std::move(*effect));
    }
  }
  return planted;
}

struct View {
  Scene map, truth;
};

View view_without(const Made& made, const Planted* left_out) {
  View view{made.campaign.scene, made.campaign.scene};
  for (const Planted& p : made.planted)
    if (&p != left_out) p.apply(view.map, view.truth);
  return view;
}

double received(const Scene& truth, double level) {
  for (const auto& stage : truth.receiver)
    if (!std::isnan(level)) level = stage(level);
  return level;
}

// Mean of what the receiver reports, where it reports at all.
double mean_report(const Scene& truth, double level) {
  if (truth.receiver.empty()) return level;
  const Scatter& s = truth.scatter;
  const double sd = std::sqrt(s.shadowing * s.shadowing + s.frozen * s.frozen + s.reading * s.reading);
  double sum = 0, weight = 0;
  constexpr int points = 61;
  for (int i = 0; i < points; ++i) {
    const double z = -4 + 8.0 * i / (points - 1), report = received(truth, level + z * sd);
    if (std::isnan(report)) continue;
    sum += std::exp(-z * z / 2) * report;
    weight += std::exp(-z * z / 2);
  }
  return weight > 0 ? sum / weight : level;
}

// What the map errs by, in the mean of each reading.
Eigen::VectorXd error_of(const Made& made, const View& view) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(made.campaign.rows.size()));
  for (std::size_t i = 0; i < made.campaign.rows.size(); ++i) {
    const Row& row = made.campaign.rows[i];
    result[static_cast<Eigen::Index>(i)] =
        mean_report(view.truth, mean_level(view.truth, row)) - mean_level(view.map, row);
  }
  return result;
}

void weigh(Made& made) {
  std::vector<char> used;
  for (const double v : made.rssi) used.push_back(!std::isnan(v));
  const Covariance covariance(made.campaign, made.truth.scatter, used);
  const Eigen::VectorXd all = error_of(made, {made.map, made.truth});
  const Eigen::MatrixXd base = map_columns(made.map, made.campaign.rows);
  Eigen::MatrixXd columns(all.size(), base.cols() + static_cast<Eigen::Index>(made.planted.size()));
  columns.leftCols(base.cols()) = base;
  for (std::size_t k = 0; k < made.planted.size(); ++k)
    columns.col(base.cols() + static_cast<Eigen::Index>(k)) =
        all - error_of(made, view_without(made, &made.planted[k]));
  const Eigen::MatrixXd white = covariance.whitened(columns);
  for (std::size_t k = 0; k < made.planted.size(); ++k) {
    const Eigen::Index own = base.cols() + static_cast<Eigen::Index>(k);
    Eigen::MatrixXd others(white.rows(), white.cols() - 1);
    others << white.leftCols(own), white.rightCols(white.cols() - own - 1);
    made.planted[k].lambda =
        made.planted[k].acts == "reading_law"
            ? law_lambda(made.campaign, made.truth, made.planted[k].id, used)
            : unexplained_energy(white.col(own), others) + missing_lambda(made.truth, made.planted[k].id, made);
  }
}

// No receiver gives more or less, whatever heavy tails draw. NaN: nothing received.
double possible(double level) { return std::clamp(level, -150.0, 20.0); }

// 0 and -128 are marks of a missing reading in many receivers, and are not used for a level.
double code_of(double level, double step) {
  const double code = std::round(level / step) * step;
  return code == 0 || code == -128 ? code + step : code;
}

void read_levels(Made& made, std::uint64_t seed) {
  const std::vector<char> every(made.campaign.rows.size(), 1);
  Draws cells(seed, "cells"), readings(seed, "readings"), passages(seed, "passages");
  Scene& truth = made.truth;
  const Eigen::VectorXd frozen = made.request.noiseless
                                     ? Eigen::VectorXd::Zero(static_cast<Eigen::Index>(made.campaign.rows.size()))
                                     : Covariance(made.campaign, truth.scatter, every).draw_cells(cells);
  const std::vector<double> blocked = blockage(made.campaign, truth, passages);
  for (std::size_t i = 0; i < made.campaign.rows.size(); ++i) {
    const Row& row = made.campaign.rows[i];
    double level = mean_level(truth, row) - blocked[i] + frozen[row.cell];
    if (!made.request.noiseless) level += draw_error(truth.scatter, readings);
    level = possible(received(truth, level));
    if (!made.request.noiseless && truth.scatter.step > 0) level = code_of(level, truth.scatter.step);
    made.rssi.push_back(level);
  }
}

}  // namespace

const std::vector<std::string>& styles() {
  static const std::vector<std::string> all{"flat", "mesh", "walk", "drive"};
  return all;
}

Made make(const Request& request, int number) {
  const std::uint64_t seed = Draws(request.seed, fmt::format("case {}", number)).next64();
  Draws draws(seed, "campaign"), choice(seed, "effects");
  Made made;
  made.name = fmt::format("case_{:04}", number);
  made.request = request;
  const std::string style = request.style.empty() ? draws.one_of(styles()) : request.style;
  made.campaign = campaign_of(style, draws);
  const int count = effects_of(request, style, choice);
  made.planted = draw_effects(request, made.campaign, count, choice);
  View view = view_without(made, nullptr);
  made.map = std::move(view.map);
  made.truth = std::move(view.truth);
  made.drops_missed = choice.flip();
  read_levels(made, seed);
  weigh(made);
  return made;
}

}  // namespace muster::exam::survey
