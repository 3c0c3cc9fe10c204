// Our media against curves from ns-3 3.37 (curves.csv; README.md describes the method).
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "cases.hpp"

namespace muster::peers {
namespace {

struct Row {
  std::string network, kind;
  std::size_t radios = 0;
  double x = 0;
  Curve ns3;
};

std::vector<Row> stored() {
  std::ifstream file(MUSTER_CURVES);
  std::string line;
  std::getline(file, line);
  std::vector<Row> result;
  while (std::getline(file, line)) {
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::istringstream words(line);
    Row row;
    words >> row.network >> row.kind >> row.radios >> row.x >> row.ns3.arrived >> row.ns3.no_access >> row.ns3.scatter;
    EXPECT_TRUE(words) << line;
    result.push_back(row);
  }
  return result;
}

// 0.01 is the bound, plus the curve's own error where it is steep.
TEST(Curves, AsMuchArrivesAndAsOftenNoChannelIsFreeAsInNs3) {
  const std::vector<Row> rows = stored();
  const std::vector<Case> all = cases();
  ASSERT_EQ(rows.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Case& c = all[i];
    ASSERT_TRUE(rows[i].network == c.network && rows[i].kind == c.kind && rows[i].radios == c.radios &&
                rows[i].x == c.x);
    const Curve ours = mean_of(c, [&](const Task& t) { return c.ours(t); });
    std::printf("%s %s %zu %g: arrived %.4f (%.4f), no access %.4f (%.4f)\n", c.network.c_str(), c.kind.c_str(),
                c.radios, c.x, ours.arrived, rows[i].ns3.arrived, ours.no_access, rows[i].ns3.no_access);
    EXPECT_NEAR(ours.arrived, rows[i].ns3.arrived, 0.01) << c.network << ' ' << c.kind << ' ' << c.radios << ' ' << c.x;
    EXPECT_NEAR(ours.no_access, rows[i].ns3.no_access, 0.005) << c.network << ' ' << c.kind << ' ' << c.x;
  }
}

}  // namespace
}  // namespace muster::peers
