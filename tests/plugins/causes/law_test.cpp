// Causes that change a probability law: expectations are the means of draws, and draws follow their law.
#include <set>

#include "survey.hpp"

namespace muster {
namespace {

constexpr int many = 8000;

// One link, repeated: `step` seconds apart, in both directions.
std::vector<Reading> standing(double step) {
  std::vector<Reading> result;
  for (int i = 0; i < many; ++i) {
    const Reading::At a{0, 0, 1, 0}, b{4, 3, 1, 0};
    result.push_back({step * (i + 0.5), "a", "b", a, b, 0, 0});
    result.push_back({step * (i + 0.5), "b", "a", b, a, 0, 0});
  }
  return result;
}

// Shadowing is a function of place: at one place its draws have a mean other than 0.
const std::string unshadowed =
    "<radio.multiwall/><radio.fading shadowing=\"0\" rician_k=\"3\" per_reading=\"true\"/><radio.receiver "
    "sensitivity=\"-250\"/>";

struct Drawn {
  std::vector<double> values;  // of the first direction
  double mean = 0, sd = 0, error = 0, expected = 0;
};

Drawn draw(const std::string& element, double step, const std::string& table, bool both_ways) {
  const Site site(standing(step));
  Drawn result;
  const auto values = column(site.world(element, false, 1, plan + unshadowed), table);
  const auto expected = column(site.world(element, true, 1, plan + unshadowed), table);
  for (std::size_t i = 0; i < values.size(); i += 2) {
    result.values.push_back(values[i]);
    EXPECT_TRUE(!both_ways || same_bits(values[i], values[i + 1]));
    EXPECT_EQ(expected[i], expected[0]);
  }
  for (const double x : result.values) result.mean += x / many;
  for (const double x : result.values) result.sd += (x - result.mean) * (x - result.mean) / (many - 1);
  result.sd = std::sqrt(result.sd);
  result.error = result.sd / std::sqrt(many);
  result.expected = expected[0];
  EXPECT_NEAR(result.mean, result.expected, 4 * result.error);
  return result;
}

TEST(People, TakeTheirLossForAShareOfTheTime) {
  const auto d = draw(effect("people", "loss=\"8\" share=\"0.2\" duration=\"2\""), 2, "link/*/level@it", true);
  EXPECT_DOUBLE_EQ(d.expected, -1.6);
  EXPECT_EQ(std::set<double>(d.values.begin(), d.values.end()), (std::set<double>{-8, 0}));
}

TEST(People, StandInTheWayForAWindow) {
  const Site site(standing(0.25));
  const auto part = column(site.world(effect("people", "loss=\"8\" share=\"0.5\" duration=\"2\"")), "link/*/level@it");
  int changes = 0;
  for (std::size_t i = 2; i < part.size(); i += 2) {
    const bool same_window = std::floor(site.readings[i].t / 2) == std::floor(site.readings[i - 2].t / 2);
    EXPECT_TRUE(!same_window || part[i] == part[i - 2]);
    changes += part[i] != part[i - 2];
  }
  EXPECT_GT(changes, many / 8 / 3);  // half of the ends of windows, less chance
}

TEST(People, AreOnTheLineThatIsNamed) {
  const Site site;
  const auto one =
      column(site.world(effect("people", "radio=\"a\" other=\"r\" loss=\"8\" share=\"1\"")), "link/*/level@it");
  const auto any = column(site.world(effect("people", "radio=\"a\" loss=\"8\" share=\"1\"")), "link/*/level@it");
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Reading& r = site.readings[i];
    const bool a = r.tx == "a" || r.rx == "a", pair = a && (r.tx == "r" || r.rx == "r");
    EXPECT_EQ(one[i], pair ? -8 : 0);
    EXPECT_EQ(any[i], a ? -8 : 0);
  }
}

TEST(ChannelMixture, HasItsSpreadAndItsLevels) {
  const auto d = draw(effect("channel_mixture", "sd=\"3\" channels=\"4\""), 1, "link/*/level@it", true);
  EXPECT_EQ(d.expected, 0);
  EXPECT_NEAR(d.sd, 3, 0.05);
  EXPECT_EQ(std::set<double>(d.values.begin(), d.values.end()).size(), 4u);
}

TEST(Outliers, AreAShareOfReadingsAndUniform) {
  const auto plain = column(Site(standing(1)).world("", false, 1, plan + unshadowed), "link/*/rssi");
  const auto d = draw(effect("outliers", "share=\"0.25\" half_width=\"15\""), 1, "link/*/rssi", false);
  int off = 0, far = 0;
  for (std::size_t i = 0; i < d.values.size(); ++i) {
    const double by = std::abs(d.values[i] - plain[2 * i]);
    EXPECT_LE(by, 15 + 1e-9);
    off += by > 0;
    far += by > 7.5;
  }
  EXPECT_NEAR(off, 0.25 * many, 4 * std::sqrt(many * 0.25 * 0.75));
  EXPECT_NEAR(far, 0.5 * off, 4 * std::sqrt(off * 0.25));
}

TEST(FadingLaw, IsThatOfTheNewFactor) {
  for (const char* k : {"-40", "0", "9"}) {
    const std::string attribute = std::string("rician_k=\"") + k + "\"";
    draw(effect("fading_law", attribute), 1, "link/*/rssi", true);
    const Site site;
    const std::string stated = "<radio.multiwall/><radio.fading per_reading=\"true\" " + attribute +
                               "/><radio.receiver sensitivity=\"-250\"/>";
    for (const bool expected : {false, true})
      EXPECT_TRUE(same_bits(column(site.world(effect("fading_law", attribute), expected), "link/*/fading"),
                            column(site.world("", expected, 1, plan + stated), "link/*/fading")));
  }
}

TEST(FadingLaw, NeedsFadingInTheWorld) {
  const Site site;
  EXPECT_THROW(site.world(effect("fading_law", ""), false, 1, plan + "<radio.multiwall/><radio.receiver/>"), Error);
}

TEST(ShadowingCorrelation, LeavesTheNewFieldAlone) {
  const Site site;
  const auto world = site.world(effect("shadowing_correlation", "shadowing=\"6\" decorrelation=\"5\""));
  const auto old = column(world, "link/*/level@radio.fading.shadowing"), part = column(world, "link/*/level@it");
  const std::string stated = "<radio.multiwall/><radio.fading shadowing=\"6\" decorrelation=\"5\"/><radio.receiver/>";
  const auto now = column(site.world("", false, 1, plan + stated), "link/*/level@radio.fading.shadowing");
  for (std::size_t i = 0; i < now.size(); ++i) EXPECT_NEAR(old[i] + part[i], now[i], 1e-12);
  EXPECT_FALSE(same_bits(old, now));
  for (const double x : column(site.world(effect("shadowing_correlation", "shadowing=\"6\""), true), "link/*/level@it"))
    EXPECT_EQ(x, 0);
}

}  // namespace
}  // namespace muster
