#include "exam/field_survey/reading_laws.hpp"

#include <algorithm>
#include <map>
#include <numbers>

namespace muster::exam::survey {
namespace {

// Log density of Student's t, scaled to sd 1.
double log_student(double x, double freedom) {
  const double scale = std::sqrt((freedom - 2) / freedom), z = x / scale;
  return std::lgamma((freedom + 1) / 2) - std::lgamma(freedom / 2) - std::log(freedom * std::numbers::pi) / 2 -
         std::log(scale) - (freedom + 1) / 2 * std::log1p(z * z / freedom);
}

double log_normal(double x, double mean, double sd) {
  const double z = (x - mean) / sd;
  return -z * z / 2 - std::log(sd) - std::log(2 * std::numbers::pi) / 2;
}

// KL(Student || Gaussian of the same variance), by the midpoint rule.
double divergence(double freedom) {
  double sum = 0;
  constexpr double step = 0.01, reach = 400;
  for (double x = -reach + step / 2; x < reach; x += step) {
    const double p = log_student(x, freedom);
    sum += std::exp(p) * (p - log_normal(x, 0, 1)) * step;
  }
  return sum;
}

// The same for so many readings of a place, of sd 1, with a level in common that is known to this sd: by simulation.
double divergence(double freedom, double level, int readings) {
  constexpr int draws_each = 20000, points = 120;
  Draws draws(1, "tails");
  const Scatter scatter{.reading = 1, .freedom = freedom};
  const double n = readings, shrunk = level * level / (1 + n * level * level);
  double sum = 0;
  std::vector<double> x(static_cast<std::size_t>(readings));
  for (int k = 0; k < draws_each; ++k) {
    const double at = level * draws.gauss();
    double total = 0, squares = 0;
    for (double& one : x) {
      one = at + draw_error(scatter, draws);
      total += one, squares += one * one;
    }
    double heavy = 0;
    const double step = 12 * level / points;
    for (int i = 0; i < points; ++i) {
      const double mean = step * (i + 0.5) - 6 * level;
      double p = log_normal(mean, 0, level);
      for (const double one : x) p += log_student(one - mean, freedom);
      heavy += step * std::exp(p);
    }
    // Woodbury's identity for the covariance 1 + level^2, all with all.
    const double light = -(squares - shrunk * total * total) / 2 - std::log1p(n * level * level) / 2 -
                         n * std::log(2 * std::numbers::pi) / 2;
    sum += (std::log(heavy) - light) / draws_each;
  }
  return sum;
}

bool on_link(const Row& row, const Passers& passers) {
  return (row.tx == passers.radio && row.rx == passers.other) || (row.tx == passers.other && row.rx == passers.radio);
}

// Log likelihood of readings at times under a two-state chain (forward algorithm).
double chain_likelihood(const std::vector<double>& t, const std::vector<double>& x, const Passers& p, double sd) {
  double clear = 1 - p.share, sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i > 0) {
      const double stay = std::exp(-(t[i] - t[i - 1]) / (p.duration * (1 - p.share)));
      clear = stay * clear + (1 - stay) * (1 - p.share);
    }
    const double a = std::log(clear) + log_normal(x[i], 0, sd), b = std::log1p(-clear) + log_normal(x[i], -p.loss, sd);
    const double top = std::max(a, b), both = std::exp(a - top) + std::exp(b - top);
    sum += top + std::log(both);
    clear = std::clamp(std::exp(a - top) / both, 1e-12, 1 - 1e-12);
  }
  return sum;
}

double people_lambda(const Campaign& campaign, const Scene& truth, const Passers& passers,
                     const std::vector<char>& used) {
  constexpr int campaigns = 24;
  Draws draws(1, "people");
  double sum = 0;
  for (int c = 0; c < campaigns; ++c) {
    const std::vector<double> loss = blockage(campaign, truth, draws);
    std::vector<double> t, x;
    for (std::size_t i = 0; i < campaign.rows.size(); ++i) {
      if (!used[i] || !on_link(campaign.rows[i], passers)) continue;
      t.push_back(campaign.rows[i].t);
      x.push_back(truth.scatter.reading * draws.gauss() - loss[i]);
    }
    if (x.size() < 3) return 0;
    double mean = 0, square = 0;
    for (const double v : x) mean += v / static_cast<double>(x.size());
    for (const double v : x) square += (v - mean) * (v - mean) / static_cast<double>(x.size());
    double plain = 0;
    for (const double v : x) plain += log_normal(v, mean, std::sqrt(square));
    sum += 2 * (chain_likelihood(t, x, passers, truth.scatter.reading) - plain) / campaigns;
  }
  return std::max(sum, 0.0);
}

}  // namespace

double draw_error(const Scatter& scatter, Draws& draws) {
  if (scatter.freedom == 0) return scatter.reading * draws.gauss();
  // A normal over the root of a chi square of `freedom` terms, itself a sum of squares: `freedom` is whole.
  double square = 0;
  for (int i = 0; i < static_cast<int>(scatter.freedom); ++i) {
    const double g = draws.gauss();
    square += g * g;
  }
  return scatter.reading * std::sqrt((scatter.freedom - 2) / scatter.freedom) * draws.gauss() /
         std::sqrt(square / scatter.freedom);
}

std::vector<double> blockage(const Campaign& campaign, const Scene& truth, Draws& draws) {
  std::vector<double> result(campaign.rows.size(), 0);
  for (const Passers& p : truth.passers) {
    // Passages last `duration` on average; between them the link is clear so long that they take `share` of time.
    const double clear = p.duration * (1 - p.share) / p.share, end = campaign.rows.back().t + 1;
    bool inside = draws.flip(p.share);
    double from = campaign.rows.front().t;
    while (from < end) {
      const double to = from - std::log(draws.unit()) * (inside ? p.duration : clear);
      if (inside)
        for (std::size_t i = 0; i < campaign.rows.size(); ++i)
          if (on_link(campaign.rows[i], p) && campaign.rows[i].t >= from && campaign.rows[i].t < to) result[i] = p.loss;
      inside = !inside;
      from = to;
    }
  }
  return result;
}

double law_lambda(const Campaign& campaign, const Scene& truth, const std::string& effect,
                  const std::vector<char>& used) {
  if (effect == "people") {
    double sum = 0;
    for (const Passers& p : truth.passers) sum += people_lambda(campaign, truth, p, used);
    return sum;
  }
  const Scatter& s = truth.scatter;
  const double level = std::sqrt(s.frozen * s.frozen + s.shadowing * s.shadowing) / s.reading;
  std::map<int, int> readings;  // of a cell
  for (std::size_t i = 0; i < campaign.rows.size(); ++i) readings[campaign.rows[i].cell] += used[i] ? 1 : 0;
  const double alone = divergence(s.freedom);
  constexpr int enough = 6;  // readings that tell their level
  std::map<int, double> known;
  double sum = 0;
  for (const auto& [cell, n] : readings) {
    if (level == 0 || n == 0) {
      sum += 2 * n * alone;
      continue;
    }
    const auto [at, first] = known.try_emplace(std::min(n, enough), 0);
    if (first) at->second = divergence(s.freedom, level, at->first);
    sum += 2 * (at->second + std::max(0, n - enough) * alone);
  }
  return sum;
}

double missing_lambda(const Scene& truth, const std::string& effect, const Made& made) {
  if (effect != "rssi_floor" || made.drops_missed) return 0;
  const Scatter& s = truth.scatter;
  const double sd = std::sqrt(s.shadowing * s.shadowing + s.frozen * s.frozen + s.reading * s.reading);
  // Repeats share what is frozen: the pattern counts once a cell.
  double sum = 0, missed = 0;
  std::vector<double> chance;
  std::vector<char> seen(made.campaign.rows.size(), 0);
  const bool shares = s.frozen > 0 || s.shadowing > 0;
  for (const Row& row : made.campaign.rows) {
    char& cell = seen[static_cast<std::size_t>(row.cell)];
    if (shares && cell) continue;
    cell = 1;
    const double level = mean_level(truth, row);
    double heard = 0, all = 0;
    constexpr int points = 61;
    for (int i = 0; i < points; ++i) {
      const double z = -4 + 8.0 * i / (points - 1);
      double report = level + z * sd;
      for (const auto& stage : truth.receiver)
        if (!std::isnan(report)) report = stage(report);
      all += std::exp(-z * z / 2);
      if (!std::isnan(report)) heard += std::exp(-z * z / 2);
    }
    chance.push_back(1 - heard / all);
    missed += chance.back();
  }
  missed /= static_cast<double>(chance.size());
  const auto information = [](double p, double q) { return p > 0 && q > 0 ? p * std::log(p / q) : 0.0; };
  for (const double p : chance) sum += 2 * (information(p, missed) + information(1 - p, 1 - missed));
  return sum;
}

}  // namespace muster::exam::survey
