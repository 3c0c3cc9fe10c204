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

// The same from what a field has between the ends of a link: value(link, of the field). The field is asked for a batch
// at a time.
template <class Row, class Field, class Value>
void once_a_pair(Rows<const Ends> links, const Field& field, const std::vector<typename Field::End>& at, Rows<Row> out,
                 const Value& value) {
  const auto back = earlier_reverse(links, at.size());
  decltype(field.between(at[0], at[0])) between[Field::batch];
  const typename Field::End *from[Field::batch], *to[Field::batch];
  std::size_t link[Field::batch], waiting = 0;
  const auto evaluate = [&] {
    for (std::size_t k = waiting; k < Field::batch; ++k) from[k] = from[0], to[k] = to[0];
    field.between(from, to, between);
    for (std::size_t k = 0; k < waiting; ++k) out[link[k]] = value(links[link[k]], between[k]);
    waiting = 0;
  };
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (back[i] != no_link) continue;
    link[waiting] = i, from[waiting] = &of(at, links[i].tx), to[waiting] = &of(at, links[i].rx);
    if (++waiting == Field::batch) evaluate();
  }
  if (waiting > 0) evaluate();
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (back[i] != no_link) out[i] = out[back[i]];
  }
}

// In metres.
inline double distance(const Pose& p, const Pose& q) {
  const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace muster
