#include "run_log/wide_table.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>

#include "mcap/scan.hpp"
#include "run_log/tables/logged_table.hpp"
#include "text/error.hpp"
#include "text/names.hpp"
#include "text/text_table_writer.hpp"

namespace muster::run_log {
namespace {

namespace fs = std::filesystem;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

// A star stands for any text.
bool fits(std::string_view pattern, std::string_view text) {
  std::size_t p = 0, t = 0, star = pattern.npos, behind = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++, behind = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p, ++t;
    } else if (star != pattern.npos) {
      p = star + 1, t = ++behind;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

bool is_wanted(const std::string& column, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return true;
  for (const std::string& pattern : wanted) {
    if (fits(pattern, column) || fits(pattern + "/*", column)) return true;
  }
  return false;
}

// Hands on the numbers of muster's tables.
class Numbers : public mcap::Visitor {
 public:
  virtual void at(std::uint64_t time) = 0;
  virtual void number(const LoggedTable& table, const std::string& name, const Field& field, double value) = 0;

  void channel(const mcap::Channel& channel) override { tables_[channel.id] = table_of(channel); }
  void message(const mcap::Message& message, const std::string&) override {
    const auto& table = tables_[message.channel];
    if (!table) return;
    at(message.log_time);
    read_message(*table, message.data, [&](const std::string& name, const Field& field, double value) {
      number(*table, name, field, value);
    });
  }

 private:
  std::map<std::uint16_t, std::optional<LoggedTable>> tables_;
};

class Header : public Numbers {
 public:
  explicit Header(const std::vector<std::string>& wanted) : wanted_(wanted) {}
  void at(std::uint64_t) override {}
  void number(const LoggedTable&, const std::string& name, const Field& field, double) override {
    key_ = name + '/' + field.name;
    const auto [found, is_new] = places.emplace(key_, none);
    if (!is_new) return;
    seen.push_back(key_);
    if (!is_wanted(key_, wanted_)) return;
    found->second = titles.size();
    titles.push_back({key_, field.unit});
  }

  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::unordered_map<std::string, std::size_t> places;
  std::vector<TextColumn> titles{{"t", "s"}};
  std::vector<std::string> seen;

 private:
  const std::vector<std::string>& wanted_;
  std::string key_;
};

class Body : public Numbers {
 public:
  Body(const Header& header, TextTableWriter& to, const fs::path& log)
      : header_(header), to_(to), log_(log), row_(header.titles.size(), nothing), filled_(row_.size(), false) {}

  void at(std::uint64_t time) override {
    if (time < time_)
      throw invalid({log_.string()}, "time runs backwards, from " + std::to_string(time_) + " to " +
                                         std::to_string(time) + " ns; expected a log in the order of its times");
    if (time > time_) end_row();
    time_ = time;
  }
  void number(const LoggedTable&, const std::string& name, const Field& field, double value) override {
    key_ = name + '/' + field.name;
    const std::size_t place = header_.places.at(key_);
    if (place == Header::none) return;
    if (filled_[place]) ++result.replaced;
    filled_[place] = true;
    has_any_ = true;
    row_[place] = value;
  }
  void end_row() {
    if (!has_any_) return;
    has_any_ = false;
    row_[0] = static_cast<double>(time_) / 1e9;
    for (std::size_t c = 0; c < row_.size(); ++c) to_.real(row_[c]), row_[c] = nothing, filled_[c] = false;
    to_.end_row();
    ++result.rows;
  }

  WideTable result;

 private:
  const Header& header_;
  TextTableWriter& to_;
  const fs::path& log_;
  std::vector<double> row_;
  std::vector<bool> filled_;
  std::uint64_t time_ = 0;
  bool has_any_ = false;
  std::string key_;
};

class OneColumn : public Numbers {
 public:
  OneColumn(const std::string& table, const std::string& column) : table_(table), column_(column) {}
  void at(std::uint64_t time) override { time_ = static_cast<double>(time) / 1e9; }
  void number(const LoggedTable& table, const std::string& name, const Field& field, double value) override {
    if (table.table != table_ || field.name != column_) return;
    const auto [found, is_new] = places_.emplace(name, result.size());
    if (is_new) result.push_back({name, field.unit, {}, {}});
    result[found->second].times.push_back(time_);
    result[found->second].values.push_back(value);
  }
  std::vector<Series> result;

 private:
  const std::string &table_, &column_;
  std::unordered_map<std::string, std::size_t> places_;
  double time_ = 0;
};

// Of "pose" where there is robot/rover/pose/x: the table is meant, with all of its columns.
std::string meant_table(const std::string& word, const std::vector<std::string>& columns) {
  if (word.starts_with('/') && word.size() > 1)  // a topic
    return "names of columns have no slash in front; expected " + quote(word.substr(1) + "/*") +
           ", all columns of that table";
  for (const std::string& column : columns) {
    const std::string table = column.substr(0, column.rfind('/'));
    if (table.ends_with('/' + word))
      return "did you mean " + quote(table) + ", a whole table? " + expected_one_of(columns);
  }
  return suggest(word, columns);
}

}  // namespace

WideTable write_wide(const fs::path& log, const fs::path& csv, const std::vector<std::string>& wanted) {
  Header header(wanted);
  mcap::scan(log, header, mcap::Damage::refused);
  if (header.titles.size() == 1 && header.seen.empty())
    throw invalid({log.string()},
                  "holds no table of numbers of muster's; expected a log that `muster run --mcap` wrote "
                  "with a table recorded");
  for (const std::string& pattern : wanted) {
    bool is_there = false;
    for (const std::string& column : header.seen) is_there = is_there || is_wanted(column, {pattern});
    if (!is_there)
      throw invalid({log.string()}, "has no column " + quote(pattern) + "; " + meant_table(pattern, header.seen));
  }
  TextTableWriter to(csv, header.titles);
  Body body(header, to, log);
  mcap::scan(log, body, mcap::Damage::refused);
  body.end_row();
  to.close();
  body.result.columns = header.titles.size() - 1;
  return body.result;
}

std::vector<Series> series_of(const fs::path& log, const std::string& table, const std::string& column) {
  OneColumn reader(table, column);
  mcap::scan(log, reader, mcap::Damage::refused);
  return reader.result;
}

}  // namespace muster::run_log
