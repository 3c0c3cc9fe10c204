// The file of a sweep: what it means, and each of its faults with place, expectation and nearest name.
#include "sweep/sweep_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/folder.hpp"

namespace muster::sweep {
namespace {

using test::Folder;
using testing::ElementsAre;

std::vector<std::string> texts(const std::vector<Word>& words) {
  std::vector<std::string> result;
  for (const Word& word : words) result.push_back(word.text);
  return result;
}

TEST(SweepFile, EveryValueMeetsEveryOther) {
  const Folder folder;
  const auto sweep = read_sweep(folder.write("s.xml",
                                             "<sweep world=\"w\" seeds=\"7 1..3\" until=\"5\">\n"
                                             "<vary set=\"a/b\" values=\"1 2\"/>\n"
                                             "<vary instance=\"p\" plugins=\"x.y x.z:c=3\"/>\n"
                                             "<metric of=\"t/c\" take=\"least\"/></sweep>"));
  EXPECT_EQ(sweep.name(), "s");
  EXPECT_THAT(sweep.seeds, ElementsAre(7, 1, 2, 3));
  ASSERT_EQ(sweep.combinations(), 4u);
  EXPECT_THAT(texts(sweep.combination(0)), ElementsAre("1", "x.y"));
  EXPECT_THAT(texts(sweep.combination(1)), ElementsAre("1", "x.z:c=3"));
  EXPECT_THAT(texts(sweep.combination(2)), ElementsAre("2", "x.y"));
  EXPECT_THAT(texts(sweep.combination(3)), ElementsAre("2", "x.z:c=3"));
  EXPECT_EQ(sweep.combination(3)[1].place.text(), folder.at("s.xml") + ":3:33");
  EXPECT_EQ(sweep.metrics[0].over, Over::least);
  EXPECT_EQ(sweep.until->text, "5");
}

TEST(SweepFile, WithoutAVariationThereIsOneCombination) {
  const Folder folder;
  const auto sweep = read_sweep(folder.write("s.xml", "<sweep world=\"w\" seeds=\"1\"/>"));
  EXPECT_EQ(sweep.combinations(), 1u);
  EXPECT_TRUE(sweep.combination(0).empty());
}

TEST(SweepFile, TellsWhatIsWrongAndWhere) {
  struct Fault {
    std::string text, message;
  };
  const std::string head = "<sweep world=\"w\" seeds=\"1..20\">\n";
  const std::vector<Fault> faults{
      {"<world/>", "1:1: <world> is no sweep; expected <sweep world=\"...\" seeds=\"1..20\">"},
      {"<sweep world=\"w\"/>", "1:1: <sweep> needs seeds=\"...\""},
      {"<sweep seeds=\"1\"/>", "1:1: <sweep> needs world=\"...\""},
      {"<sweep world=\"w\" sed=\"1\" seeds=\"1\"/>",
       "1:18: <sweep> has no attribute \"sed\"; expected one of world, seeds, until; did you mean \"seeds\"?"},
      {"<sweep world=\"w\" seeds=\"1 x\"/>",
       "1:27: \"x\" is no seed; expected an integer from 0, or a range such as 1..20"},
      {"<sweep world=\"w\" seeds=\"-1\"/>",
       "1:25: \"-1\" is no seed; expected an integer from 0, or a range such as 1..20"},
      {"<sweep world=\"w\" seeds=\"9..2\"/>", "1:25: the range \"9..2\" is empty; expected its least seed first"},
      {"<sweep world=\"w\" seeds=\"1..5 4\"/>", "1:30: the seed 4 is there already; expected each seed once"},
      {"<sweep world=\"w\" seeds=\"0..1000000\"/>", "1:25: more than 1000000 seeds"},
      {"<sweep world=\"w\" seeds=\"0 1..1000000\"/>", "1:27: more than 1000000 seeds"},
      {head + "<vari set=\"a\"/></sweep>",
       "2:1: there is no element <vari> in a sweep; expected one of vary, metric; did you mean \"vary\"?"},
      {head + "<vary set=\"a\"/></sweep>", "2:1: <vary> needs values=\"...\""},
      {head + "<vary values=\"1\"/></sweep>",
       "2:1: <vary> varies one thing; expected set=\"PATH\" values=\"...\", instance=\"NAME\" plugins=\"...\" or "
       "worlds=\"...\""},
      {head + "<vary set=\"a\" values=\"1\" plugins=\"x\"/></sweep>", "2:26: plugins= needs instance= beside it"},
      {head + "<vary set=\"a\" values=\"1 2\n 1\"/></sweep>",
       "3:2: \"1\" stands twice in values; expected each value once"},
      {head + "<vary set=\"a\" values=\" \"/></sweep>", "2:23: values=\"\" is empty; expected words"},
      {head + "<vary worlds=\"a b\"/></sweep>",
       "1:8: the world is given here and varied; expected world= or <vary worlds=\"...\"/>"},
      {head + "<metric of=\"a/b\" take=\"last\"/></sweep>",
       "2:24: there is no take=\"last\"; expected one of end, mean, least, most; did you mean \"least\"?"},
      {head + "<metric/></sweep>", "2:1: <metric> needs of=\"...\""},
  };
  const Folder folder;
  for (const Fault& fault : faults) {
    const auto file = folder.write("s.xml", fault.text);
    try {
      read_sweep(file);
      ADD_FAILURE() << "accepted: " << fault.text;
    } catch (const Error& e) {
      EXPECT_EQ(e.exit(), Exit::invalid_input);
      EXPECT_EQ(folder.inside(e.what()), "s.xml:" + fault.message);
    }
  }
}

TEST(SweepFile, VariesAThingOnce) {
  const Folder folder;
  const auto file = folder.write("s.xml",
                                 "<sweep world=\"w\" seeds=\"1\">\n<vary set=\"a\" values=\"1\"/>\n"
                                 "<vary set=\"a\" values=\"2\"/></sweep>");
  try {
    read_sweep(file);
    ADD_FAILURE();
  } catch (const Error& e) {
    EXPECT_EQ(folder.inside(e.what()),
              "s.xml:3:12: \"a\" is varied already at s.xml:2:12; expected one <vary> with all its values");
  }
}

}  // namespace
}  // namespace muster::sweep
