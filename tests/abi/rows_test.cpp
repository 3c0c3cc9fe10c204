// Row types and views of rows: what the compiler checks of them, and what a step does.
#include <gtest/gtest.h>

#include <array>
#include <muster/plugin.hpp>
#include <muster/senses.hpp>

namespace muster {
namespace {

struct Floats {
  static constexpr const char* columns = "v[m/s] w[rad/s]";
  float v, w;
};
struct Few {
  static constexpr const char* columns = "x y z";
  double x, y;
};
struct Many {
  static constexpr const char* columns = "id range[m]*3~";
  double id, range[3];
};
struct Flagged {
  [[maybe_unused]] static constexpr const char* columns = "heading[rad] valid";
  double heading;
  bool valid;
};
struct Counted {
  [[maybe_unused]] static constexpr const char* columns = "heading[rad] count";
  double heading;
  long count;
};
struct Parts {
  [[maybe_unused]] static constexpr const char* columns = "id x[m] y[m]";
  double id;
  struct {
    double x, y;
  } at;
};
struct Named {
  static const char* columns;  // not known to the compiler
  double x;
};
const char* Named::columns = "x";

struct Nameless {
  double x;
};

TEST(RowTypes, HaveOneDoubleForEachColumn) {
  static_assert(detail::has_columns<Few> && detail::has_columns<Named> && !detail::has_columns<Nameless>);
  EXPECT_EQ(detail::column_count("v[m/s] w[rad/s]"), 2u);
  EXPECT_EQ(detail::column_count("  torque[N*m]  range[m]*682~ payload{} tx:endpoint? "), 685u);
  EXPECT_EQ(detail::column_count("azimuth[rad] gain[dBi] ."), 2u);
  EXPECT_EQ(detail::column_count("tx:radio+ rssi[dBm]? +"), 2u);
  EXPECT_EQ(detail::column_count(""), 0u);
  static_assert(detail::is_one_double_a_column<Command>(0) && detail::is_one_double_a_column<Legs>(0));
  static_assert(detail::is_one_double_a_column<Scan>(0) && detail::is_one_double_a_column<Image>(0));
  static_assert(detail::is_one_double_a_column<Many>(0) && detail::is_one_double_a_column<Named>(0));
  static_assert(!detail::is_one_double_a_column<Floats>(0) && !detail::is_one_double_a_column<Few>(0));
}

// A bool beside a double fills a double's place, and would be read as one.
TEST(RowTypes, HaveNothingButDoubles) {
  static_assert(!detail::has_only_doubles<Flagged>() && !detail::has_only_doubles<Counted>());
  static_assert(!detail::has_only_doubles<Floats>());
  static_assert(detail::has_only_doubles<Few>() && detail::has_only_doubles<Many>());
  static_assert(detail::has_only_doubles<Parts>() && detail::has_only_doubles<Named>());
  static_assert(detail::has_only_doubles<Command>() && detail::has_only_doubles<Scan>());
  EXPECT_EQ(detail::columns_of<Few>(0), 3u);
  EXPECT_EQ(detail::columns_of<Named>(0), 1u);
}

TEST(RowTypes, ARowThatIsNotThereIsNeitherReadNorWritten) {
  std::array<double, 6> cells{1, 2, 3, 4, 5, 6};
  const Rows<Command> rows(cells.data(), 2, 7);
  rows[1].w = 40;
  EXPECT_EQ(cells[3], 40);
  try {
    rows[2].v = 50;
    FAIL() << "nothing was thrown";
  } catch (const detail::NoRow& fault) {
    EXPECT_EQ(fault.at, 2u);
    EXPECT_EQ(fault.size, 2u);
    EXPECT_EQ(fault.claim, 7);
  }
  EXPECT_EQ(cells[4], 5);
  const Rows<const Command> none(nullptr, 0);
  EXPECT_THROW(static_cast<void>(none->v), detail::NoRow);
  EXPECT_THROW(static_cast<void>(*none), detail::NoRow);
  for (const Command& row : none) FAIL() << row.v;
}

// What a constructor forgot to set is told, and no memory beside the views is read.
TEST(Step, AMemberThatTheConstructorNeverSetIsRefused) {
  const std::array<double, 1> params{5};
  const muster_tick tick{sizeof(muster_tick), 0, 1, 0.1, 0.1, params.data()};
  const Step step(nullptr, &tick, nullptr, nullptr);
  EXPECT_EQ(step[Value{0}], 5);
  const auto said = [](const auto& use) {
    try {
      use();
    } catch (const std::runtime_error& fault) {
      return std::string(fault.what());
    }
    return std::string();
  };
  EXPECT_EQ(said([&] { step[Value{}]; }),
            "step() uses a Value that the constructor never set; expected MEMBER(s.value(\"NAME\")) among its "
            "initialisers");
  EXPECT_NE(said([&] { step[In<Command>{}]; }).find("an In that"), std::string::npos);
  EXPECT_NE(said([&] { step[Out<Command>{}]; }).find("an Out that"), std::string::npos);
  EXPECT_NE(said([&] { step[Stage<Command>{}]; }).find("a Stage that"), std::string::npos);
}

}  // namespace
}  // namespace muster
