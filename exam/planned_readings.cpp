#include "exam/planned_readings.hpp"

#include <algorithm>
#include <stdexcept>

#include "exam/table.hpp"

namespace muster::exam {
namespace {

Vec3 place(const Line& line, const std::string& end) {
  return {line.number(end + "_x[m]"), line.number(end + "_y[m]"), line.number(end + "_z[m]")};
}

}  // namespace

std::vector<PlannedReadings> read_plan(const std::string& csv) {
  const Table table("plan", csv);
  std::vector<PlannedReadings> result;
  for (const Line& line : table.lines())
    result.push_back({line.number("t[s]"), line.text("tx"), line.text("rx"), place(line, "tx"), place(line, "rx"),
                      line.number("tx_yaw[rad]"), line.number("rx_yaw[rad]")});
  if (result.empty()) throw std::runtime_error("plan: no readings are asked for");
  std::stable_sort(result.begin(), result.end(),
                   [](const PlannedReadings& a, const PlannedReadings& b) { return a.t < b.t; });
  return result;
}

}  // namespace muster::exam
