// Laws of every cause: nothing at its neutral values, proportion where declared, reciprocity where physics requires it,
// and the same bits however it is made and run.
#include <map>
#include <set>

#include "loader/library.hpp"
#include "survey.hpp"

namespace muster {
namespace {

struct Example {
  std::string name;
  std::string attributes;  // with which it changes readings
  std::string neutral;     // with which it does not; "" where its linear parameters at 0 do that
  bool both_ways = true;
};

void PrintTo(const Example& example, std::ostream* out) { *out << example.name; }

const std::vector<Example>& examples() {
  static const std::string here = "x0=\"2\" y0=\"-1\" x1=\"9\" y1=\"8\" ";
  static const std::vector<Example> result = {
      {"tx_offset", "radio=\"a\" offset=\"3\"", "", false},
      {"rx_offset", "radio=\"a\" offset=\"3\"", "", false},
      {"asymmetry", "radio=\"a\" loss=\"3\"", "", false},
      {"feeder_loss", "radio=\"a\" loss=\"3\"", ""},
      {"antenna_tx", "radio=\"a\" amplitude=\"3\"", ""},
      {"antenna_rx", "radio=\"r\" amplitude=\"3\" direction=\"1\"", ""},
      {"body_shadow", "radio=\"r\" loss=\"3\" width=\"1.2\"", ""},
      {"sector_antenna", "radio=\"a\" front_to_back=\"9\"", ""},
      {"wall_material", "wall=\"w\" change=\"3\"", ""},
      {"wall_absent", "wall=\"w\" share=\"0.5\"", ""},
      {"counted_walls", "material=\"wood\" file=\"measured.csv\" loss=\"3\"", ""},
      {"unmapped_wall", here + "loss=\"3\"", ""},
      {"obstacle", "x=\"6\" y=\"3\" radius=\"1.5\" loss=\"3\"", ""},
      {"room_clutter", "x=\"6\" y=\"3\" loss=\"3\"", ""},
      {"corridor", here + "width=\"7\" gain=\"0.4\"", ""},
      {"dual_slope", "break=\"3\" n_change=\"0.7\"", ""},
      {"two_ray", "reflection=\"0.6\"", "reflection=\"0\""},
      {"multiwall_saturation", "knee=\"9\"", "knee=\"1e4\""},
      {"incidence", "share=\"0.5\"", ""},
      {"height", "loss=\"3\"", ""},
      {"drift", "rate=\"60\"", ""},
      {"step", "at=\"50\" size=\"3\"", ""},
      {"periodic", "amplitude=\"3\" phase=\"1\"", ""},
      {"tx_drift", "radio=\"a\" rate=\"60\"", "", false},
      {"tx_step", "radio=\"a\" at=\"50\" size=\"3\"", "", false},
      {"tx_periodic", "radio=\"a\" amplitude=\"3\" phase=\"1\"", "", false},
      {"people", "loss=\"3\"", ""},
      {"channel_mixture", "sd=\"3\"", ""},
      {"power_steps", "file=\"measured.csv\" error1=\"1\" error2=\"2\" error3=\"-1\"",
       "file=\"measured.csv\" error1=\"0\" error2=\"0\" error3=\"0\""},
      {"noise_floor_rssi", "file=\"measured.csv\" share=\"0.5\"", "", false},
      {"rssi_saturation", "level=\"-60\"", "level=\"50\""},
      {"rssi_compression", "knee=\"-70\" share=\"0.4\"", ""},
      {"rssi_floor", "level=\"-70\"", "level=\"-250\""},
      {"outliers", "share=\"0.5\"", "share=\"0\"", false},
      {"fading_law", "rician_k=\"9\"", "rician_k=\"3\""},
      {"shadowing_correlation", "shadowing=\"6\" decorrelation=\"1\"", "shadowing=\"4\" decorrelation=\"2\""},
      {"column_shifted", "column=\"places\" by=\"2\"", "column=\"places\" by=\"0\""},
      {"labels_shifted", "first=\"b\"", "first=\"a\""},
      {"plan_turned", "of=\"stations\" how=\"turned_90\" x=\"5\" y=\"3\"", "how=\"as_listed\" x=\"5\" y=\"3\""},
      {"plan_shifted", "of=\"stations\" east=\"2\" north=\"-1\"", "east=\"0\" north=\"0\""},
      {"tx_misplaced", "radio=\"b\" x=\"9\" y=\"1\"", "radio=\"b\" x=\"14\" y=\"9\""},
      {"label_swap", "a=\"a\" b=\"b\"", "a=\"a\" b=\"a\""},
  };
  return result;
}

std::vector<std::string> linear_parameters(const Simulation& world) {
  std::vector<std::string> result;
  for (const auto& p : world.parameters())
    if (p.path.rfind("it/", 0) == 0 && (p.declared->flags & MUSTER_LINEAR)) result.push_back(p.path);
  return result;
}

class EachCause : public testing::TestWithParam<Example> {
 protected:
  std::string it() const { return effect(GetParam().name, GetParam().attributes); }
  Site site;
};

TEST_P(EachCause, ChangesReadings) {
  EXPECT_FALSE(same_bits(column(site.world(it()), "link/*/rssi"), column(site.world(""), "link/*/rssi")));
}

TEST_P(EachCause, AtItsNeutralValuesChangesNotABit) {
  for (const bool expected : {false, true}) {
    auto world = site.world(GetParam().neutral.empty() ? it() : effect(GetParam().name, GetParam().neutral), expected);
    if (GetParam().neutral.empty()) {
      ASSERT_FALSE(linear_parameters(world).empty());
      for (const auto& path : linear_parameters(world)) world.set_parameter(path, 0);
      world.evaluate(MUSTER_RADIO, expected);
    }
    EXPECT_TRUE(same_bits(column(world, "link/*/rssi"), column(site.world("", expected), "link/*/rssi")));
  }
}

// Drawn, since some draws have an expectation of 0.
TEST_P(EachCause, IsProportionalToItsLinearParameters) {
  const auto plain = column(site.world(""), "link/*/rssi");
  auto world = site.world(it());
  std::map<std::string, double> given;  // each is then changed on its own, with the others at 0
  for (const auto& path : linear_parameters(world)) given[path] = world.parameter(path).value;
  for (const auto& [path, value] : given) {
    const double bound = world.parameter(path).declared->max;
    for (const auto& [other, unused] : given) world.set_parameter(other, 0);
    if (value == 0) continue;  // a fourth power that the data do not have
    world.set_parameter(path, value);
    world.evaluate(MUSTER_RADIO, false);
    const auto once = column(world, "link/*/rssi");
    const double factor = std::min(2.5, bound / value > 0 ? bound / value : 2.5);
    world.set_parameter(path, factor * value);
    world.evaluate(MUSTER_RADIO, false);
    const auto more = column(world, "link/*/rssi");
    for (std::size_t i = 0; i < plain.size(); ++i)
      EXPECT_NEAR(more[i] - plain[i], factor * (once[i] - plain[i]), 1e-9) << path;
    EXPECT_FALSE(same_bits(once, more)) << path;
  }
}

TEST_P(EachCause, IsTheSameBothWaysWherePhysicsSaysSo) {
  for (const bool expected : {false, true}) {
    const auto rssi = column(site.world(it(), expected), "link/*/rssi");
    bool same = true;
    for (std::size_t i = 0; i < rssi.size(); i += 2) same &= same_bits(rssi[i], rssi[i + 1]);
    EXPECT_EQ(same, GetParam().both_ways || (expected && GetParam().name == "outliers"));
  }
}

TEST_P(EachCause, GivesTheSameBitsHoweverItIsRun) {
  auto one = site.world(it()), other = site.world(it(), false, 3);
  for (int i = 0; i < 6; ++i) {
    one.step();
    other.step();
    if (i == 2) other.remake("it");
    if (i == 3) {
      const Snapshot here = other.snapshot();
      other.step();
      other.restore(here);
    }
    ASSERT_EQ(one.digest(), other.digest());
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, EachCause, testing::ValuesIn(examples()),
                         [](const auto& cause) { return cause.param.name; });

// In one world with live radios: every cause is a plugin that a run executes.
TEST(AllCauses, RunTogetherOnLivingLinks) {
  const Site site;
  std::string all;
  for (const auto& example : examples()) {
    // Its table has a row for every link, so it fits measured ones alone.
    if (example.name != "counted_walls") all += "<effect." + example.name + ' ' + example.attributes + "/>\n";
  }
  auto one = site.world(all, false, 1, plan + channel, ""), other = site.world(all, false, 3, plan + channel, "");
  EXPECT_EQ(one.table("link/*/rssi").rows(), 12u);
  for (int i = 0; i < 10; ++i) {
    one.step();
    other.step();
    if (i == 4) {
      for (const auto& instance : other.instances()) other.remake(std::string(instance->name()));
    }
    ASSERT_EQ(one.digest(), other.digest());
  }
  const TableView place = one.table("endpoint/*/pose");
  EXPECT_EQ(place.at(0, 0), 9);  // a is at the given place of b, and b is misplaced
  // Before that, a was where b is listed, 9 m east and 6 m north of the point about which the plan is turned back, and
  // all were shifted by 2 m.
  EXPECT_NEAR(place.at(1, 0), 5 + 6 - 2, 1e-12);
}

TEST(Examples, AreThereForEveryCause) {
  std::set<std::string> known;
  for (const auto& example : examples()) known.insert("effect." + example.name);
  for (const auto& plugin : list_plugins({MUSTER_PLUGINS_DIR})) {
    const std::string id = plugin.library ? std::string(plugin.library->id()) : "";
    EXPECT_TRUE(known.count(id) || id.rfind("effect.", 0) != 0) << id;
  }
}

}  // namespace
}  // namespace muster
