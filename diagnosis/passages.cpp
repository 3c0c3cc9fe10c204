#include "diagnosis/passages.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace muster::diagnosis {
namespace {

using Eigen::Index;

constexpr std::array durations{2.0, 4.0, 7.0};                     // s
constexpr std::array losses{2.0, 3.0, 4.5, 6.5, 9.0, 13.0, 18.0};  // dB
constexpr std::array shares{0.03, 0.07, 0.14, 0.25};

// A window's whitened indicator: what it has in common with what is left, and its energy.
struct Window {
  double score, energy;
};

struct Found {
  double gain = 0, loss = 0, share = 0, duration = 0;  // gain in nats
};

double log_ratio(const std::vector<Window>& windows, double loss, double share) {
  double sum = 0;
  for (const Window& w : windows)
    sum += std::log1p(share * std::expm1(std::min(-loss * w.score - loss * loss * w.energy / 2, 600.0)));
  return sum;
}

std::vector<Window> windows_of(const search::Stand& stand, Index rows, const std::map<long, std::vector<Index>>& cut) {
  std::vector<Window> result;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(rows, static_cast<Index>(cut.size()));
  Index k = 0;
  for (const auto& [number, members] : cut) {
    for (const Index row : members) columns(row, k) = 1;
    ++k;
  }
  const Eigen::MatrixXd white = stand.at.basis.rest(stand.whitener(columns));
  for (Index j = 0; j < white.cols(); ++j)
    result.push_back({white.col(j).dot(stand.at.residual), white.col(j).squaredNorm()});
  return result;
}

// Of a row: its readings' mean time.
Eigen::VectorXd times_of(const search::Bench& bench) {
  const auto& t = bench.problem().readings.t;
  return bench.rows().mean(Eigen::Map<const Eigen::VectorXd>(t.data(), static_cast<Index>(t.size())));
}

Found best_of(const search::Stand& stand, const Eigen::VectorXd& t, const std::vector<Index>& members) {
  Found best;
  for (const double duration : durations) {
    std::map<long, std::vector<Index>> cut;
    for (const Index row : members) cut[std::lround(std::floor(t[row] / duration))].push_back(row);
    const std::vector<Window> windows = windows_of(stand, t.size(), cut);
    for (const double loss : losses) {
      for (const double share : shares) {
        const double gain = log_ratio(windows, loss, share);
        if (gain > best.gain) best = {gain, loss, share, duration};
      }
    }
  }
  return best;
}

}  // namespace

Passages passages_of(const search::Bench& bench) {
  const search::Stand stand = bench.stand(bench.design());
  const Eigen::VectorXd t = times_of(bench);
  const noise::Readings& r = bench.problem().readings;
  std::map<std::pair<int, int>, std::vector<Index>> links;
  for (Index row = 0; row < bench.rows().size(); ++row) {
    const auto i = static_cast<std::size_t>(bench.rows().example(row));
    links[std::minmax(r.tx[i], r.rx[i])].push_back(row);
  }
  Passages result;
  Found best;
  double second = 0;
  for (const auto& [link, members] : links) {
    if (members.size() < 40) continue;
    const Found found = best_of(stand, t, members);
    if (found.gain <= best.gain) {
      second = std::max(second, found.gain);
      continue;
    }
    second = best.gain;
    best = found;
    result.radio = link.first;
    result.other = link.second;
  }
  const double tests = static_cast<double>(links.size() * durations.size() * losses.size() * shares.size());
  LawTest& test = result.test;
  test.cause = "effect.people";
  // Neighbouring entries of the grids bound each value.
  test.values = {{"loss", best.loss, best.loss / 1.4, best.loss * 1.4},
                 {"share", best.share, best.share / 2, std::min(1.0, best.share * 2)},
                 {"duration", best.duration, best.duration / 2, best.duration * 2}};
  test.gain = 2 * std::max(0.0, best.gain - second);
  test.evidence = test.gain / 2 - std::log(tests);
  test.log_p = std::min(0.0, -test.evidence);
  return result;
}

}  // namespace muster::diagnosis
