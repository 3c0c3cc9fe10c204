// The columns of a table, parsed from "x[m] y[m] range[m]*682 rssi[dBm]? payload{} tx:endpoint".
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace muster {

struct Column {
  std::string name;
  std::string unit;       // "" where it has none
  std::string reference;  // the set whose row numbers it holds, or ""
  bool nullable = false;  // ?  a cell may be empty
  bool infinite = false;  // ~  a cell may be infinite
  bool bytes = false;     // {} a cell holds bytes
  bool joins = false;     // +  names in a file that are not rows of `reference` join it

  // "x[m]", as in the header of a CSV table.
  std::string title() const { return unit.empty() ? name : name + '[' + unit + ']'; }
  bool operator==(const Column&) const = default;
};

class Columns {
 public:
  Columns() = default;
  // Throws std::invalid_argument with the faulty word.
  explicit Columns(std::string_view text);

  std::size_t size() const { return list_.size(); }
  const Column& operator[](std::size_t i) const { return list_[i]; }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }
  // The column's number, or -1.
  int find(std::string_view name) const;
  bool any_bytes() const { return any_bytes_; }
  bool any_references() const { return any_references_; }
  // True where every cell holds a plain finite number.
  bool plain() const { return plain_; }
  const std::string& text() const { return text_; }
  bool operator==(const Columns& other) const { return list_ == other.list_; }

 private:
  std::vector<Column> list_;
  std::string text_;
  bool any_bytes_ = false, any_references_ = false;
  bool plain_ = true;
};

}  // namespace muster
