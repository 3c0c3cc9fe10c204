// A law of readings that an author declares is found with no change to the engine.
#include <gtest/gtest.h>

#include "diagnosis/pipeline/diagnose.hpp"
#include "tests/diagnosis/pipeline/flat.hpp"

namespace muster::diagnosis {
namespace {

const Library::SearchPath with_own = {OWN_LAW_DIR, MUSTER_PLUGINS_DIR};
constexpr const char* own_law = "cause.restless_gain";
constexpr const char* steady = "rician_k=\"8\" per_reading=\"true\"";

// Readings of a world with the law, and the world without it.
class OwnLaw : public testing::TestWithParam<int> {
 protected:
  std::filesystem::path measured() const {
    const std::string error = std::string("<") + own_law + " scale=\"" + print_real(scale) + "\"/>";
    return drawn_by(scratch_, flat(scratch_, GetParam(), steady, error), with_own);
  }
  std::filesystem::path world() const { return flat(scratch_, GetParam(), steady); }

  static constexpr double scale = 2.5;  // dB

 private:
  Scratch scratch_;
};

TEST_P(OwnLaw, IsNamedAndMeasured) {
  const std::filesystem::path data = measured();
  const Diagnosis found = diagnose(world(), data, with_own);
  EXPECT_EQ(names_in_words(named_causes(found)), std::string(own_law) + " all");
  ASSERT_FALSE(found.causes.empty());
  ASSERT_FALSE(found.causes[0].values.empty());
  const CauseValue& value = found.causes[0].values[0];
  EXPECT_EQ(value.name, "scale");
  EXPECT_LT(value.lower95, scale);
  EXPECT_GT(value.upper95, scale);
}

// Without its plugin another law comes nearest, or none.
TEST_P(OwnLaw, IsNotNamedWithoutItsPlugin) {
  const std::filesystem::path data = measured();
  const Diagnosis found = diagnose(world(), data, plugins);
  EXPECT_FALSE(found.searched.empty());
  for (const CauseEstimate& cause : found.causes) EXPECT_NE(cause.id, own_law);
  for (const std::string& id : found.searched) EXPECT_NE(id, own_law);
}

// Nor where the world draws nothing of it, nor where the world has it.
TEST_P(OwnLaw, IsNotNamedWhereTheWorldIsRight) {
  const Scratch scratch;
  const std::filesystem::path clean = flat(scratch, GetParam(), steady);
  const std::filesystem::path data = drawn_by(scratch, clean, with_own);
  EXPECT_EQ(names_in_words(named_causes(diagnose(clean, data, with_own))), "silent");
  const std::string error = std::string("<") + own_law + " scale=\"2.5\"/>";
  const std::filesystem::path restless = flat(scratch, GetParam(), steady, error);
  EXPECT_EQ(names_in_words(named_causes(diagnose(restless, drawn_by(scratch, restless, with_own), with_own))),
            "silent");
}

INSTANTIATE_TEST_SUITE_P(Seeds, OwnLaw, testing::Values(1, 2));

}  // namespace
}  // namespace muster::diagnosis
