// A summary of runs whose numbers are known.
#include "sweep/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/folder.hpp"
#include "text/text_table.hpp"

namespace muster::sweep {
namespace {

using test::Folder;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

struct Known {
  Folder folder;
  SweepFile sweep = read_sweep(folder.write("s.xml",
                                            "<sweep world=\"w\" seeds=\"4 8 15\"><vary set=\"a/b\" values=\"1 2\"/>"
                                            "<vary instance=\"p\" plugins=\"x.y x.z\"/></sweep>"));
  std::vector<MetricTitle> metrics{{"far", "m"}};
  std::vector<DoneJob> runs;

  // Combination c and seed s: 10 c + s^2, so that a difference is 10 c at each seed.
  Known() {
    for (std::size_t c = 0; c < 4; ++c) {
      for (const std::int64_t seed : sweep.seeds) {
        DoneJob run;
        run.number = static_cast<std::int64_t>(runs.size());
        run.combination = c, run.seed = seed, run.time = 2.5, run.digest = "00ff00ff00ff00ff";
        run.values = {10 * static_cast<double>(c) + static_cast<double>(seed * seed)};
        runs.push_back(run);
      }
    }
  }
};

TEST(Summary, CommonSeedsLeaveTheDifferenceAlone) {
  const Known known;
  const Summary summary = summary_of(known.sweep, known.metrics, known.runs);
  ASSERT_EQ(summary.cells.size(), 4u);
  for (std::size_t c = 0; c < 4; ++c) {
    const Cell& cell = summary.cells[c][0];
    EXPECT_NEAR(cell.value.mean, 10.0 * static_cast<double>(c) + (16 + 64 + 225) / 3.0, 1e-12);
    EXPECT_GT(cell.value.deviation, 100);
    EXPECT_EQ(cell.difference.count, c == 0 ? 0u : 3u);
    if (c == 0) continue;
    EXPECT_EQ(cell.difference.mean, 10.0 * static_cast<double>(c));
    EXPECT_EQ(cell.difference.deviation, 0);
  }
}

TEST(Summary, AFailedRunIsCountedAndLeftOut) {
  Known known;
  known.runs[4].fault = "broken, and \"so\"";
  known.runs[4].values = {no_value};
  const Summary summary = summary_of(known.sweep, known.metrics, known.runs);
  EXPECT_THAT(summary.failed, ElementsAre(0, 1, 0, 0));
  EXPECT_EQ(summary.cells[1][0].value.count, 2u);
  EXPECT_EQ(summary.cells[1][0].difference.count, 2u);
  EXPECT_EQ(summary.cells[2][0].value.count, 3u);
}

TEST(Summary, IsWrittenAsTablesThatAreReadBack) {
  Known known;
  known.runs[4].fault = "broken, and \"so\"";
  known.runs[4].values = {no_value};
  const Summary summary = summary_of(known.sweep, known.metrics, known.runs);
  const auto files = write_summary(summary, known.sweep, known.runs, known.folder.path());
  ASSERT_EQ(files.size(), 3u);
  const auto runs = TextTable::read(files[0]);
  EXPECT_EQ(runs.rows(), 12u);
  EXPECT_EQ(runs.reals(runs.require("far", "m"), {.empty = true})[11], 30 + 225);
  EXPECT_EQ(runs.text(4, runs.require("fault", "")), "broken, and \"so\"");
  EXPECT_EQ(runs.text(11, runs.require("p", "")), "x.z");
  EXPECT_EQ(runs.reals(runs.require("seed", ""))[11], 15);
  const auto table = TextTable::read(files[1]);
  EXPECT_EQ(table.rows(), 4u);
  EXPECT_EQ(table.reals(table.require("difference", ""), {.empty = true})[3], 30);
  const std::string picture = test::contents(files[2]);
  EXPECT_THAT(picture, HasSubstr("far, less the first"));
  EXPECT_THAT(picture, HasSubstr("x.y"));
  // The same bytes again.
  const Folder other;
  const auto again = write_summary(summary, known.sweep, known.runs, other.path());
  for (std::size_t i = 0; i < files.size(); ++i) EXPECT_EQ(test::contents(files[i]), test::contents(again[i]));
}

// By hand: 16, 64 and 225 have a mean of 101.67 and a deviation of 109.47, and t of 2 degrees is 4.3027.
TEST(Summary, IsPrinted) {
  const Known known;
  const std::string text = text_of(summary_of(known.sweep, known.metrics, known.runs));
  EXPECT_EQ(text,
            "far [m]\n"
            "  #  a/b  p    runs   mean    95 % interval  deviation  less #1  95 % interval\n"
            "  1  1    x.y     3  101.7  -170.3 .. 373.6      109.5        -              -\n"
            "  2  1    x.z     3  111.7  -160.3 .. 383.6      109.5       10       10 .. 10\n"
            "  3  2    x.y     3  121.7  -150.3 .. 393.6      109.5       20       20 .. 20\n"
            "  4  2    x.z     3  131.7  -140.3 .. 403.6      109.5       30       30 .. 30\n");
}

// Lines of a picture lie where their values are: of the axis's two values, the first is at the left.
TEST(Summary, DrawsALineForEachCombinationOfTheRest) {
  const Known known;
  const auto figure = figure_of(summary_of(known.sweep, known.metrics, known.runs), known.sweep);
  ASSERT_EQ(figure.panels.size(), 2u);
  std::vector<plotting::Line> lines;
  for (const auto& layer : figure.panels[1].layers) {
    if (const auto* line = std::get_if<plotting::Line>(&layer)) lines.push_back(*line);
  }
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(figure.panels[1].x.label, "a/b");
  EXPECT_EQ(lines[0].label, "x.y");
  EXPECT_THAT(lines[0].x, ElementsAre(1, 2));
  EXPECT_THAT(lines[0].y, ElementsAre(0, 20));
  EXPECT_EQ(lines[1].label, "x.z");
  EXPECT_THAT(lines[1].y, ElementsAre(10, 30));
}

}  // namespace
}  // namespace muster::sweep
