// Smooths of links: one for each column, factor and product, and none over unknown places.
#include "diagnosis/radio/links/link_smooths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/diagnosis/inference/causes.hpp"

namespace muster::diagnosis {
namespace {

using inference::Candidate;
using synthetic::columns_of;
using synthetic::varied;
using synthetic::world_of;

TEST(LinkSmooths, CoverEveryColumnFactorAndProduct) {
  const auto world = world_of(varied(4, 400));
  LinkColumns given = columns_of(world);
  given.factors.push_back({"phone", std::vector<int>(400, 0)});
  for (std::size_t i = 0; i < 400; i += 3) given.factors[0].level[i] = 1;
  std::set<std::string> ids;
  for (const Candidate& c : link_smooths(world.readings, given, true)) {
    ids.insert(c.id);
    const Eigen::MatrixXd columns = c.design.columns(c.design.grid.front());
    EXPECT_EQ(columns.rows(), 400) << c.id;
    EXPECT_EQ(columns.cols(), c.design.width) << c.id;
    EXPECT_TRUE(columns.allFinite()) << c.id;
    EXPECT_GT((columns.rowwise() - columns.colwise().mean()).norm(), 1e-3) << c.id;
    for (const Eigen::VectorXd& theta : c.design.wider) {
      const Eigen::MatrixXd more = c.design.columns(theta);
      EXPECT_EQ(more.cols(), theta[0] * c.design.width) << c.id;
      EXPECT_EQ(more.rows(), 400) << c.id;
    }
  }
  for (const char* id : {"~logd", "~bearing", "~heading", "~txbearing", "~position", "~time", "~time_per_tx",
                         "~time*position", "~link", "~phone", "~speed", "~battery", "~temperature", "~temperature*logd",
                         "~speed*position", "slope~position", "chirp~time", "bend~battery"})
    EXPECT_EQ(ids.count(id), 1u) << id;
}

// Each transmitter of a network that stands has eight links or so: six functions of the direction would fit them one by
// one, however often they are measured.
TEST(LinkSmooths, OverDirectionsAreOfTransmittersThatSeeManyOnly) {
  const auto world = world_of(varied(4, 400));
  LinkReadings standing = world.readings;
  for (Eigen::Index i = 0; i < standing.size(); ++i) {
    standing.tx[static_cast<std::size_t>(i)] = i % 2 == 0 ? 0 : 1;
    if (i % 2 == 0) standing.rx_at.col(i) << static_cast<double>(i % 16), 3, 0;
  }
  for (const Candidate& c : link_smooths(standing, {}, true)) {
    if (c.id != "~txbearing") continue;
    ASSERT_EQ(c.design.grid.size(), 1u);
    EXPECT_EQ(c.design.grid[0][0], 1);
    return;
  }
  FAIL() << "no directions";
}

TEST(LinkSmooths, FollowHeightsWhereARadioClimbs) {
  auto world = world_of(varied(4, 400));
  const auto follow_heights = [&] {
    const std::vector<Candidate> all = link_smooths(world.readings, {}, true);
    return std::any_of(all.begin(), all.end(), [](const Candidate& c) { return c.id == "~height"; });
  };
  EXPECT_FALSE(follow_heights());
  LinkReadings& r = world.readings;
  const int climber = r.rx[0];
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (r.tx[k] == climber) r.tx_at(2, i) = 0.01 * static_cast<double>(i);
    if (r.rx[k] == climber) r.rx_at(2, i) = 0.01 * static_cast<double>(i);
  }
  EXPECT_TRUE(follow_heights());
}

// Time always varies: an observed column that explains as much comes before a function of time.
TEST(LinkSmooths, OnlyThoseOfTimeAreTimeLike) {
  const auto world = world_of(varied(4, 400));
  for (const Candidate& c : link_smooths(world.readings, columns_of(world), true))
    EXPECT_EQ(c.role.time_like, c.id == "~time" || c.id == "chirp~time") << c.id;
}

// Effects of a robot's place and heading are equal in both directions of a link.
TEST(LinkSmooths, AreTheSameForBothDirectionsOfALink) {
  const auto world = world_of(varied(6, 300));
  const LinkReadings& heard = world.readings;
  LinkReadings sent = heard;
  std::swap(sent.tx, sent.rx);
  std::swap(sent.tx_at, sent.rx_at);
  std::swap(sent.tx_yaw, sent.rx_yaw);
  sent.rx_yaw.assign(300, 0.3);  // stations have a heading too
  const auto columns = [&](const LinkReadings& readings, const std::string& id) {
    const std::vector<Candidate> all = link_smooths(readings, columns_of(world), true);
    const auto found = std::find_if(all.begin(), all.end(), [&](const Candidate& c) { return c.id == id; });
    return found == all.end() ? Eigen::MatrixXd() : found->design.columns(found->design.grid.front());
  };
  for (const char* id : {"~bearing", "~heading", "~position", "slope~position", "~speed*position", "~logd"}) {
    const Eigen::MatrixXd one = columns(heard, id), other = columns(sent, id);
    ASSERT_EQ(one.rows(), other.rows()) << id;
    ASSERT_GT(one.cols(), 0) << id;
    EXPECT_LT((one - other).cwiseAbs().maxCoeff(), 1e-12) << id;
  }
}

TEST(LinkSmooths, NoneDependsOnUnknownPlaces) {
  const auto world = world_of(varied(4, 400));
  std::set<std::string> ids;
  for (const Candidate& c : link_smooths(world.readings, columns_of(world), false)) {
    ids.insert(c.id);
    for (const std::string& covariate : c.covariates)
      EXPECT_TRUE(covariate.find("position") == std::string::npos && covariate.find("bearing") == std::string::npos)
          << c.id;
  }
  for (const char* id : {"~logd", "~heading", "~time", "~link"}) EXPECT_EQ(ids.count(id), 1u) << id;
  for (const char* id : {"~bearing", "~txbearing", "~position", "~time*position"}) EXPECT_EQ(ids.count(id), 0u) << id;
}

}  // namespace
}  // namespace muster::diagnosis
