// Links through meshes: one ray at a time, as radio.meshes casts them, against Embree's packets and streams of the same
// rays over the same boxes, with the same exact answer to whether a link crosses a triangle. Both sides in one run, by
// the CPU time of this process, counts compared. Counters: ns a link.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>

#include "cpu_seconds.hpp"
#include "embree_meshes.hpp"
#include "muster/random.hpp"
#include "plugins/radio_meshes/mesh_scene.hpp"

namespace {

using namespace muster;
using bench::cpu_seconds;

constexpr double steps = 4096;  // a metre

Vector at(double x, double y, double z) {
  return {std::llround(steps * x), std::llround(steps * y), std::llround(steps * z)};
}

// Upright prisms of so many sides, as columns and machines stand in a hall of 60 x 40 m.
std::vector<Triangle> prisms(std::size_t number, int sides) {
  const Stream random(1);
  std::vector<Triangle> result;
  for (std::size_t i = 0; i < number; ++i) {
    const double x = 60 * random.uniform(i, 0), y = 40 * random.uniform(i, 1);
    const double radius = 0.3 + random.uniform(i, 2), top = 1 + 2 * random.uniform(i, 3);
    const auto corner = [&](int side, double z) {
      const double angle = 6.283185307179586 * side / sides;
      return at(x + radius * std::cos(angle), y + radius * std::sin(angle), z);
    };
    for (int side = 0; side < sides; ++side) {
      const Vector a = corner(side, 0), b = corner(side + 1, 0), c = corner(side + 1, top), d = corner(side, top);
      for (const Triangle& each : {Triangle{a, b, c}, {a, c, d}, {at(x, y, 0), b, a}, {at(x, y, top), d, c}})
        result.push_back(each);
    }
  }
  return result;
}

std::vector<bench::MeshLink> all_pairs(std::size_t radios) {
  const Stream random(2);
  std::vector<Vector> places;
  for (std::size_t i = 0; i < radios; ++i) {
    places.push_back(at(60 * random.uniform(i, 0), 40 * random.uniform(i, 1), 0.3 + 1.5 * random.uniform(i, 2)));
  }
  std::vector<bench::MeshLink> result;
  for (std::size_t a = 0; a < radios; ++a) {
    for (std::size_t b = a + 1; b < radios; ++b) result.push_back({places[a], places[b], 0});
  }
  return result;
}

// Arguments: prisms and their sides.
void rays_of_links(benchmark::State& state) {
  const auto triangles = prisms(static_cast<std::size_t>(state.range(0)), static_cast<int>(state.range(1)));
  auto links = all_pairs(300);
  const MeshScene ours({{triangles}});
  const bench::EmbreeMeshes theirs(triangles);
  const std::pair<std::string, std::function<void()>> ways[] = {
      {"one_by_one",
       [&] {
         for (auto& link : links) ours.count(link.p, link.q, &link.crossings);
       }},
      {"packets_of_8", [&] { theirs.count<RTCRay8, 8>(links, rtcOccluded8); }},
      {"packets_of_16", [&] { theirs.count<RTCRay16, 16>(links, rtcOccluded16); }},
      {"streams", [&] { theirs.count_streams(links); }}};
  std::vector<double> best(std::size(ways), std::numeric_limits<double>::infinity());
  std::vector<bench::MeshLink> expected;
  for (auto _ : state) {
    for (std::size_t i = 0; i < best.size(); ++i) {
      for (auto& link : links) link.crossings = 0;
      const double start = cpu_seconds();
      ways[i].second();
      best[i] = std::min(best[i], cpu_seconds() - start);
      if (i == 0) expected = links;
      if (!std::equal(links.begin(), links.end(), expected.begin(),
                      [](const auto& a, const auto& b) { return a.crossings == b.crossings; }))
        throw std::logic_error(ways[i].first + " count otherwise");
    }
  }
  state.counters["triangles"] = static_cast<double>(triangles.size());
  for (std::size_t i = 0; i < best.size(); ++i)
    state.counters[ways[i].first] = 1e9 * best[i] / static_cast<double>(links.size());
}
BENCHMARK(rays_of_links)
    ->ArgNames({"prisms", "sides"})
    ->Args({20, 12})
    ->Args({100, 24})
    ->Args({500, 48})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(4)
    ->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
