#include "diagnosis/pipeline/used_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/inference/thresholds.hpp"
#include "diagnosis/radio/laws/likely_blocked.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;

// A link that an instance of the world blocks now and then.
struct BlockedLink {
  std::string instance, one, other;
  Crossings crossings;

  std::set<std::string> ends() const { return {one, other}; }
};

std::string attribute_of(const InstanceDeclaration& instance, const std::string& name) {
  for (const XmlAttribute& a : instance.attributes) {
    if (a.name == name) return a.value;
  }
  return "";
}

std::vector<BlockedLink> blocked_links(const LinkModel& model) {
  std::vector<BlockedLink> result;
  for (const auto& instance : model.simulation().instances()) {
    const muster_burst* const burst = instance->plugin().burst;
    if (!burst) continue;
    const InstanceDeclaration& declared = instance->declared();
    const auto value = [&](const char* name) { return model.parameter(declared.name + '/' + name).value; };
    const BlockedLink link{declared.name,
                           attribute_of(declared, burst->one),
                           attribute_of(declared, burst->other),
                           {value(burst->loss), value(burst->share), value(burst->duration)}};
    if (!link.one.empty() && !link.other.empty()) result.push_back(link);
  }
  return result;
}

// Splits rows of the table into those of the link and all others.
struct Split {
  std::vector<Index> of_link, others;
  bool others_hold_both;  // each of the link's radios has at least half as many readings elsewhere
};

Split split(const LinkModel& model, const std::vector<Index>& rows, const BlockedLink& link) {
  Split result{};
  std::size_t of_one = 0, of_other = 0;
  for (const Index row : rows) {
    const auto& [tx, rx] = model.ends()[static_cast<std::size_t>(row)];
    const std::set<std::string> ends = model.link_of(tx.radio, rx.radio);
    const bool of_link = ends == link.ends();
    (of_link ? result.of_link : result.others).push_back(row);
    of_one += !of_link && ends.count(link.one);
    of_other += !of_link && ends.count(link.other);
  }
  result.others_hold_both = std::min(of_one, of_other) >= result.of_link.size() / 2;
  return result;
}

// Those of the link's rows that were not blocked, as far as their levels tell.
std::vector<Index> not_blocked(std::vector<Index> rows, const Dataset& data, const Eigen::VectorXd& expected,
                               const Crossings& crossings) {
  if (data.t.empty()) return rows;
  const auto time = [&](Index row) { return data.t[static_cast<std::size_t>(row)]; };
  const auto left = [&](Index row) { return data.rssi[static_cast<std::size_t>(row)] - expected[row]; };
  std::stable_sort(rows.begin(), rows.end(), [&](Index a, Index b) { return time(a) < time(b); });
  std::vector<Index> kept, asked;
  for (const Index row : rows) (std::isfinite(left(row)) ? asked : kept).push_back(row);
  std::vector<double> times(asked.size());
  Eigen::VectorXd residual(static_cast<Index>(asked.size()));
  for (std::size_t i = 0; i < asked.size(); ++i) {
    times[i] = time(asked[i]);
    residual[static_cast<Index>(i)] = left(asked[i]);
  }
  const std::vector<double> blocked = probability_blocked(times, residual, crossings);
  for (std::size_t i = 0; i < asked.size(); ++i)
    if (blocked[i] < thresholds::probably_blocked) kept.push_back(asked[i]);
  return kept;
}

}  // namespace

UsedRows used_rows(const LinkModel& model, const Dataset& data, const Eigen::VectorXd& expected,
                   const std::vector<std::size_t>& of_fit) {
  UsedRows used;
  for (const std::size_t row : of_fit) {
    if (!data.is_wild(row)) used.rows.push_back(static_cast<Index>(row));
  }
  for (const BlockedLink& link : blocked_links(model)) {
    Split rows = split(model, used.rows, link);
    const std::size_t all = rows.of_link.size();
    if (all == 0) continue;
    if (!rows.others_hold_both) {
      const std::vector<Index> kept = not_blocked(std::move(rows.of_link), data, expected, link.crossings);
      rows.others.insert(rows.others.end(), kept.begin(), kept.end());
      std::sort(rows.others.begin(), rows.others.end());
    }
    const std::size_t left_out = used.rows.size() - rows.others.size();
    used.notes.push_back(fmt::format(
        "{} blocks the link {} {} of the world: {} are left out of the search", link.instance, link.one, link.other,
        left_out == all ? fmt::format("its {} readings", all)
                        : fmt::format("{} of its {} readings, the probably blocked ones,", left_out, all)));
    used.rows = std::move(rows.others);
  }
  if (static_cast<Index>(used.rows.size()) < inference::thresholds::fewest_readings)
    throw invalid({data.table->file()}, fmt::format("the table has {} readings to search; expected at least {}",
                                                    used.rows.size(), inference::thresholds::fewest_readings));
  return used;
}

}  // namespace muster::diagnosis
