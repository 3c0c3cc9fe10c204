// The kernels that sum waves: the same bits on every instruction set and both ways, close to the formula in double, and
// each link evaluated between its own ends, for any order of links.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

#include "radio_fading/multipath.hpp"
#include "radio_fading/rician.hpp"
#include "radio_fading/shadow_field.hpp"

namespace muster {
namespace {

using waves::tile;

// Some close together, two at the same place.
std::vector<FieldPoint> scattered(std::size_t number, double size) {
  std::vector<FieldPoint> result;
  const Stream random(5);
  for (std::size_t i = 0; i < number; ++i) {
    const auto at = [&](uint64_t k) { return size * random.uniform(i, k); };
    result.push_back(i % 7 == 3 ? FieldPoint{result.back().x + 1e-3, result.back().y, result.back().z}
                                : FieldPoint{at(0), at(1), at(2) / 20});
  }
  result[1] = result[0];
  return result;
}

// For all ordered pairs of places, by the first: results of evaluate(tile, place, other tile, out).
template <class Tile, class Evaluate>
std::vector<double> all_pairs(const std::vector<Tile>& at, const Evaluate& evaluate) {
  std::vector<double> result;
  for (const Tile& one : at) {
    for (int place = 0; place < tile; ++place) {
      for (const Tile& other : at) {
        double out[tile];
        evaluate(one, place, other, out);
        result.insert(result.end(), out, out + tile);
      }
    }
  }
  return result;
}

constexpr unsigned all = (1u << tile) - 1;

std::vector<double> shadowing(const std::vector<FieldPoint>& places, const waves::WaveKernel& kernel) {
  const ShadowField field(Stream(7));
  return all_pairs(field.at(places, kernel), [&](const auto& one, int place, const auto& other, double* out) {
    field.between(one, place, other, all, 4, out, kernel);
  });
}

std::vector<double> fading(const std::vector<FieldPoint>& places, double k, const waves::WaveKernel& kernel) {
  const Multipath field(Stream(7));
  return all_pairs(field.at(places, kernel), [&](const auto& one, int place, const auto& other, double* out) {
    field.gains(one, place, other, all, k, out, kernel);
  });
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

TEST(Waves, AreTheSameBitsOnEveryInstructionSet) {
  const auto& kernels = waves::wave_kernels();
  for (const double size : {3.0, 60.0, 2000.0}) {
    const auto places = scattered(10 * tile, size);
    for (int i = 1; i < kernels.number; ++i) {
      EXPECT_TRUE(same_bits(shadowing(places, *kernels.all[0]), shadowing(places, *kernels.all[i])));
      for (const double k : {0.0, 2.0}) {
        EXPECT_TRUE(same_bits(fading(places, k, *kernels.all[0]), fading(places, k, *kernels.all[i])));
      }
    }
  }
}

TEST(Waves, AreTheSameBothWaysBitForBit) {
  const auto places = scattered(10 * tile, 60);
  for (const auto& values :
       {shadowing(places, waves::best_wave_kernel()), fading(places, 2, waves::best_wave_kernel())}) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_EQ(values[i * places.size() + j], values[j * places.size() + i]);
      }
    }
  }
}

TEST(Waves, GainsAreThoseOfTheComplexGain) {
  const auto places = scattered(2 * tile, 60);
  const Multipath field(Stream(7));
  const auto found = fading(places, 2, waves::best_wave_kernel());
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < places.size(); ++j) {
      const FieldPoint &p = places[i], &q = places[j];
      const double length = std::hypot(p.x - q.x, p.y - q.y, p.z - q.z);
      const double expected = rician_gain(2, field.between(p, q), -6.283185307179586 * length);
      EXPECT_NEAR(found[i * places.size() + j], expected, 1e-8);
    }
  }
}

// For short pieces of a path too, of which some waves are evaluated by their series.
TEST(Waves, ShadowingIsTheMeanAlongTheWay) {
  const Stream random(9);
  const ShadowField field(Stream(7));
  for (const double length : {1e-3, 0.03, 0.3, 2.0}) {
    for (uint64_t i = 0; i < 20; ++i) {
      const double x = 40 * random.uniform(i, 0), y = 40 * random.uniform(i, 1), turn = 6.2832 * random.uniform(i, 2);
      const auto on = [&](double share) {
        return FieldPoint{x + share * length * std::cos(turn), y + share * length * std::sin(turn), 0.4};
      };
      // Pieces of a path add up: they are integrals, and a link's value is one over the root of its length.
      double sum = 0;
      constexpr int pieces = 16;
      for (int piece = 0; piece < pieces; ++piece) {
        sum += field.between(on(piece / double{pieces}), on((piece + 1) / double{pieces}));
      }
      EXPECT_NEAR(field.between(on(0), on(1)), sum / std::sqrt(pieces), 4e-4) << length;
    }
  }
}

struct Evaluated {
  std::vector<double> values;
  std::size_t pairs = 0;  // number of requests
};

double code(double a, double b) { return 1000 * std::min(a, b) + std::max(a, b); }

// Value of each link from by_tiles when the value of a pair is its code; NaN where it gives nothing.
Evaluated evaluated(const std::vector<Ends>& links, std::size_t endpoints) {
  Evaluated result{std::vector<double>(links.size(), null()), 0};
  const std::array<double*, 2> columns{nullptr, result.values.data()};
  by_tiles(Rows<const Ends>(reinterpret_cast<const double*>(links.data()), links.size()), endpoints, columns,
           [&](std::size_t one, int place, std::size_t other, unsigned wanted, auto& values) {
             for (int i = 0; i < tile; ++i) {
               if ((wanted >> i & 1) == 0) continue;
               values[1][i] = code(static_cast<double>(one * tile) + place, static_cast<double>(other * tile) + i);
               ++result.pairs;
             }
           });
  return result;
}

std::vector<double> codes(const std::vector<Ends>& links) {
  std::vector<double> result;
  for (const Ends& link : links) result.push_back(code(link.tx, link.rx));
  return result;
}

std::vector<Ends> listed(std::size_t endpoints, bool (*is_link)(std::size_t, std::size_t)) {
  std::vector<Ends> result;
  for (std::size_t a = 0; a < endpoints; ++a) {
    for (std::size_t b = 0; b < endpoints; ++b) {
      if (a != b && is_link(a, b)) result.push_back({static_cast<double>(a), static_cast<double>(b)});
    }
  }
  return result;
}

TEST(Tiles, EvaluateEachPairOnce) {
  const auto everyone = [](std::size_t, std::size_t) { return true; };
  const auto near = [](std::size_t a, std::size_t b) { return (a > b ? a - b : b - a) % 23 < 4; };
  for (const std::size_t endpoints : {2, 16, 17, 100}) {
    for (const auto& links : {listed(endpoints, everyone), listed(endpoints, near)}) {
      const auto found = evaluated(links, endpoints);
      EXPECT_EQ(found.values, codes(links));
      // Between places of one tile both orders are requested.
      std::size_t within = 0;
      for (const Ends& link : links) within += static_cast<int>(link.tx) / tile == static_cast<int>(link.rx) / tile;
      EXPECT_EQ(found.pairs, (links.size() - within) / 2 + within);
    }
  }
}

TEST(Tiles, TakeLinksThatRunOneWayOnly) {
  const auto upward = [](std::size_t a, std::size_t b) { return a < b; };
  const auto downward = [](std::size_t a, std::size_t b) { return a > b; };
  const auto some = [](std::size_t a, std::size_t b) { return (a + 2 * b) % 5 == 0; };
  for (const auto& links : {listed(70, upward), listed(70, downward), listed(70, some)}) {
    EXPECT_EQ(evaluated(links, 70).values, codes(links));
  }
}

TEST(Tiles, TakeLinksInAnyOrder) {
  const Stream random(4);
  std::vector<Ends> links;
  for (uint64_t i = 0; i < 3000; ++i) {
    links.push_back({std::floor(50 * random.uniform(i, 0)), std::floor(50 * random.uniform(i, 1))});
  }
  EXPECT_EQ(evaluated(links, 50).values, codes(links));
  EXPECT_TRUE(evaluated({}, 3).values.empty());
  EXPECT_TRUE(evaluated({}, 0).values.empty());
}

}  // namespace
}  // namespace muster
