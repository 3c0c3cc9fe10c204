#include <gmock/gmock.h>
#include <tinyxml2.h>

#include "numbers.hpp"
#include "plotting/labels.hpp"

namespace muster::plotting {
namespace {

TEST(Escaped, LeavesNoMarkup) { EXPECT_EQ(escaped("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;"); }

TEST(Escaped, KeepsLettersOfAllLanguages) { EXPECT_EQ(escaped("Größe −60 dBm ≤ 走 😀"), "Größe −60 dBm ≤ 走 😀"); }

TEST(Escaped, ReplacesWhatXmlDoesNotAllow) {
  using namespace std::string_view_literals;
  EXPECT_EQ(escaped("a\0b\x1b\x7f"sv), "a\uFFFDb\uFFFD\x7f");
  EXPECT_EQ(escaped("\xff\xfe"), "\uFFFD\uFFFD");
  EXPECT_EQ(escaped("caf\xe9"), "caf\uFFFD");                // Latin-1
  EXPECT_EQ(escaped("\xc0\xaf"), "\uFFFD\uFFFD");            // overlong
  EXPECT_EQ(escaped("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");  // a surrogate
  EXPECT_EQ(escaped("\xef\xbf\xbf"), "\uFFFD\uFFFD\uFFFD");  // U+FFFF
  EXPECT_EQ(escaped("end \xe2\x82"), "end \uFFFD\uFFFD");    // cut short
}

TEST(Svg, TextComesBackFromAnXmlReader) {
  Svg svg;
  const std::string text = "<script>alert(\"1 & 2\")</script>";
  svg.text({1, 2}, text, {});
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(svg.document(10, 10, text, text).c_str()), tinyxml2::XML_SUCCESS);
  const auto* root = document.RootElement();
  EXPECT_EQ(root->FirstChildElement("text")->GetText(), text);
  EXPECT_EQ(root->FirstChildElement("title")->GetText(), text);
  EXPECT_EQ(root->FirstChildElement("script"), nullptr);
}

TEST(Pen, BreaksALineWherePointsAreMissing) {
  Pen pen;
  pen.polyline({{NAN, 0}, {1, 1}, {2, 2}, {3, NAN}, {4, 4}, {NAN, NAN}, {5, 5}, {6, 6}});
  EXPECT_EQ(pen.data(), "M1 1L2 2M4 4h0M5 5L6 6");
}

TEST(Pen, WritesHundredthsWithoutTrailingZeros) {
  Pen pen;
  pen.move({1.005, -0.001});
  pen.line({100, 2.5});
  EXPECT_EQ(pen.data(), "M1 0L100 2.5");
}

// "Cap" is 19.12 px wide in Helvetica and 19.46 in DejaVu Sans, whose C is the narrower.
TEST(TextWidth, HoldsHelveticaAndDejaVuSans) {
  EXPECT_DOUBLE_EQ(text_width("", 10), 0);
  EXPECT_DOUBLE_EQ(text_width("Cap", 10), 7.22 + 6.13 + 6.35);
  EXPECT_GE(text_width("é", 10), 6.16);  // one letter, two bytes
  EXPECT_LT(text_width("é", 10), 7);
  EXPECT_GE(text_width("\u22125", 10), 8.38 + 6.36);  // minus 5
}

TEST(Wrapped, KeepsAllWordsInLinesOfTheGivenWidth) {
  const std::string text = "one two  three four five six seven eight nine ten";
  std::string joined;
  for (const std::string& line : wrapped(text, 60, 10)) {
    EXPECT_LE(text_width(line, 10), 60);
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, "one two three four five six seven eight nine ten");
}

TEST(Spread, MovesOnlyWhatCollides) {
  EXPECT_THAT(spread({10, 50, 90}, 12, {0, 100}), testing::ElementsAre(10, 50, 90));
  EXPECT_THAT(spread({50, 50}, 12, {0, 100}), testing::ElementsAre(44, 56));
  EXPECT_THAT(spread({99, 98}, 12, {0, 100}), testing::ElementsAre(100, 88));
  EXPECT_TRUE(spread({}, 12, {0, 100}).empty());
}

TEST(Spread, KeepsDistanceAndOrder) {
  const std::vector<double> wanted{5, 6, 7, 50, 3, 51, 90, 2};
  const auto places = spread(wanted, 10, {0, 100});
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    for (std::size_t j = 0; j < wanted.size(); ++j) {
      if (wanted[i] < wanted[j]) {
        EXPECT_LE(places[i] + 10, places[j] + 1e-9);
      }
    }
  }
}

TEST(Labels, DoNotCoverMarksOrEachOther) {
  Labels labels;
  Svg svg;
  labels.occupy({40, 40, 20, 20}, 5);
  labels.beside({50, 50}, 10, "first", black);
  labels.beside({50, 50}, 10, "second", black);
  labels.write(svg, {0, 0, 200, 200});
  tinyxml2::XMLDocument document;
  document.Parse(svg.document(200, 200, "", "").c_str());
  std::vector<Box> boxes{{40, 40, 20, 20}};
  for (auto* text = document.RootElement()->FirstChildElement("text"); text; text = text->NextSiblingElement("text")) {
    const double x = numbers_in(text->Attribute("x")).at(0), y = numbers_in(text->Attribute("y")).at(0);
    const double width = text_width(text->GetText(), 10.5);
    boxes.push_back({x - width / 2, y - 9, width, 10.5});
  }
  ASSERT_EQ(boxes.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool apart = boxes[i].right() <= boxes[j].x || boxes[j].right() <= boxes[i].x ||
                         boxes[i].bottom() <= boxes[j].y || boxes[j].bottom() <= boxes[i].y;
      EXPECT_TRUE(apart) << i << " and " << j;
    }
  }
}

TEST(Maps, ViridisGrowsLighterAllTheWay) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_LT(lightness(map_colour(Map::viridis, i / 100.0)), lightness(map_colour(Map::viridis, (i + 1) / 100.0)));
  }
}

TEST(Maps, DivergingIsLightestInTheMiddleAndDarkensToBothSides) {
  for (int i = 0; i < 50; ++i) {
    EXPECT_LT(lightness(map_colour(Map::diverging, i / 100.0)), lightness(map_colour(Map::diverging, (i + 1) / 100.0)));
    EXPECT_LT(lightness(map_colour(Map::diverging, 1 - i / 100.0)),
              lightness(map_colour(Map::diverging, 1 - (i + 1) / 100.0)));
    EXPECT_NEAR(lightness(map_colour(Map::diverging, i / 100.0)), lightness(map_colour(Map::diverging, 1 - i / 100.0)),
                0.12);
  }
}

TEST(Maps, TakeTheEndsColoursBeyondTheEnds) {
  EXPECT_EQ(map_colour(Map::viridis, -1), map_colour(Map::viridis, 0));
  EXPECT_EQ(map_colour(Map::viridis, 7), map_colour(Map::viridis, 1));
  EXPECT_EQ(map_colour(Map::viridis, 1).hex(), "#fde725");
}

}  // namespace
}  // namespace muster::plotting
