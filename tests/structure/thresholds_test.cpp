// Thresholds stand in one table, with unit, origin and test; the page shows that table.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "../folder.hpp"
#include "threshold_table.hpp"

namespace muster::test {
namespace {

using testing::ElementsAre;

const std::filesystem::path root = MUSTER_SOURCE_DIR;

std::vector<Threshold> thresholds_of_the_tree() {
  std::vector<Threshold> all;
  for (const auto& header : threshold_headers(root)) {
    const auto some = thresholds_in_header(contents(header));
    EXPECT_FALSE(some.empty()) << header;
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::vector<std::string> in_words(const std::vector<Threshold>& thresholds) {
  std::vector<std::string> result;
  for (const Threshold& t : thresholds) result.push_back(test::in_words(t));
  return result;
}

TEST(Thresholds, OfThePageAreThoseOfTheHeaders) {
  const auto page = thresholds_on_page(contents(root / "docs/reference/thresholds.md"));
  EXPECT_EQ(in_words(page), in_words(thresholds_of_the_tree())) << "scripts/thresholds writes the page anew";
}

TEST(Thresholds, EachHasAUnitAMeaningAndAnOrigin) {
  const std::set<std::string> origins{"derived", "measured", "chosen"};
  std::set<std::string> names;
  for (const Threshold& t : thresholds_of_the_tree()) {
    EXPECT_TRUE(names.insert(t.name).second) << t.name << ": two headers have it";
    EXPECT_FALSE(t.unit.empty() || t.meaning.empty() || t.value.empty()) << test::in_words(t);
    EXPECT_TRUE(origins.count(t.origin)) << test::in_words(t);
  }
}

TEST(Thresholds, NameTestsThatExist) {
  const auto tests = test_names(root);
  for (const Threshold& t : thresholds_of_the_tree()) {
    const bool is_there = std::binary_search(tests.begin(), tests.end(), t.test);
    EXPECT_TRUE(is_there || t.test == "none") << test::in_words(t);
  }
}

TEST(Thresholds, AreReadFromHeadersAndPages) {
  const Threshold alpha{"alpha", "0.05", "probability", "of a false alarm", "chosen", "Clean.IsSilent"},
      gap{"gap", "1.0 / 3", "dB", "between two", "derived", "none"};
  EXPECT_THAT(in_words(thresholds_in_header("// A header.\n\nnamespace t {\n\n// a part\n\n// probability; of a false\n"
                                            "// alarm; chosen; Clean.IsSilent\ninline constexpr double alpha =\n"
                                            "    0.05;\n// dB; between two; derived; none\n"
                                            "inline constexpr double gap = 1.0 / 3;\n}\n")),
              ElementsAre(test::in_words(alpha), test::in_words(gap)));
  EXPECT_THAT(in_words(thresholds_on_page("| name | value |\n|---|---|\n| `alpha` | 0.05 | probability | of a false "
                                          "alarm | chosen | `Clean.IsSilent` | `a.cpp` |\n"
                                          "| `gap` | 1.0 / 3 | dB | between two | derived | none | `b.cpp` |\n")),
              ElementsAre(test::in_words(alpha), test::in_words(gap)));
}

}  // namespace
}  // namespace muster::test
