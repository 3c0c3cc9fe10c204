// What is prepared once for each endpoint, looked up by its links, and evaluated once a pair.
#pragma once

#include <cmath>
#include <muster/plugin.hpp>
#include <muster/reverse_links.hpp>
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

// A reciprocal value of each link: links that run both ways between the same ends share one evaluation.
template <class Row, class Evaluate>
void once_a_pair(Rows<const Ends> links, std::size_t endpoints, Rows<Row> out, const Evaluate& evaluate) {
  const auto back = earlier_reverse(links, endpoints);
  for (std::size_t i = 0; i < links.size(); ++i) out[i] = back[i] != no_link ? out[back[i]] : evaluate(links[i]);
}

// In metres.
inline double distance(const Pose& p, const Pose& q) {
  const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace muster
