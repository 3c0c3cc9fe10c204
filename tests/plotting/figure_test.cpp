#include "plotting/figure.hpp"

#include <gmock/gmock.h>
#include <tinyxml2.h>

#include <algorithm>
#include <random>
#include <set>

#include "numbers.hpp"
#include "plotting/labels.hpp"

namespace muster::plotting {
namespace {

using tinyxml2::XMLElement;

// A picture parsed as XML.
class Read {
 public:
  explicit Read(const Figure& figure) {
    EXPECT_EQ(document_.Parse(svg(figure).c_str()), tinyxml2::XML_SUCCESS) << document_.ErrorStr();
    if (document_.RootElement()) walk(document_.RootElement(), "");
  }

  // Number of `mark` in the paths of all groups of this class: "h0" a dot, "z" a closed shape.
  int marks(const std::string& group, const std::string& mark) const {
    int count = 0;
    for (const auto& [of, element] : elements_) {
      const char* data = element->Attribute("d");
      if (of != group || !data) continue;
      const std::string text = data;
      for (auto at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1)) ++count;
    }
    return count;
  }
  int elements(const std::string& group, const std::string& name) const {
    return static_cast<int>(std::count_if(elements_.begin(), elements_.end(), [&](const auto& entry) {
      return entry.first == group && name == entry.second->Name();
    }));
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> result;
    for (const auto& [of, element] : elements_) {
      if (std::string("text") == element->Name() && element->GetText()) result.push_back(element->GetText());
    }
    return result;
  }
  // All path data of a group, and its first colour.
  std::string data(const std::string& group) const {
    std::string result;
    for (const auto& [of, element] : elements_) {
      if (of == group && element->Attribute("d")) result += element->Attribute("d");
    }
    return result;
  }
  std::vector<std::string> fills(const std::string& group) const {
    std::vector<std::string> result;
    for (const auto& [of, element] : elements_) {
      if (of == group && element->Attribute("d")) result.push_back(element->Attribute("fill"));
    }
    return result;
  }

 private:
  void walk(const XMLElement* parent, const std::string& group) {
    for (auto* child = parent->FirstChildElement(); child; child = child->NextSiblingElement()) {
      elements_.emplace_back(group, child);
      const char* name = child->Attribute("class");
      walk(child, name ? name : group);
    }
  }
  tinyxml2::XMLDocument document_;
  std::vector<std::pair<std::string, const XMLElement*>> elements_;
};

Figure one(Layer layer) { return {.panels = {{.layers = {std::move(layer)}}}}; }

TEST(Figure, DrawsOneDotAPoint) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const int count : {1, 2, 150, 1000, 5000, 20000}) {
    Points points;
    for (int i = 0; i < count; ++i) {
      points.x.push_back(normal(random));
      points.y.push_back(normal(random));
    }
    EXPECT_EQ(Read(one(points)).marks("points", "h0"), count);
    points.value = points.x;
    EXPECT_EQ(Read(one(points)).marks("points", "h0"), count);
  }
}

TEST(Figure, TwentyThousandPointsAreBelow350Kilobytes) {
  Points points;
  for (int i = 0; i < 20000; ++i) {
    points.x.push_back(i);
    points.y.push_back(i * 7919 % 20000);
  }
  EXPECT_LT(svg(one(points)).size(), 350000u);
}

TEST(Figure, LeavesOutWhatIsNotANumber) {
  EXPECT_EQ(Read(one(Points{.x = {1, NAN, 3, INFINITY}, .y = {1, 2, NAN, 4}})).marks("points", "h0"), 1);
  EXPECT_EQ(Read(one(Points{.x = {1, 2}, .y = {1, 2}, .value = {NAN, 5}})).marks("points", "h0"), 1);
  EXPECT_EQ(Read(one(Line{.x = {1, 2, 3, 4, 5}, .y = {1, 2, NAN, 4, 5}})).marks("line", "M"), 2);
  EXPECT_EQ(Read(one(Band{.x = {1, 2, 3, 4, 5}, .low = {0, 0, NAN, 0, 0}, .high = {1, 1, 1, 1, 1}})).marks("band", "z"),
            2);
  EXPECT_EQ(Read(one(Cells{.x = {0, 1, 2}, .y = {0, 0, 0}, .value = {1, NAN, 3}})).marks("cells", "z"), 2);
  EXPECT_EQ(Read(one(Robots{.robots = {{{0, 0}, 0, "a"}, {{NAN, 0}, 0, "b"}}})).elements("robots", "circle"), 1);
  EXPECT_EQ(Read(one(Rule{.at = NAN, .label = "x"})).elements("rule", "line"), 0);
  for (const Layer& layer :
       std::initializer_list<Layer>{Points{.x = {1, NAN}, .y = {NAN, 1}}, Line{.x = {NAN}, .y = {1}},
                                    Path{.points = {{NAN, 1}, {2, 3}}, .value = {1, NAN}}}) {
    EXPECT_THAT(svg(one(layer)), testing::Not(testing::HasSubstr("nan")));
  }
}

TEST(Figure, LeavesOutWhatALogAxisCannotShow) {
  Figure figure = one(Points{.x = {-1, 0, 1, 10}, .y = {1, 1, 1, 1}});
  figure.panels[0].x.log = true;
  EXPECT_EQ(Read(figure).marks("points", "h0"), 2);
}

TEST(Figure, SaysHowManyPointsTheLimitsLeaveOut) {
  Figure figure = one(Points{.x = {1, 2, 3, 4}, .y = {1, 2, 300, -400}});
  figure.panels[0].y = {.from = 0, .to = 10};
  const Read read(figure);
  EXPECT_EQ(read.marks("points", "h0"), 2);
  EXPECT_THAT(read.texts(), testing::Contains("2 outside"));
}

TEST(Figure, PutsPointsWhereTheAxesSay) {
  // The plot's box is that of the clip; its corners are the limits.
  Figure figure = one(Points{.x = {0, 10, 5}, .y = {-80, -40, -60}});
  figure.panels[0].x = {.from = 0, .to = 10};
  figure.panels[0].y = {.from = -80, .to = -40};
  const std::string text = svg(figure);
  const auto box = numbers_in(std::string_view(text).substr(text.find("class=\"layers\""), 100));
  const auto at = numbers_in(Read(figure).data("points"));
  ASSERT_GE(box.size(), 4u);
  ASSERT_EQ(at.size(), 9u);  // x, y and the 0 of "h0" a point
  EXPECT_NEAR(at[0], box[0], 0.06);
  EXPECT_NEAR(at[1], box[1] + box[3], 0.06);
  EXPECT_NEAR(at[3], box[0] + box[2], 0.06);
  EXPECT_NEAR(at[4], box[1], 0.06);
  EXPECT_NEAR(at[6], box[0] + box[2] / 2, 0.06);
  EXPECT_NEAR(at[7], box[1] + box[3] / 2, 0.06);
}

TEST(Figure, ShortLinesKeepAllTheirPoints) {
  Line line;
  for (int i = 0; i < 1000; ++i) {
    line.x.push_back(i);
    line.y.push_back(i % 7);
  }
  EXPECT_EQ(Read(one(line)).marks("line", "L"), 999);
}

TEST(Figure, LongLinesKeepTheirSpikes) {
  Line line;
  for (int i = 0; i < 500000; ++i) {
    line.x.push_back(i);
    line.y.push_back(i == 250001 ? 100 : i == 333333 ? -100 : 0);
  }
  Figure figure = one(line);
  figure.panels[0].y = {.from = -100, .to = 100};
  const std::string spiky = Read(figure).data("line");
  EXPECT_LT(spiky.size(), 100000u);
  line.y.assign(line.y.size(), 0);
  figure.panels[0].layers = {line};
  const std::string flat = Read(figure).data("line");
  EXPECT_NE(spiky, flat);
  // Heights present: the middle, the top and the bottom.
  std::set<std::string> heights;
  for (auto at = spiky.find(' '); at != std::string::npos; at = spiky.find(' ', at + 1)) {
    heights.insert(spiky.substr(at + 1, spiky.find_first_of("ML", at) - at - 1));
  }
  EXPECT_EQ(heights.size(), 3u);
}

TEST(Figure, CountsHistogramBars) {
  const Read read(one(Histogram{.values = {0, 5, 10, 15, 30, 29.9, NAN, -1, 70}, .edges = {0, 10, 20, 30}}));
  EXPECT_EQ(read.marks("histogram", "z"), 3);
  EXPECT_THAT(read.texts(), testing::Contains("2 outside"));
  EXPECT_THAT(read.texts(), testing::Contains("2"));  // the count axis has whole numbers
  EXPECT_THAT(read.texts(), testing::Not(testing::Contains("1.5")));
}

TEST(Figure, GreysCellsWithTooFewSamples) {
  const Cells cells{.x = {0, .25, .5}, .y = {0, 0, 0}, .value = {-50, -60, NAN}, .count = {9, 2, 0}, .min_count = 3};
  const Read read(one(cells));
  EXPECT_EQ(read.marks("cells", "z"), 3);
  EXPECT_EQ(read.fills("cells").front(), light_grey.hex());
  EXPECT_THAT(read.texts(), testing::Contains("fewer than 3 samples"));
}

TEST(Figure, CentresDivergingColoursAtZero) {
  Figure figure = one(Cells{.x = {0, 1}, .y = {0, 0}, .value = {0, 9}, .size = 1});
  figure.panels[0].map = Map::diverging;
  const auto fills = Read(figure).fills("cells");
  ASSERT_EQ(fills.size(), 2u);
  // 0 lies between two shades of the 128, next to the middle of the map.
  EXPECT_THAT(fills[0], testing::AnyOf(map_colour(Map::diverging, 63.0 / 127).hex(),
                                       map_colour(Map::diverging, 64.0 / 127).hex()));
}

TEST(Figure, SharedValuesGetTheSameColour) {
  Figure figure{.columns = 2, .share_value = true};
  figure.panels = {{.layers = {Cells{.x = {0, 1}, .y = {0, 0}, .value = {-50, -90}}}},
                   {.layers = {Cells{.x = {0, 1}, .y = {0, 0}, .value = {-50, -60}}}}};
  const auto fills = Read(figure).fills("cells");
  ASSERT_EQ(fills.size(), 4u);
  EXPECT_EQ(fills[1], fills[3]);  // -50, the higher of both panels
  EXPECT_NE(fills[0], fills[2]);
}

FloorPlan rooms() {
  return {
      .walls = {{{0, 0}, {8, 0}, 0.2, "concrete"}, {{8, 0}, {8, 5}, 0.2, "concrete"}, {{4, 0}, {4, 5}, 0.1, "drywall"}},
      .doors = {{{4, 1}, {4, 1.9}, true}, {{4, 3}, {4, 3.9}, false}},
      .stations = {{{1, 1}, "base"}}};
}

TEST(FloorPlans, ShowEveryPartByName) {
  Figure figure{.panels = {{.frame = Frame::scale_bar}}};
  figure.panels[0].layers = {rooms(), Path{.points = {{1, 1}, {2, 2}, {3, 1}}},
                             Links{.links = {{{1, 1}, {2, 2}, -54.4}, {{2, 2}, {6, 4}, -71.2}}, .threshold = -60},
                             Robots{.robots = {{{2, 2}, 0, "leader"}, {{6, 4}, 1.5, "follower"}}}};
  const Read read(figure);
  EXPECT_EQ(read.elements("walls", "line"), 3);
  EXPECT_EQ(read.marks("stations", "z"), 1);
  EXPECT_EQ(read.elements("robots", "circle"), 2);
  EXPECT_EQ(read.elements("links", "line"), 2);
  EXPECT_EQ(read.marks("path", "L"), 2);
  EXPECT_EQ(read.marks("doors", "A"), 1);  // the swing of the open door
  EXPECT_THAT(read.texts(), testing::IsSupersetOf(
                                {"base", "leader", "follower", "−54 dBm", "−71 dBm", "concrete", "drywall", "2 m"}));
}

TEST(FloorPlans, AMetreIsAsLongInXAsInY) {
  Figure figure{
      .panels = {{.frame = Frame::scale_bar, .aspect = 0.9, .layers = {Path{.points = {{0, 0}, {3, 0}, {3, 3}}}}}}};
  const auto at = numbers_in(Read(figure).data("path"));
  ASSERT_EQ(at.size(), 6u);
  EXPECT_NEAR(at[2] - at[0], at[3] - at[5], 0.02);
}

TEST(FloorPlans, PathsColouredByTimeKeepEveryPiece) {
  Path path;
  for (int i = 0; i < 300; ++i) {
    path.points.push_back({0.01 * i, 0.02 * (i % 9)});
    path.value.push_back(0.1 * i);
  }
  const Read read(one(path));
  EXPECT_EQ(read.marks("path", "L"), 299);
  EXPECT_GT(read.marks("path", "M"), 100);  // one a shade
  EXPECT_GT(read.elements("colour-bar", "rect"), 100);
}

TEST(Figure, EveryLayerMayBeEmpty) {
  for (const Layer& layer : std::initializer_list<Layer>{Line{}, Points{}, Rule{}, Band{}, Histogram{}, ErrorBars{},
                                                         Cells{}, FloorPlan{}, Robots{}, Path{}, Links{}}) {
    for (const Frame frame : {Frame::axes, Frame::scale_bar}) {
      Figure figure = one(layer);
      figure.panels[0].frame = frame;
      Read read(figure);
      if (!std::holds_alternative<Rule>(layer)) {
        EXPECT_THAT(read.texts(), testing::Contains("no data")) << layer.index();
      }
      EXPECT_THAT(svg(figure), testing::Not(testing::HasSubstr("nan"))) << layer.index();
      EXPECT_THAT(svg(figure), testing::Not(testing::HasSubstr("inf"))) << layer.index();
    }
  }
  Read(Figure{});
}

TEST(Figure, OneSampleAndConstantDataAreDrawn) {
  for (const double value : {0.0, -60.0, 1e9, 5e-324}) {
    for (const bool equal : {false, true}) {
      Figure figure{.panels = {{.equal = equal}}};
      figure.panels[0].layers = {Line{.x = {3}, .y = {value}, .label = "l"},
                                 Points{.x = {value}, .y = {value}, .value = {value}},
                                 ErrorBars{.x = {value}, .y = {value}, .low = {value}, .high = {value}},
                                 Cells{.x = {0}, .y = {0}, .value = {value}}};
      const Read read(figure);
      EXPECT_EQ(read.marks("points", "h0"), 1);
      EXPECT_EQ(read.marks("line", "h0"), 1);
      EXPECT_EQ(read.marks("cells", "z"), 1);
      EXPECT_THAT(svg(figure), testing::Not(testing::HasSubstr("nan")));
    }
  }
}

TEST(Figure, AcceptsLimitsThatHoldNoData) {
  Figure figure = one(Points{.x = {1, 2}, .y = {1, 2}});
  figure.panels[0].y.from = 50;
  figure.panels[0].x.to = -50;
  EXPECT_THAT(Read(figure).texts(), testing::Contains("2 outside"));
}

TEST(Figure, YFollowsTheDataBetweenTheLimitsOfX) {
  Figure figure = one(Line{.x = {0, 1, 2, 3}, .y = {0, 1, 2, 5000}});
  figure.panels[0].x.to = 2;
  EXPECT_THAT(Read(figure).texts(), testing::Not(testing::Contains("5000")));
  EXPECT_THAT(Read(figure).texts(), testing::Contains("2.0"));
}

TEST(Figure, RefusesColumnsOfDifferentLengths) {
  Figure figure{.panels = {{}, {.title = "traces", .layers = {Line{.x = {1, 2}, .y = {1}}}}}};
  EXPECT_THAT([&] { svg(figure); }, testing::ThrowsMessage<std::invalid_argument>(
                                        "panel 2 (traces): line: columns of 2 and 1 rows; expected the same length"));
  EXPECT_THROW(svg(one(Cells{.x = {1}, .y = {1}, .value = {1}, .count = {1, 2}})), std::invalid_argument);
  EXPECT_THROW(svg(one(Histogram{.values = {1}, .edges = {1, 1}})), std::invalid_argument);
  EXPECT_THROW(svg(one(Path{.points = {{1, 1}}, .value = {1, 2}})), std::invalid_argument);
}

TEST(Figure, RefusesLimitsThatCannotBe) {
  Figure figure{.panels = {{.x = {.from = 3, .to = 1}}}};
  EXPECT_THAT([&] { svg(figure); },
              testing::ThrowsMessage<std::invalid_argument>("panel 1: x axis: from 3 to 1; expected from < to"));
  figure.panels[0].x = {.from = 0, .to = 1, .log = true};
  EXPECT_THROW(svg(figure), std::invalid_argument);
  figure.panels[0].x = {.from = NAN};
  EXPECT_THROW(svg(figure), std::invalid_argument);
}

TEST(Figure, WritesUnitsNamesAndTheCaption) {
  Figure figure{.title = "Title <1>", .caption = "A & B"};
  figure.panels = {
      {.x = {.label = "wall", .names = {"w1", "w2"}},
       .y = {.label = "residual", .unit = "dB"},
       .layers = {ErrorBars{.x = {0, 1}, .y = {1, 2}, .low = {0, 1}, .high = {2, 3}}, Rule{.at = 0, .label = "none"}}}};
  EXPECT_THAT(Read(figure).texts(),
              testing::IsSupersetOf({"Title <1>", "A & B", "w1", "w2", "wall", "residual (dB)", "none"}));
}

// Line for line: bold letters are wider than regular ones, which text_width() bounds.
TEST(Figure, ALongTitleIsWrappedByTheWidthOfBoldLetters) {
  const std::string title =
      "A wall that is not on the map, from (18.58 m, 16.67 m) to (16.23 m, 17.52 m), costs 0.85 dB where it is "
      "crossed, as do 2 more";
  const Figure figure{.title = title, .width = 420, .panels = {{.layers = {rooms()}}}};
  std::string read;
  for (const std::string& text : Read(figure).texts()) {
    if (title.find(text) == title.npos || text.size() < 8) continue;
    read += (read.empty() ? "" : " ") + text;
    EXPECT_LE(1.14 * text_width(text, 16), figure.width) << text;
  }
  EXPECT_EQ(read, title);
}

TEST(Figure, IsTheSameTextEachTime) {
  Figure figure{.panels = {{.frame = Frame::scale_bar, .layers = {rooms()}}}};
  EXPECT_EQ(svg(figure), svg(figure));
}

TEST(Figure, HasNoScriptsIdsOrLinks) {
  const std::string text = svg({.panels = {{.layers = {rooms()}}}});
  for (const char* unwanted : {"<script", " id=", "href", "url(", "<style", "@import"}) {
    EXPECT_THAT(text, testing::Not(testing::HasSubstr(unwanted)));
  }
}

}  // namespace
}  // namespace muster::plotting
