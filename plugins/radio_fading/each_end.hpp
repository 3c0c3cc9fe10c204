// What is prepared once for each endpoint and looked up by its links.
#pragma once

#include <cmath>
#include <muster/plugin.hpp>
#include <vector>

namespace muster {

// Of an endpoint, by its number.
template <class All>
const auto& of(const All& all, double end) {
  return all[static_cast<std::size_t>(end)];
}

// A field at each place, in the field's own unit of length.
template <class Field>
std::vector<typename Field::End> at_each(const Field& field, Rows<const Pose> places, double unit) {
  std::vector<typename Field::End> result;
  result.reserve(places.size());
  for (const Pose& p : places) result.push_back(field.end_at(p.x / unit, p.y / unit, p.z / unit));
  return result;
}

// In metres.
inline double distance(const Pose& p, const Pose& q) {
  const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace muster
