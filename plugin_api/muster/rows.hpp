// Views of a table's rows as structs of doubles, and the checks that keep a plugin inside of them.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace muster {
namespace detail {

// Number of columns of "x[m] range[m]*682 rssi[dBm]?", and of a file's ". " or " +" at its end.
constexpr std::size_t column_count(const char* text) {
  constexpr auto parts = [](char c) { return c == ' ' || c == ',' || c == ';' || c == '\t' || c == '\n'; };
  std::size_t count = 0;
  while (*text) {
    while (*text && parts(*text)) ++text;
    if (!*text) break;
    const char first = *text;
    std::size_t length = 0, alike = 0;
    bool is_unit = false, is_number = false;  // "torque[N*m]" is one column
    for (; *text && !parts(*text); ++text, ++length) {
      if (*text == '[') is_unit = true;
      if (*text == ']') is_unit = false;
      is_number = !is_unit && (*text == '*' || (is_number && *text >= '0' && *text <= '9'));
      if (is_number && *text != '*') alike = 10 * alike + static_cast<std::size_t>(*text - '0');
    }
    if (length > 1 || (first != '.' && first != '+')) count += alike > 0 ? alike : 1;
  }
  return count;
}

// False where a row type states its columns at compile time, and is not one double a column.
template <class Row, std::size_t count = column_count(Row::columns)>
constexpr bool is_one_double_a_column(int) {
  return sizeof(Row) == count * sizeof(double);
}
template <class Row>
constexpr bool is_one_double_a_column(...) {
  return true;
}

// What a member of a row is tried with: it becomes a double and nothing else.
struct OnlyDouble {
  template <class Member, class = std::enable_if_t<std::is_same_v<Member, double>>>
  constexpr operator Member() const {
    return 0;
  }
};
template <class Row, class Members, class = void>
constexpr bool is_made_of = false;
template <class Row, std::size_t... member>
constexpr bool is_made_of<Row, std::index_sequence<member...>,
                          std::void_t<decltype(Row{(static_cast<void>(member), OnlyDouble())...})>> = true;

// False where a member is a bool, a float or an int: one may fill the place of a double, and be none.
template <class Row>
constexpr bool has_only_doubles() {
  constexpr std::size_t doubles = sizeof(Row) / sizeof(double), most_tried = 64;  // beyond: pixels and the like
  if constexpr (sizeof(Row) % sizeof(double) == 0 && std::is_aggregate_v<Row> && doubles <= most_tried)
    return is_made_of<Row, std::make_index_sequence<doubles>>;
  else
    return sizeof(Row) % sizeof(double) == 0;
}

// The columns that a row type states at compile time; else as many as its doubles.
template <class Row, std::size_t count = column_count(Row::columns)>
constexpr std::size_t columns_of(int) {
  return count;
}
template <class Row>
constexpr std::size_t columns_of(...) {
  return sizeof(Row) / sizeof(double);
}

template <class Row, class = void>
constexpr bool has_columns = false;
template <class Row>
inline constexpr bool has_columns<Row, std::void_t<decltype(Row::columns)>> = true;

// The names of a row type's columns; null where it has none, of which check_row_type() speaks.
template <class Row>
constexpr const char* column_names() {
  if constexpr (has_columns<Row>)
    return Row::columns;
  else
    return nullptr;
}

template <class Row>
constexpr void check_row_type() {
  static_assert(
      has_columns<Row>,
      "a row type names its columns, one for each of its doubles, with units: struct State { static constexpr "
      "const char* columns = \"count x[m]\"; double count, x; };");
  constexpr bool only_doubles = has_only_doubles<Row>();
  static_assert(
      only_doubles,
      "a row type has one double for each of its columns: no float, no int, no bool; expected double for each "
      "member, 0 or 1 for what is a bool");
  constexpr std::size_t columns = columns_of<Row>(0), doubles = only_doubles ? sizeof(Row) / sizeof(double) : columns;
  static_assert(doubles == columns,
                "a row type has one double for each of its columns, none too few or too many; compared are its doubles "
                "and the names in its `columns`");
}

// A row that a table does not have. The table is named where it is caught, by the claim's number.
struct NoRow : std::out_of_range {
  NoRow(std::size_t row, std::size_t rows, int claimed)
      : std::out_of_range("row " + std::to_string(row) + " of " + std::to_string(rows)),
        at(row),
        size(rows),
        claim(claimed) {}
  std::size_t at, size;
  int claim;
};
[[noreturn]] __attribute__((noinline, cold)) inline void no_row(std::size_t row, std::size_t rows, int claim) {
  throw NoRow(row, rows, claim);
}

// "uses row 1 of robot/r1/command, which has 1 row here"; `table`: its name, or null.
inline std::string in_words(const NoRow& e, const char* table) {
  const char* remedy = e.size == 0   ? "expected a look at empty() first"
                       : e.size == 1 ? "expected row 0, or *k[table]"
                                     : "expected rows from 0 on and below k[table].size()";
  return "uses row " + std::to_string(e.at) + " of " + (table ? table : "a table") + ", which has " +
         std::to_string(e.size) + (e.size == 1 ? " row" : " rows") + " here; " + remedy;
}

}  // namespace detail

// View of a table's rows. A row that is not there throws: of a write, it would be another's.
template <class Row>
class Rows {
 public:
  using Double = std::conditional_t<std::is_const_v<Row>, const double, double>;
  static_assert(sizeof(Row) % sizeof(double) == 0 && std::is_trivially_copyable_v<Row>, "a row is doubles and no more");

  // `claim`: its number among the plugin's claims, for messages; -1: none.
  Rows(Double* data, std::size_t rows, int claim = -1)
      : begin_(reinterpret_cast<Row*>(data)), size_(rows), claim_(claim) {}
  Row* begin() const { return begin_; }
  Row* end() const { return begin_ + size_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  Row& operator[](std::size_t i) const {
    if (__builtin_expect(i >= size_, 0)) detail::no_row(i, size_, claim_);
    return begin_[i];
  }
  Row* operator->() const { return &(*this)[0]; }  // the row of a claim on a single row
  Row& operator*() const { return (*this)[0]; }

 private:
  Row* begin_;
  std::size_t size_;
  int claim_;
};

}  // namespace muster
