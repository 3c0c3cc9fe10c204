// Nine sets of readings from the field, of which more is known than a diagnosis is told (their README): what is named,
// what is not, and that nothing is claimed beyond what was held out. docs/explanation/real_data.md tells their stories.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/real_data/tables.hpp"

namespace muster::real_data {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

fs::path sets() { return radio_data().parent_path() / "radio_field"; }

json diagnosed(const std::string& set) {
  const fs::path folder = sets() / set;
  const std::string command = std::string(MUSTER_PROGRAM) + " diagnose '" + (folder / "world.xml").string() +
                              "' --data '" + (folder / "measured.csv").string() + "' --json 2>/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  std::string said;
  std::array<char, 4096> part{};
  for (std::size_t n; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) said.append(part.data(), n);
  EXPECT_EQ(pclose(pipe), 0) << set;
  return json::parse(said);
}

class RadioField : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!fs::exists(sets())) GTEST_SKIP() << "measured data are not there: " << sets();
  }
};

// The label of the first cause with this id, or "".
std::string about(const json& found, const std::string& id) {
  for (const json& c : found["causes"])
    if (c["id"] == id) return c["label"];
  return "";
}

// No finding is kept that makes left-out places worse, and no error there is absurd.
TEST_P(RadioField, ClaimsNothingThatHeldOutDataRefute) {
  const json found = diagnosed(GetParam());
  if (!found["heldout_rmse_db"].is_null()) {
    EXPECT_LT(found["heldout_rmse_db"].get<double>(), 20) << GetParam();
  }
  for (const char* list : {"causes", "unexplained"}) {
    for (const json& c : found[list]) {
      if (c.value("gain_upper95", json()).is_number()) {
        EXPECT_GT(c["gain_upper95"].get<double>(), 0) << c.dump();
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, RadioField,
                         testing::Values("trackerbots", "uwb_static", "peach", "szu_lora", "balloon", "uji_lib",
                                         "egham_corridor", "egham_corridor_right", "utah_walk"));

class Known : public RadioField {};

struct Expected {
  const char *set, *first, *label;
};

TEST_F(Known, CausesComeFirst) {
  for (const auto& [set, first, label] : {Expected{"uwb_static", "effect.two_ray", "all"},
                                          {"uji_lib", "effect.rx_offset", "radio/phoneA"},
                                          {"egham_corridor_right", "effect.antenna_tx", "radio/AP3"}}) {
    const json found = diagnosed(set);
    ASSERT_FALSE(found["causes"].empty()) << set;
    EXPECT_EQ(found["causes"][0]["id"], std::string(first)) << set;
    EXPECT_EQ(found["causes"][0]["label"], std::string(label)) << set;
  }
}

// Two gateways on one mast differ by 15.7 dB at the points that both heard, two on another by 15.4.
TEST_F(Known, GatewaysThatReadTooHigh) {
  const json found = diagnosed("szu_lora");
  ASSERT_GE(found["causes"].size(), 2u);
  for (const int k : {0, 1}) {
    const std::string label = found["causes"][k]["label"];
    EXPECT_TRUE(label == "radio/G2" || label == "radio/G4") << label;
  }
}

// Paired differences say that n16 sends 13.7 dB weak: beside a level that all links share in time it is the one name.
TEST_F(Known, TheWeakNodeOfAMesh) {
  const json found = diagnosed("peach");
  const std::string of =
      about(found, "effect.rx_offset") + about(found, "effect.tx_offset") + about(found, "effect.asymmetry");
  EXPECT_EQ(of, "radio/n16");
  for (const json& c : found["causes"]) EXPECT_NE(c["id"], "effect.periodic") << "snapshots an hour apart";
}

// Places of the access points are shifted by one column: no name is known for that, and the world is not adequate.
TEST_F(Known, MisplacedAccessPointsAreNotAdequate) { EXPECT_NE(diagnosed("egham_corridor")["verdict"], "adequate"); }

}  // namespace
}  // namespace muster::real_data
