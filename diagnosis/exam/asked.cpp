#include "asked.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

namespace muster::exam {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream cells(line);
  for (std::string cell; std::getline(cells, cell, ',');) result.push_back(cell);
  return result;
}

// The cells of one line by the names of their columns.
class Line {
 public:
  Line(const std::vector<std::string>& names, const std::string& text, int number) : number_(number) {
    const std::vector<std::string> cells = cells_of(text);
    if (cells.size() != names.size())
      throw std::runtime_error(fmt::format("plan, line {}: {} cells, expected {}", number, cells.size(), names.size()));
    for (std::size_t k = 0; k < cells.size(); ++k) cells_[names[k]] = cells[k];
  }

  const std::string& text(const std::string& name) const {
    const auto at = cells_.find(name);
    if (at == cells_.end()) throw std::runtime_error(fmt::format("plan, line {}: no column {}", number_, name));
    return at->second;
  }
  double number(const std::string& name) const {
    const std::string& cell = text(name);
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value))
      throw std::runtime_error(fmt::format("plan, line {}: {} is no number: \"{}\"", number_, name, cell));
    return value;
  }
  Vec3 place(const std::string& end) const {
    return {number(end + "_x[m]"), number(end + "_y[m]"), number(end + "_z[m]")};
  }

 private:
  std::map<std::string, std::string> cells_;
  int number_;
};

}  // namespace

std::vector<Asked> read_plan(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<Asked> result;
  for (int number = 2; std::getline(lines, line); ++number) {
    const Line cells(names, line, number);
    result.push_back({cells.number("t[s]"), cells.text("tx"), cells.text("rx"), cells.place("tx"), cells.place("rx"),
                      cells.number("tx_yaw[rad]"), cells.number("rx_yaw[rad]")});
  }
  if (result.empty()) throw std::runtime_error("plan: no readings are asked for");
  std::stable_sort(result.begin(), result.end(), [](const Asked& a, const Asked& b) { return a.t < b.t; });
  return result;
}

}  // namespace muster::exam
