#include "foreign_messages.hpp"

#include <cmath>
#include <limits>

#include "run_log/tables/cdr.hpp"

namespace muster::devices {
namespace {

using run_log::CdrReader;
using run_log::Field;
using run_log::FieldValue;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr int covariances = 36;

void skip_header(CdrReader& from) {
  from.number<std::int32_t>();   // stamp: seconds
  from.number<std::uint32_t>();  // nanoseconds
  from.text();                   // frame
}

std::vector<FieldValue> odometry_of(std::string_view data, double, double, std::string&) {
  CdrReader from(data);
  skip_header(from);
  from.text();  // the body's frame
  const double x = from.real(), y = from.real();
  from.real();  // z
  const double qx = from.real(), qy = from.real(), qz = from.real(), qw = from.real();
  for (int i = 0; i < covariances; ++i) from.real();
  const double v = from.real();
  for (int i = 0; i < 4; ++i) from.real();  // to the side, up; about x, y
  const double w = from.real();
  const double yaw = std::atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz));
  return {{x, {}}, {y, {}}, {yaw, {}}, {v, {}}, {w, {}}};
}

// As REP 117 has it. Lasers of which a driver gives 0 where nothing came back, or NaN, have no echo there.
double range_of(float range, float least, float most) {
  if (range == 0 || std::isnan(range)) return infinity;
  if (range < least) return -infinity;
  return range > most ? infinity : static_cast<double>(range);
}

std::vector<FieldValue> scan_of(std::string_view data, double time, double count, std::string& storage) {
  CdrReader from(data);
  skip_header(from);
  const auto first = from.number<float>();
  from.number<float>();  // the last angle
  const auto step = from.number<float>();
  from.number<float>();  // time between two rays
  from.number<float>();  // and between two scans
  const auto least = from.number<float>(), most = from.number<float>();
  const std::uint32_t rays = from.count("a number of ranges");
  if (rays > from.left() / sizeof(float)) throw mcap::Malformed(0, "a scan that ends before its ranges");
  std::vector<double> ranges;
  for (std::uint32_t i = 0; i < rays; ++i) ranges.push_back(range_of(from.number<float>(), least, most));
  storage.assign(reinterpret_cast<const char*>(ranges.data()), ranges.size() * sizeof(double));
  std::vector<FieldValue> result;
  // robot, sensor, id, t; no odometry pose; the laser's pose is not in the message: the robot's own.
  for (const double value : {0.0, 0.0, count, time, nothing, nothing, nothing, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0})
    result.push_back({value, {}});
  for (const float value : {first, step, least, most}) result.push_back({static_cast<double>(value), {}});
  result.push_back({0, storage});
  return result;
}

std::vector<Field> fields_of(std::initializer_list<const char*> titles) {
  std::vector<Field> result;
  for (const std::string title : titles) {
    const auto bracket = title.find('[');
    result.push_back({title.substr(0, bracket), "", Field::Kind::real});
    if (bracket != title.npos) result.back().unit = title.substr(bracket + 1, title.size() - bracket - 2);
  }
  return result;
}

}  // namespace

const ForeignMessage* foreign_message(const std::string& type) {
  static const std::vector<ForeignMessage> known{
      {"nav_msgs/msg/Odometry", fields_of({"x[m]", "y[m]", "yaw[rad]", "v[m/s]", "w[rad/s]"}), odometry_of},
      {"sensor_msgs/msg/LaserScan",
       fields_of({"robot", "sensor", "id", "t[s]", "x[m]", "y[m]", "yaw[rad]", "at_x[m]", "at_y[m]", "at_z[m]", "qw",
                  "qx", "qy", "qz", "min_angle[rad]", "step[rad]", "min_range[m]", "max_range[m]", "ranges"}),
       scan_of}};
  for (const ForeignMessage& one : known) {
    if (type == one.type) return &one;
  }
  return nullptr;
}

}  // namespace muster::devices
