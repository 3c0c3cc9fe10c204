// Laws of the AODV protocol alone, on random nets: shortest routes, repair, and freedom from loops.
#include <gtest/gtest.h>

#include <deque>
#include <map>
#include <set>

#include "aodv.hpp"
#include "muster/random.hpp"

namespace muster::routing {
namespace {

constexpr double dt = 0.02;

// A net with links between near radios; a share of the packets is lost at each receiver. A hop takes a tick.
class Net final : public Fabric {
 public:
  explicit Net(std::vector<std::pair<double, double>> places) : places_(std::move(places)) {}

  std::size_t size() const { return places_.size(); }
  void place(Radio radio, double x, double y) { places_[radio] = {x, y}; }
  bool are_near(Radio a, Radio b) const {
    const double x = places_[a].first - places_[b].first, y = places_[a].second - places_[b].second;
    return a != b && x * x + y * y <= 1.01;
  }
  // Hops of the shortest route, -1 if there is none.
  int distance(Radio from, Radio to) const {
    std::vector<int> hops(size(), -1);
    std::deque<Radio> next{from};
    hops[from] = 0;
    while (!next.empty()) {
      const Radio at = next.front();
      next.pop_front();
      for (Radio other = 0; other < size(); ++other)
        if (are_near(at, other) && hops[other] < 0) hops[other] = hops[at] + 1, next.push_back(other);
    }
    return hops[to];
  }

  std::uint32_t ask(Radio from, Radio to) {
    Packet packet;
    packet.origin = from;
    packet.target = to;
    packet.journey = ++journeys;
    aodv.originate(*this, from, packet);
    return journeys;
  }

  void step() {
    now_ += dt;
    std::vector<Sent> sent;
    sent.swap(sent_);
    for (Sent& each : sent) {
      const bool is_data = each.packet.kind == Packet::Kind::data;
      ++(is_data ? data : control);
      bool arrived = false;
      for (Radio to = 0; to < size(); ++to) {
        if (!are_near(each.at, to) || (each.to != everyone && each.to != to)) continue;
        if (Stream(key_of("losses")).uniform(++draws_) < loss) continue;
        arrived = true;
        if (is_data) ways[each.packet.journey].push_back(to);
        aodv.receive(*this, to, each.at, each.packet);
      }
      if (!arrived && each.to != everyone) aodv.lost_neighbour(*this, each.at, each.to);
    }
    aodv.pass_time(*this);
  }

  // Following the routes to a radio never leads back to an earlier one.
  void expect_no_loop() const {
    for (Radio to = 0; to < size(); ++to) {
      for (Radio from = 0; from < size(); ++from) {
        std::set<Radio> passed{from};
        Radio at = from;
        while (const auto* route = at == to ? nullptr : aodv.route(at, to)) {
          at = route->next;
          ASSERT_TRUE(passed.insert(at).second) << "a loop from " << from << " to " << to << " at " << now_ << " s";
        }
      }
    }
  }

  double now() const override { return now_; }
  void send(Radio at, Radio to, Packet packet) override { sent_.push_back({at, to, std::move(packet)}); }
  void deliver(Radio at, const Packet& packet) override {
    EXPECT_TRUE(packet.target == at || packet.target == everyone);
    ++delivered[packet.journey];
  }
  void end(const Packet& packet, Outcome outcome) override { ended[packet.journey] = outcome; }
  void park(Radio at, Packet packet) override { parked_[at].push_back(std::move(packet)); }
  std::vector<Packet> unpark(Radio at, Radio target) override {
    std::vector<Packet> result, kept;
    for (Packet& packet : parked_[at]) (packet.target == target ? result : kept).push_back(std::move(packet));
    parked_[at] = std::move(kept);
    return result;
  }
  bool is_first(Radio, const Packet&) override { return true; }

  Aodv aodv;
  double loss = 0;
  std::uint32_t journeys = 0;
  int data = 0, control = 0;
  std::map<std::uint32_t, int> delivered;
  std::map<std::uint32_t, Outcome> ended;
  std::map<std::uint32_t, std::vector<Radio>> ways;  // where a request's packet arrived, in order

 private:
  struct Sent {
    Radio at, to;
    Packet packet;
  };
  std::vector<std::pair<double, double>> places_;
  std::map<Radio, std::vector<Packet>> parked_;
  std::vector<Sent> sent_;
  double now_ = 0;
  std::uint64_t draws_ = 0;
};

void run(Net& net, double seconds) {
  for (int i = 0; i < seconds / dt; ++i) net.step();
}

std::vector<std::pair<double, double>> grid(int side) {
  std::vector<std::pair<double, double>> places;
  for (int i = 0; i < side * side; ++i) places.emplace_back(i % side, i / side);
  return places;
}

TEST(Aodv, FindsTheShortestWayOnAGrid) {
  for (const auto& [from, to] : {std::pair<Radio, Radio>{0, 48}, {3, 45}, {24, 6}, {10, 11}}) {
    Net net(grid(7));
    const auto asked = net.ask(from, to);
    run(net, 12);
    EXPECT_EQ(net.delivered[asked], 1);
    EXPECT_EQ(static_cast<int>(net.ways[asked].size()), net.distance(from, to)) << from << " to " << to;
  }
}

TEST(Aodv, AKnownWayCostsNoMoreThanItsHops) {
  Net net(grid(5));
  net.ask(0, 24);
  run(net, 8);
  const int control = net.control, data = net.data;
  const auto again = net.ask(0, 24);
  run(net, 0.5);
  EXPECT_EQ(net.delivered[again], 1);
  EXPECT_EQ(net.control, control);
  EXPECT_EQ(net.data, data + 8);
}

TEST(Aodv, ANearTargetIsFoundWithoutTheWholeNet) {
  Net net(grid(9));
  const auto asked = net.ask(40, 41);
  run(net, 1);
  EXPECT_EQ(net.delivered[asked], 1);
  EXPECT_EQ(net.control, 2);  // a request, a reply
}

TEST(Aodv, RepairsAWayWhenARadioOnItGoesAway) {
  Net net(grid(5));
  const auto first = net.ask(0, 24);
  run(net, 8);
  ASSERT_EQ(net.ways[first].size(), 8u);
  net.place(net.ways[first][3], 100, 100);
  const auto lost = net.ask(0, 24);
  run(net, 1);
  EXPECT_EQ(net.delivered.count(lost), 0u);
  const auto second = net.ask(0, 24);
  run(net, 12);
  EXPECT_EQ(net.delivered[second], 1);
  EXPECT_EQ(static_cast<int>(net.ways[second].size()), net.distance(0, 24));
}

TEST(Aodv, WhoCannotBeReachedHasNoRoute) {
  Net net({{0, 0}, {1, 0}, {2, 0}, {9, 0}});
  const auto asked = net.ask(0, 3);
  run(net, 60);
  EXPECT_EQ(net.delivered.count(asked), 0u);
  ASSERT_TRUE(net.ended.count(asked));
  EXPECT_EQ(net.ended[asked], Outcome::no_route);
}

TEST(Aodv, NoMoreHopsThanTheDiameter) {
  std::vector<std::pair<double, double>> chain;
  for (int i = 0; i < 12; ++i) chain.emplace_back(i, 0);
  for (const int diameter : {10, 11}) {
    Net net(chain);
    net.aodv.settings.net_diameter = diameter;
    const auto asked = net.ask(0, 11);
    run(net, 60);
    EXPECT_EQ(net.delivered.count(asked), diameter == 11 ? 1u : 0u);
  }
}

class AodvOnMovingNets : public testing::TestWithParam<int> {};

// Radios walk in a field, some far and fast; messages go between any two.
TEST_P(AodvOnMovingNets, NoRoutesEverLoopAndWhatStandsAgainIsReached) {
  const Stream random(key_of("moving nets " + std::to_string(GetParam())));
  constexpr Radio n = 20;
  const double side = 2 + GetParam() % 4;
  std::vector<std::pair<double, double>> places;
  for (Radio i = 0; i < n; ++i) places.emplace_back(side * random.uniform(i, 0), side * random.uniform(i, 1));
  Net net(places);
  net.aodv.settings.active_route_timeout = GetParam() % 2 ? 3 : 0.5;
  net.loss = GetParam() % 3 * 0.2;
  for (std::uint64_t tick = 0; tick < 3000; ++tick) {
    for (Radio i = 0; i < n; ++i) {
      // To another place every 2 s.
      const auto leg = tick / 100;
      const double part = static_cast<double>(tick % 100) / 100;
      const auto at = [&](std::uint64_t axis) {
        const double a = random.of(i).uniform(leg, axis), b = random.of(i).uniform(leg + 1, axis);
        return side * (a + part * (b - a));
      };
      net.place(i, at(0), at(1));
    }
    if (tick % 3 == 0) {
      const auto from = static_cast<Radio>(n * random.uniform(tick, 2)),
                 to = static_cast<Radio>(n * random.uniform(tick, 3));
      if (from != to) net.ask(from, to);
    }
    net.step();
    net.expect_no_loop();
    if (testing::Test::HasFatalFailure()) return;
  }
  for (const auto& [journey, way] : net.ways) {
    const std::set<Radio> once(way.begin(), way.end());
    EXPECT_EQ(once.size(), way.size()) << "a packet passed somewhere twice";
  }
  net.loss = 0;
  run(net, 30);
  for (Radio from = 0; from < n; ++from) {
    const Radio to = (from * 7 + 5) % n;
    if (from == to) continue;
    const auto asked = net.ask(from, to);
    run(net, 20);
    EXPECT_EQ(net.delivered.count(asked) > 0, net.distance(from, to) > 0) << from << " to " << to;
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, AodvOnMovingNets, testing::Range(0, 24));

TEST(Aodv, ItsBytesAreItsState) {
  Net one(grid(6)), other(grid(6));
  const auto both = [&](const auto& what) { what(one), what(other); };
  both([](Net& net) {
    net.ask(0, 35), net.ask(7, 30);
    run(net, 1.1);  // in mid-search
  });
  const std::string saved = one.aodv.save();
  EXPECT_EQ(saved, other.aodv.save());
  other.aodv.load("");
  other.aodv.load(saved);
  for (int i = 0; i < 500; ++i) {
    both([](Net& net) { net.step(); });
    ASSERT_EQ(one.aodv.save(), other.aodv.save());
  }
  EXPECT_EQ(one.delivered, other.delivered);
  EXPECT_EQ(one.delivered.size(), 2u);
}

}  // namespace
}  // namespace muster::routing
