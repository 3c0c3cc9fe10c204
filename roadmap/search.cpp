#include "roadmap/search.hpp"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

namespace muster::roadmap {
namespace {

// Neighbours of each place, one after the other.
struct Adjacency {
  std::vector<std::size_t> first;
  std::vector<std::uint32_t> to;

  explicit Adjacency(const Graph& graph) : first(graph.nodes.size() + 1), to(2 * graph.edges.size()) {
    for (const Edge& e : graph.edges) ++first[e.a + 1], ++first[e.b + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    for (const Edge& e : graph.edges) to[next[e.a]++] = e.b, to[next[e.b]++] = e.a;
  }
};

}  // namespace

Found cheapest(const Graph& graph, std::uint32_t from, std::uint32_t to, const Cost& cost, Guide guide) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  constexpr std::uint32_t none = ~0u;
  const Adjacency near(graph);
  std::vector<double> best(graph.nodes.size(), infinite);
  std::vector<std::uint32_t> before(graph.nodes.size(), none);
  std::vector<bool> done(graph.nodes.size());
  const auto left = [&](std::uint32_t at) {
    return guide == Guide::distance ? distance(graph.nodes[at], graph.nodes[to]) : 0;
  };
  using Open = std::pair<double, std::uint32_t>;  // least cost through a place, its number
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  Found result;
  best[from] = 0;
  open.emplace(left(from), from);
  while (!open.empty() && !done[to]) {
    const std::uint32_t at = open.top().second;
    open.pop();
    if (done[at]) continue;
    done[at] = true;
    ++result.expanded;
    for (std::size_t i = near.first[at]; i < near.first[at + 1]; ++i) {
      const std::uint32_t next = near.to[i];
      if (done[next]) continue;
      const double sum = best[at] + cost(graph.nodes[at], graph.nodes[next]);
      if (!(sum < best[next])) continue;
      best[next] = sum;
      before[next] = at;
      open.emplace(sum + left(next), next);
    }
  }
  if (!done[to]) return result;
  result.cost = best[to];
  for (std::uint32_t at = to; at != none; at = before[at]) result.nodes.push_back(at);
  std::reverse(result.nodes.begin(), result.nodes.end());
  return result;
}

}  // namespace muster::roadmap
