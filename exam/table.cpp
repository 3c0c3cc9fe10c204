#include "exam/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace muster::exam {
namespace {

std::vector<std::string> cells_of(std::string line) {
  if (!line.empty() && line.back() == '\r') line.pop_back();
  std::vector<std::string> result;
  std::istringstream cells(line);
  for (std::string cell; std::getline(cells, cell, ',');) result.push_back(cell);
  if (!line.empty() && line.back() == ',') result.emplace_back();
  return result;
}

}  // namespace

void Line::refuse(const std::string& why) const {
  throw std::runtime_error(fmt::format("{}, line {}: {}", table_, number_, why));
}

const std::string& Line::text(const std::string& name) const {
  const auto at = std::find(names_.begin(), names_.end(), name);
  if (at == names_.end()) refuse("no column " + name);
  return cells_[static_cast<std::size_t>(at - names_.begin())];
}

double Line::number(const std::string& name) const {
  const std::string& cell = text(name);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value))
    refuse(fmt::format("{} is no number: \"{}\"", name, cell));
  return value;
}

Table::Table(std::string name, const std::string& csv) : name_(std::move(name)) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  names_ = cells_of(line);
  while (std::getline(lines, line)) {
    cells_.push_back(cells_of(line));
    if (const std::size_t cells = cells_.back().size(); cells != names_.size())
      throw std::runtime_error(
          fmt::format("{}, line {}: {} cells, expected {}", name_, cells_.size() + 1, cells, names_.size()));
  }
}

std::vector<Line> Table::lines() const {
  std::vector<Line> result;
  for (std::size_t k = 0; k < cells_.size(); ++k)
    result.emplace_back(name_, names_, cells_[k], static_cast<int>(k) + 2);
  return result;
}

}  // namespace muster::exam
