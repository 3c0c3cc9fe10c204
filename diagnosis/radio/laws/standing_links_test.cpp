#include "diagnosis/radio/laws/standing_links_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "diagnosis/data/median.hpp"
#include "diagnosis/radio/thresholds.hpp"
#include "muster/random.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// One direction of a link: its readings in order of time.
struct Link {
  int tx, rx;
  std::vector<Index> readings;
};

bool stands(const Eigen::Matrix3Xd& at, const std::vector<Index>& readings) {
  return std::all_of(readings.begin(), readings.end(), [&](Index i) {
    return (at.col(i) - at.col(readings.front())).norm() < thresholds::stands_within;
  });
}

class Network {
 public:
  Network(const LinkReadings& readings, const VectorXd& residual) : r_(readings), off_(residual) {
    std::map<std::pair<int, int>, std::vector<Index>> by_link;
    for (Index i = 0; i < residual.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (std::isfinite(residual[i])) by_link[{r_.tx[k], r_.rx[k]}].push_back(i);
    }
    for (auto& [ends, of_link] : by_link) {
      if (of_link.size() < thresholds::fewest_link_rows || !stands(r_.tx_at, of_link) || !stands(r_.rx_at, of_link))
        continue;
      std::stable_sort(of_link.begin(), of_link.end(), [&](Index a, Index b) { return time(a) < time(b); });
      links_.push_back({ends.first, ends.second, std::move(of_link)});
    }
    leave_lonely_links_out();
    about_their_means();
    level_ = off_;
    take_off_what_radios_share([](const Link& link) { return link.tx; });
    take_off_what_radios_share([](const Link& link) { return link.rx; });
  }

  const std::vector<Link>& links() const { return links_; }
  double time(Index i) const { return r_.t[static_cast<std::size_t>(i)]; }
  // dB, about the link's mean; and without what its radios share.
  double level(Index i) const { return level_[i]; }
  double off(Index i) const { return off_[i]; }

 private:
  void about_their_means() {
    for (const Link& link : links_) {
      double mean = 0;
      for (const Index i : link.readings) mean += off_[i] / static_cast<double>(link.readings.size());
      for (const Index i : link.readings) off_[i] -= mean;
    }
  }

  // Until each transmitter and each receiver has at least four links.
  void leave_lonely_links_out() {
    for (std::size_t before = links_.size() + 1; links_.size() < before;) {
      before = links_.size();
      std::map<int, std::size_t> sent, heard;
      for (const Link& link : links_) ++sent[link.tx], ++heard[link.rx];
      const auto lonely = [&](const Link& link) {
        return std::min(sent[link.tx], heard[link.rx]) <= thresholds::fewest_other_links;
      };
      links_.erase(std::remove_if(links_.begin(), links_.end(), lonely), links_.end());
    }
  }

  // Less the median of what other links of the same radio are off at that moment. Of another link each reading counts
  // for the nearest one in time alone: what two readings are both compared with, they would share. A reading with too
  // few others at that moment is left out.
  template <class Radio>
  void take_off_what_radios_share(const Radio& radio) {
    VectorXd left = off_;
    for (Link& link : links_) {
      std::vector<std::vector<double>> others(link.readings.size());
      for (const Link& other : links_) {
        if (&other == &link || radio(other) != radio(link)) continue;
        std::size_t nearest = 0;
        for (const Index i : other.readings) {
          while (nearest + 1 < link.readings.size() && std::abs(time(link.readings[nearest + 1]) - time(i)) <=
                                                           std::abs(time(link.readings[nearest]) - time(i)))
            ++nearest;
          if (std::abs(time(link.readings[nearest]) - time(i)) <= thresholds::same_moment)
            others[nearest].push_back(off_[i]);
        }
      }
      for (std::size_t k = 0; k < others.size(); ++k) {
        left[link.readings[k]] = others[k].size() < thresholds::fewest_other_links
                                     ? std::nan("")
                                     : off_[link.readings[k]] - median(others[k]);
      }
    }
    off_ = std::move(left);
    for (Link& link : links_) {
      const auto alone = [&](Index i) { return std::isnan(off_[i]); };
      link.readings.erase(std::remove_if(link.readings.begin(), link.readings.end(), alone), link.readings.end());
    }
    links_.erase(std::remove_if(links_.begin(), links_.end(),
                                [](const Link& link) { return link.readings.size() < thresholds::fewest_link_rows; }),
                 links_.end());
    about_their_means();
  }

  const LinkReadings& r_;
  VectorXd off_, level_;
  std::vector<Link> links_;
};

// Two readings of a link, by their places in its order.
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

// Each reading with the first one that is at least `least` and at most `most` seconds, and `steps` readings, later.
Pairs later(const Network& network, const Link& link, double least, double most, std::size_t steps) {
  Pairs result;
  std::size_t next = 0;
  for (std::size_t i = 0; i < link.readings.size(); ++i) {
    const double at = network.time(link.readings[i]);
    for (next = std::max(next, i + steps); next < link.readings.size(); ++next) {
      if (network.time(link.readings[next]) >= at + least) break;
    }
    if (next == link.readings.size()) break;
    if (network.time(link.readings[next]) <= at + most) result.emplace_back(i, next);
  }
  return result;
}

// What pairs of one link's readings share.
struct Shared {
  double pairs = 0, product = 0, skewed = 0, apart = 0;  // sums of dB^2, of dB^3 and of s

  void operator+=(const Shared& b) {
    pairs += b.pairs;
    product += b.product;
    skewed += b.skewed;
    apart += b.apart;
  }
};

// Sums over readings of a link, winsorised and scaled.
struct Ordered {
  double order = 0, order_variance = 0;  // of products of successive readings
  double fast = 0, fast_variance = 0;    // the same, less products of readings that are far apart in time

  void operator+=(const Ordered& b) {
    order += b.order;
    order_variance += b.order_variance;
    fast += b.fast;
    fast_variance += b.fast_variance;
  }
  // The smaller of both, in standard errors.
  double z() const {
    return order_variance > 0 && fast_variance > 0
               ? std::min(order / std::sqrt(order_variance), fast / std::sqrt(fast_variance))
               : 0;
  }
};

struct OfLink {
  Ordered ordered;
  Shared next, second;  // successive readings; and every other one
};

Shared shared_by(const Network& network, const Link& link, const Pairs& pairs, double most) {
  Shared result;
  for (const auto& [a, b] : pairs) {
    const auto value = [&](std::size_t k) { return std::clamp(network.level(link.readings[k]), -most, most); };
    result += {1, value(a) * value(b), (value(a) + value(b)) / 2 * value(a) * value(b),
               network.time(link.readings[b]) - network.time(link.readings[a])};
  }
  return result;
}

OfLink of_link(const Network& network, const Link& link) {
  const std::size_t n = link.readings.size();
  std::vector<double> values(n);
  std::transform(link.readings.begin(), link.readings.end(), values.begin(), [&](Index i) { return network.off(i); });
  const double middle = median(values);
  std::vector<double> sizes(n);
  std::transform(values.begin(), values.end(), sizes.begin(), [&](double v) { return std::abs(v - middle); });
  const double sd = std::max(median(sizes) / thresholds::normal_quartile, thresholds::least_scatter);
  double mean = 0, square = 0;
  for (double& v : values) {
    v = std::clamp((v - middle) / sd, -thresholds::winsorised_errors, thresholds::winsorised_errors);
    mean += v / static_cast<double>(n);
  }
  for (double& v : values) {
    v -= mean;
    square += v * v / static_cast<double>(n);
  }
  OfLink result;
  const double chance = -square / static_cast<double>(n - 1);  // of two readings in any order
  const Pairs next = later(network, link, 1e-6, thresholds::crossing_reach, 1);
  for (const auto& [a, b] : next) result.ordered.order += values[a] * values[b] - chance;
  result.ordered.order_variance = static_cast<double>(next.size()) * square * square;
  std::map<std::size_t, std::size_t> far;
  for (const auto& [a, b] : later(network, link, thresholds::slow_change, 3 * thresholds::slow_change, 1)) far[a] = b;
  for (const auto& [a, b] : next) {
    const auto slow = far.find(a);
    if (slow == far.end()) continue;
    result.ordered.fast += values[a] * (values[b] - values[slow->second]);
    result.ordered.fast_variance += 2 * square * square;
  }
  const double most = thresholds::farthest_blocked * sd;
  result.next = shared_by(network, link, next, most);
  result.second = shared_by(network, link, later(network, link, 1e-6, 2 * thresholds::crossing_reach, 2), most);
  return result;
}

// Loss, share of time and duration of the process of two states that has these moments: its variance is
// loss^2 share (1 - share), its third moment that times -loss (1 - 2 share), and what two of its readings share falls
// to nothing over one duration. Each of the `links` is about its own mean, which takes of its variance the share that
// one crossing has of its time, and thrice that of its third moment.
std::array<double, 3> crossings_of(const Shared& next, const Shared& second, double links) {
  const double first = next.product / next.pairs, later = second.product / second.pairs;
  const double gap = next.apart / next.pairs, step = second.apart / second.pairs - gap;
  const double slope = step > 0 ? std::max((first - later) / step, 0.0) : 0;
  const double rough = first + slope * gap;
  const double duration = slope > 0 ? std::min(rough / slope, thresholds::slow_change) : thresholds::slow_change;
  const double by_mean = std::min(duration * links / next.apart, 0.2);
  const double variance = std::max(rough * (1 + by_mean), 0.0);
  const double lopsided = -(next.skewed / next.pairs) * (1 + 3 * by_mean) / std::max(first + by_mean * variance, 1e-9);
  const double loss = std::sqrt(lopsided * lopsided + 4 * variance);
  return {loss, loss > 0 ? (1 - lopsided / loss) / 2 : 0, duration};
}

// Of all pairs of radios but the one that changes most: what moves beside one link alone does not walk about.
double z_of_all_but_the_first(const std::map<std::pair<int, int>, Ordered>& both_ways) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [left_out, ordered] : both_ways) {
    Ordered others;
    for (const auto& [radios, one] : both_ways) {
      if (radios != left_out) others += one;
    }
    least = std::min(least, others.z());
  }
  return least;
}

constexpr std::array names{"loss", "share", "duration"};

std::vector<LawValue> values_of(const std::vector<OfLink>& links) {
  const auto of = [&](const auto& number) {
    Shared next, second;
    for (std::size_t k = 0; k < links.size(); ++k) {
      const OfLink& link = links[number(k)];
      next += link.next;
      second += link.second;
    }
    return crossings_of(next, second, static_cast<double>(links.size()));
  };
  const auto value = of([](std::size_t k) { return k; });
  constexpr std::size_t draws = 400;
  std::array<std::vector<double>, names.size()> drawn;
  const Stream stream(key_of("links drawn"));
  for (std::size_t d = 0; d < draws; ++d) {
    const auto one = of([&](std::size_t k) {
      return std::min(static_cast<std::size_t>(stream.uniform(d, k) * static_cast<double>(links.size())),
                      links.size() - 1);
    });
    for (std::size_t v = 0; v < one.size(); ++v) drawn[v].push_back(one[v]);
  }
  std::vector<LawValue> result;
  for (std::size_t v = 0; v < names.size(); ++v) {
    std::sort(drawn[v].begin(), drawn[v].end());
    result.push_back({names[v], value[v], drawn[v][draws / 40], drawn[v][draws - 1 - draws / 40]});
  }
  return result;
}

}  // namespace

WalkersTest walkers_test(const LinkReadings& readings, const VectorXd& residual) {
  WalkersTest result;
  if (readings.t.empty()) return result;
  const Network network(readings, residual);
  // Of two readings that share their scatter, too, one counts.
  std::set<Index> in_links;
  for (const Link& link : network.links()) in_links.insert(link.readings.begin(), link.readings.end());
  const auto counts_twice = [&](Index i) {
    const auto k = static_cast<std::size_t>(i);
    return !readings.twin.empty() && readings.tx[k] > readings.rx[k] && in_links.count(readings.twin[k]) > 0;
  };
  std::vector<OfLink> links;
  std::map<std::pair<int, int>, Ordered> both_ways;
  for (Link link : network.links()) {
    std::erase_if(link.readings, counts_twice);
    if (link.readings.size() < thresholds::fewest_link_rows) continue;
    const OfLink one = of_link(network, link);
    if (one.next.pairs == 0 || one.second.pairs == 0 || one.ordered.fast_variance == 0) continue;
    links.push_back(one);
    both_ways[std::minmax(link.tx, link.rx)] += one.ordered;
  }
  result.links = links.size();
  if (both_ways.size() < 2) return result;
  const double z = z_of_all_but_the_first(both_ways);
  result.test.log_p = std::log(std::max(std::erfc(z / std::sqrt(2.0)) / 2, 1e-300));
  result.test.gain = z > 0 ? z * z : 0;
  result.test.evidence = result.test.gain / 2;
  if (z > 0) result.test.values = values_of(links);
  return result;
}

}  // namespace muster::diagnosis
