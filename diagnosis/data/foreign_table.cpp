#include "diagnosis/data/foreign_table.hpp"

#include <algorithm>

#include "text/names.hpp"
#include "text/number.hpp"
#include "text/text_file.hpp"

namespace muster::diagnosis {
namespace {

constexpr std::uint64_t most_bytes = 2'000'000'000;

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == text.npos ? "" : std::string(text.substr(first, last - first + 1));
}

const std::string words_for_nothing[] = {"", "nan", "NaN", "NAN", "NA", "null", "None"};

}  // namespace

ForeignTable ForeignTable::read(const std::filesystem::path& path) {
  const TextFile source = read_text_file(path, most_bytes);
  ForeignTable table;
  table.file_ = source.file;
  const std::string_view text = source.text;
  int number = 1;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end + 1;
    if (trimmed(line).empty()) continue;
    if (table.columns_.empty()) {
      table.read_header(line);
      continue;
    }
    auto cells = table.split(line, number);
    if (cells.size() != table.columns_.size())
      throw invalid({table.file_, number, 0}, "the row has " + std::to_string(cells.size()) + " cells; expected " +
                                                  std::to_string(table.columns_.size()));
    if (std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return cell.empty(); })) {
      table.guesses_.push_back("line " + std::to_string(number) + " has no cell filled, and is left out");
      continue;
    }
    std::move(cells.begin(), cells.end(), std::back_inserter(table.cells_));
    table.lines_.push_back(number);
  }
  if (table.columns_.empty()) throw invalid({table.file_}, "is empty; expected a header");
  if (table.cells_.empty()) throw invalid({table.file_}, "has no rows below its header");
  return table;
}

void ForeignTable::read_header(std::string_view line) {
  const auto count = [&](char c) { return std::count(line.begin(), line.end(), c); };
  if (count('\t') > count(',') && count('\t') >= count(';'))
    separator_ = '\t';
  else if (count(';') > count(','))
    separator_ = ';';
  if (separator_ != ',')
    guesses_.push_back(std::string("cells are separated by ") + (separator_ == ';' ? "';'" : "tabs"));
  columns_ = split(line, 1);
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (!columns_[c].empty()) continue;
    columns_[c] = "column" + std::to_string(c + 1);
    guesses_.push_back("the column without a name is called " + columns_[c]);
  }
}

std::vector<std::string> ForeignTable::split(std::string_view line, int number) const {
  std::vector<std::string> cells;
  std::size_t at = 0;
  while (true) {
    std::size_t end = line.find(separator_, at);
    const std::size_t quote_at = line.find_first_not_of(' ', at);
    if (quote_at != line.npos && line[quote_at] == '"') {
      const std::size_t close = line.find('"', quote_at + 1);
      if (close == line.npos)
        throw invalid({file_, number, static_cast<int>(quote_at) + 1}, "a quoted cell is not closed");
      end = line.find(separator_, close);
      cells.emplace_back(line.substr(quote_at + 1, close - quote_at - 1));
    } else {
      cells.push_back(trimmed(line.substr(at, end == line.npos ? line.npos : end - at)));
    }
    if (end == line.npos) return cells;
    at = end + 1;
  }
}

std::size_t ForeignTable::require(const std::string& column, const Place& for_whom) const {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end())
    throw invalid(for_whom, file_ + " has no column " + quote(column) + "; " + suggest(column, columns_));
  return static_cast<std::size_t>(found - columns_.begin());
}

std::optional<double> ForeignTable::number(std::size_t row, std::size_t column, const std::string& advice) const {
  const std::string& cell = text(row, column);
  if (const auto value = parse_real(cell)) return value;
  if (std::find(std::begin(words_for_nothing), std::end(words_for_nothing), cell) != std::end(words_for_nothing))
    return std::nullopt;
  throw invalid(place(row), "column " + quote(columns_[column]) + ": " + why_not_real(cell) + advice);
}

}  // namespace muster::diagnosis
