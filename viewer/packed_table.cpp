#include "packed_table.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <numeric>

#include "column_code.hpp"
#include "text/columns.hpp"
#include "text/error.hpp"
#include "text/number.hpp"

namespace muster::viewer {
namespace {

constexpr std::size_t first_own = 2;        // after the time and the row's name
constexpr std::size_t most_numbered = 500;  // rows without names that are groups of their own

template <class T>
std::vector<T> at_rows(const std::vector<T>& all, const std::vector<std::size_t>& rows) {
  std::vector<T> result;
  result.reserve(rows.size());
  for (const std::size_t r : rows) result.push_back(all[r]);
  return result;
}

// Two hexadecimal digits a byte, eight bytes a double, as the recorder writes them; empty where it is no such text.
std::vector<double> doubles_of(const std::string& digits) {
  std::vector<double> result(digits.size() / 16);
  for (std::size_t i = 0; i < result.size(); ++i) {
    unsigned char bytes[8];
    for (std::size_t b = 0; b < 8; ++b) {
      const char* at = digits.data() + 16 * i + 2 * b;
      if (std::from_chars(at, at + 2, bytes[b], 16).ptr != at + 2) return {};
    }
    std::memcpy(&result[i], bytes, sizeof bytes);
  }
  return result;
}

// The ranges of lasers are numbers; other bytes are shown by their length alone.
bool is_list(const std::string& table, const std::string& column) {
  return table.starts_with("scan/") && table.ends_with("/message") && column == "ranges";
}

TextTable read_table(const std::filesystem::path& file) {
  try {
    return TextTable::read(file);
  } catch (const Error& e) {
    throw Error(e.exit(), std::string(e.what()) + "; run.json lists this table, run the world again");
  }
}

}  // namespace

TableToPack::TableToPack(const RecordFolder& record, const RecordedTable& table)
    : declared_(table), text_(read_table(record.path / table.file)), tick_(record.dt) {
  const Columns columns(table.columns);
  if (text_.columns().size() != columns.size() + first_own || text_.columns()[0].name != "t")
    throw invalid({text_.file()},
                  "has other columns than run.json declares for " + table.table + "; run the world again");
  is_bytes_.assign(first_own, false);
  for (const Column& column : columns) is_bytes_.push_back(column.bytes);
  time_ = text_.reals(0);
  for (std::size_t r = 0; r < time_.size(); ++r) times_ += r == 0 || time_[r] != time_[r - 1];
  numbers_ = text_.rows() * text_.columns().size();
  for (std::size_t c = first_own; c < is_bytes_.size(); ++c) {
    if (!is_bytes_[c] || !is_list(table.table, text_.columns()[c].name)) continue;
    for (std::size_t r = 0; r < text_.rows(); ++r) numbers_ += text_.text(r, c).size() / 16;
  }
}

bool TableToPack::holds_names(std::size_t column) const {
  if (column == 0) return false;  // the time
  if (column < first_own) return declared_.kind == "fixed" || declared_.kind == "live";
  const Columns columns(declared_.columns);
  return !columns[column - first_own].reference.empty() && !text_.is_numeric(column);
}

// Rows in the order of their keys, each group in the order of time.
Factor TableToPack::keys() const {
  if (holds_names(1)) return text_.texts(1);
  if (declared_.kind == "queue" && holds_names(first_own)) return text_.texts(first_own, {.empty = true});
  Factor result;
  for (const double number : text_.reals(1)) {
    const std::string name = print_real(number);
    const auto known = std::find(result.levels.begin(), result.levels.end(), name);
    result.level.push_back(static_cast<std::uint32_t>(known - result.levels.begin()));
    if (known == result.levels.end()) result.levels.push_back(name);
    if (result.levels.size() > most_numbered) break;
  }
  if (declared_.kind != "queue" && result.levels.size() <= most_numbered) return result;
  return {std::vector<std::uint32_t>(text_.rows(), 0), {""}};
}

std::vector<std::size_t> TableToPack::kept_rows(std::uint64_t keep_every) const {
  std::vector<std::size_t> rows;
  std::uint64_t time = 0;
  for (std::size_t r = 0; r < time_.size(); ++r) {
    if (r > 0 && time_[r] != time_[r - 1]) ++time;
    if (time % keep_every == 0) rows.push_back(r);
  }
  return rows;
}

Json TableToPack::packed(std::uint64_t keep_every, std::string& bytes) const {
  auto rows = kept_rows(keep_every);
  const Factor key = keys();
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) { return key.level[a] < key.level[b]; });
  Json starts = Json::array();
  for (std::size_t k = 0; k <= key.levels.size(); ++k) {
    const auto begin = std::partition_point(rows.begin(), rows.end(), [&](std::size_t r) { return key.level[r] < k; });
    starts.push_back(begin - rows.begin());
  }
  const std::size_t key_column = declared_.kind == "queue" ? first_own : 1;
  Json columns = Json::array();
  for (std::size_t c = 0; c < text_.columns().size(); ++c) columns.push_back(packed_column(c, rows, bytes));
  return {{"table", declared_.table},
          {"file", declared_.file},
          {"rows", rows.size()},
          {"times_in_record", times_},
          {"kept_every", keep_every},
          {"key", {{"column", text_.columns()[key_column].name}, {"values", key.levels}, {"starts", starts}}},
          {"columns", columns}};
}

Json TableToPack::packed_column(std::size_t column, const std::vector<std::size_t>& rows, std::string& bytes) const {
  TextColumn title = text_.columns()[column];
  Json code;
  if (is_bytes_[column] && is_list(declared_.table, title.name)) {
    std::vector<std::vector<double>> lists;
    for (const std::size_t r : rows) lists.push_back(doubles_of(text_.text(r, column)));
    code = code_of(lists, tick_, bytes);
  } else if (is_bytes_[column]) {
    title.unit = "bytes";
    std::vector<double> sizes;
    for (const std::size_t r : rows) sizes.push_back(static_cast<double>(text_.text(r, column).size() / 2));
    code = code_of(sizes, tick_, bytes);
  } else if (holds_names(column)) {
    const Factor names = text_.texts(column, {.empty = true});
    code = code_of(Factor{at_rows(names.level, rows), names.levels}, bytes);
  } else {
    code = code_of(at_rows(text_.reals(column, {.empty = true, .infinite = true}), rows), tick_, bytes);
  }
  return {{"name", title.name}, {"unit", title.unit}, {"code", code}};
}

}  // namespace muster::viewer
