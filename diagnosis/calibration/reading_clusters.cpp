#include "diagnosis/calibration/reading_clusters.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>

namespace muster::diagnosis {
namespace {

using Key = std::array<long, 8>;

Key key_of(const LinkPlace& link, double side) {
  Key key{link.radio_a, link.radio_b};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<Eigen::Index>(axis);
    key[2 + axis] = std::lround(link.a[k] / side);
    key[5 + axis] = std::lround(link.b[k] / side);
  }
  return key;
}

// Numbers clusters in order of their keys, independent of the order of rows in a file.
std::map<Key, int> numbered(const std::vector<LinkPlace>& links, double side) {
  std::map<Key, int> result;
  for (const LinkPlace& link : links) result.emplace(key_of(link, side), 0);
  int next = 0;
  for (auto& [key, number] : result) number = next++;
  return result;
}

}  // namespace

LinkPlace place_of(const std::array<End, 2>& ends) {
  const bool swapped = ends[1].radio < ends[0].radio;
  const End &a = ends[swapped ? 1 : 0], &b = ends[swapped ? 0 : 1];
  return {{a.x, a.y, a.z}, {b.x, b.y, b.z}, a.radio, b.radio};
}

Clusters clusters_of(const std::vector<LinkPlace>& links, std::size_t most) {
  most = std::min(most, links.size() / 4 + 2);
  double side = 0.1;  // m
  std::map<Key, int> number = numbered(links, side);
  for (; number.size() > most && side < 1e5; side *= 1.25) number = numbered(links, 1.25 * side);
  Clusters result;
  result.size.resize(number.size());
  result.examples.resize(number.size());
  std::vector<std::size_t> seen(number.size());
  for (const LinkPlace& link : links) {
    const auto c = static_cast<std::size_t>(number.at(key_of(link, side)));
    result.of_row.push_back(static_cast<int>(c));
    ++result.size[c];
  }
  for (std::size_t i = 0; i < links.size(); ++i) {  // evenly over each cluster's rows
    const auto c = static_cast<std::size_t>(result.of_row[i]);
    const auto each = std::max<std::size_t>(1, static_cast<std::size_t>(result.size[c]) / 4);
    if (seen[c]++ % each == 0 && result.examples[c].size() < 4) result.examples[c].push_back(links[i]);
  }
  return result;
}

}  // namespace muster::diagnosis
