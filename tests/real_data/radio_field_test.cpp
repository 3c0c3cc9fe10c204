// Nine sets of readings from the field, of which more is known than a diagnosis is told: what is named, what is not,
// and that nothing is claimed beyond what was held out. docs/explanation/real_data.md has their stories.
#include <gtest/gtest.h>

#include <regex>

#include "tests/real_data/field_sets.hpp"

namespace muster::real_data {
namespace {

using nlohmann::json;

class RadioField : public testing::TestWithParam<Known> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(field_data())) GTEST_SKIP() << "measured data are not there: " << field_data();
  }
};

// No finding is kept that makes left-out places worse, and no error there is absurd.
void expect_no_refuted_claim(const json& found) {
  if (!found["heldout_rmse_db"].is_null()) {
    EXPECT_LT(found["heldout_rmse_db"].get<double>(), 20);
  }
  for (const char* list : {"causes", "unexplained"}) {
    for (const json& c : found[list]) {
      if (c.value("gain_upper95", json()).is_number()) {
        EXPECT_GT(c["gain_upper95"].get<double>(), 0) << c.dump();
      }
    }
  }
}

TEST_P(RadioField, IsAsOtherEvidenceSaysAndClaimsNothingThatHeldOutDataRefute) {
  const Known& known = GetParam();
  const json found = diagnosed(known.set).report;
  expect_no_refuted_claim(found);
  if (known.held) {
    EXPECT_TRUE(found_first(known, found)) << known.words << "; found: " << found["causes"].dump();
  }
  if (!known.verdict_not.empty()) {
    EXPECT_NE(found["verdict"], known.verdict_not);
  }
  if (known.never.empty()) return;
  for (const json& c : found["causes"]) {
    const std::string name = c["id"].get<std::string>() + ' ' + c["label"].get<std::string>();
    EXPECT_FALSE(std::regex_match(name, std::regex(known.never))) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, RadioField, testing::ValuesIn(known_sets()),
                         [](const auto& set) { return set.param.set; });

// A name elsewhere than in the first place, or of another radio, is not the known one.
TEST(FoundFirst, HoldsTheFirstCausesToWhatIsKnown) {
  const Known two{.set = "", .words = "", .first = "effect.rx_offset radio/(G2|G4)", .count = 2};
  const auto found = [&](const char* a, const char* b) {
    const json one = {{"id", "effect.rx_offset"}, {"label", a}}, other = {{"id", "effect.rx_offset"}, {"label", b}};
    return found_first(two, {{"causes", {one, other}}});
  };
  EXPECT_TRUE(found("radio/G4", "radio/G2"));
  EXPECT_FALSE(found("radio/G4", "radio/G5"));
  EXPECT_FALSE(found_first(two, {{"causes", json::array()}}));
}

}  // namespace
}  // namespace muster::real_data
