// A reader outside of the run holds a table's numbers: they keep their address and values whatever becomes of the
// table.
#include <gtest/gtest.h>

#include "kernel/blackboard.hpp"

namespace muster::test {
namespace {

struct HeldNumbersTest : testing::Test {
  HeldNumbersTest() {
    set.name = "robot";
    set.kind = SetKind::live;
    set.add("a");
    table = std::make_unique<Table>("robot/*/place", set, Columns("x[m] y[m]"), "");
    table->grow();
  }
  void publish(double value) {
    table->begin(true, ++tick);
    std::fill(table->next().data.begin(), table->next().data.end(), value);
    table->publish(tick);
    table->end_tick();
  }
  Set set;
  std::unique_ptr<Table> table;
  uint64_t tick = 0;
};

TEST_F(HeldNumbersTest, AreThoseOfTheTableWithoutACopy) {
  publish(1);
  const auto reader = table->hold();
  EXPECT_TRUE(reader->data.empty());
  EXPECT_EQ(table->hold(), reader);
}

TEST_F(HeldNumbersTest, StayThroughSteps) {
  publish(1);
  const double* first = table->now().data.data();
  const auto reader = table->hold();
  publish(2);
  const double* second = table->now().data.data();
  const auto other = table->hold();
  for (int i = 3; i < 9; ++i) publish(i);
  EXPECT_EQ(reader->data.data(), first);
  EXPECT_EQ(other->data.data(), second);
  EXPECT_EQ(first[1], 1);
  EXPECT_EQ(second[1], 2);
  EXPECT_EQ(table->now().data[1], 8);
}

TEST_F(HeldNumbersTest, StayWhereValuesAreStored) {
  publish(1);
  const double* held = table->now().data.data();
  const auto reader = table->hold();
  table->stored().data[0] = 5;
  EXPECT_EQ(held[0], 1);
  EXPECT_EQ(table->now().data[0], 5);
  EXPECT_EQ(table->now().data[1], 1);
}

TEST_F(HeldNumbersTest, StayWhereRowsJoin) {
  publish(1);
  const double* held = table->now().data.data();
  const auto reader = table->hold();
  set.add("b");
  table->grow();
  publish(2);
  EXPECT_EQ(table->now().rows, 2u);
  EXPECT_EQ(reader->data.size(), 2u);
  EXPECT_EQ(held[1], 1);
}

TEST_F(HeldNumbersTest, StayWhereATickIsTakenBack) {
  publish(1);
  table->begin(true, ++tick);
  table->next().data[0] = 7;
  table->publish(tick);
  const double* held = table->now().data.data();
  const auto reader = table->hold();
  table->take_back();
  EXPECT_EQ(table->now().data[0], 1);
  publish(2);
  EXPECT_EQ(held[0], 7);
}

TEST_F(HeldNumbersTest, StayWhereTheTableIsTakenOverOrGone) {
  publish(1);
  const double* held = table->now().data.data();
  const auto reader = table->hold();
  auto next = std::make_unique<Table>("robot/*/place", set, Columns("x[m] y[m]"), "");
  next->take_over(std::move(*table));
  table = std::move(next);
  publish(2);
  publish(3);
  EXPECT_EQ(held[0], 1);
  const double* last = table->now().data.data();
  const auto other = table->hold();
  table.reset();
  EXPECT_EQ(last[0], 3);
  EXPECT_EQ(other->data.size(), 2u);
}

TEST_F(HeldNumbersTest, AreOfNoMoreUseOnceTheReaderIsGone) {
  publish(1);
  const double* now = table->now().data.data();
  table->hold().reset();
  publish(2);
  publish(3);
  EXPECT_EQ(table->now().data.data(), now);  // no copy was made: the two buffers take turns
}

}  // namespace
}  // namespace muster::test
