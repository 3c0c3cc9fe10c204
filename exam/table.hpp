// Input tables of the exam: cells by column name, no quotes.
#pragma once

#include <string>
#include <vector>

namespace muster::exam {

// One line below the header.
class Line {
 public:
  Line(const std::string& table, const std::vector<std::string>& names, std::vector<std::string> cells, int number)
      : table_(table), names_(names), cells_(std::move(cells)), number_(number) {}

  // Throw std::runtime_error with table and line for a missing column, or a cell that is no number.
  const std::string& text(const std::string& name) const;
  double number(const std::string& name) const;
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  const std::string& table_;
  const std::vector<std::string>& names_;
  std::vector<std::string> cells_;
  int number_;
};

class Table {
 public:
  // `name` is for messages. Throws std::runtime_error for a line of another length than the header.
  Table(std::string name, const std::string& csv);

  std::vector<Line> lines() const;

 private:
  std::string name_;
  std::vector<std::string> names_;
  std::vector<std::vector<std::string>> cells_;
};

}  // namespace muster::exam
