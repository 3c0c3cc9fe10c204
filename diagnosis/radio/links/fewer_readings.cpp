#include "diagnosis/radio/links/fewer_readings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace muster::diagnosis {
namespace {

using Eigen::Index;

// Rows in which a radio first sends, first hears, and is farthest from where it is first.
std::set<std::size_t> telling_rows(const std::vector<std::array<End, 2>>& ends) {
  struct Known {
    End first;
    std::size_t farthest;
    double distance = 0;  // m, in plan
  };
  std::map<int, Known> radios;
  std::set<std::pair<int, std::size_t>> roles;  // radio, and which end of a reading it was
  std::set<std::size_t> result;
  for (std::size_t row = 0; row < ends.size(); ++row) {
    for (std::size_t role = 0; role < 2; ++role) {
      const End& end = ends[row][role];
      if (roles.insert({end.radio, role}).second) result.insert(row);
      Known& known = radios.try_emplace(end.radio, Known{end, row}).first->second;
      const double distance = std::hypot(end.x - known.first.x, end.y - known.first.y);
      if (distance > known.distance) known.distance = distance, known.farthest = row;
    }
  }
  for (const auto& [radio, known] : radios) result.insert(known.farthest);
  return result;
}

}  // namespace

std::optional<FewerReadings> with_fewer_readings(const LinkModel& all, const std::filesystem::path& table,
                                                 const std::vector<Index>& rows) try {
  std::set<std::size_t> kept = telling_rows(all.ends());
  kept.insert(rows.begin(), rows.end());
  if (2 * kept.size() > all.rows()) return {};
  const std::shared_ptr<const TextTable> whole = all.tables()->read(table);
  if (whole->rows() != all.rows()) return {};  // written anew since
  const auto tables = std::make_shared<TableCache>();
  const std::vector<std::size_t> in_order(kept.begin(), kept.end());
  tables->put(table, std::make_shared<const TextTable>(whole->with_rows(in_order)));
  FewerReadings result{std::make_unique<LinkModel>(all.simulation().world().file, table, Library::SearchPath{}, tables,
                                                   all.simulation().world().seed, all.libraries()),
                       {}};
  if (result.model->radio_names() != all.radio_names()) return {};
  for (const Index row : rows)
    result.rows.push_back(std::lower_bound(in_order.begin(), in_order.end(), static_cast<std::size_t>(row)) -
                          in_order.begin());
  return result;
} catch (const Error&) {
  return {};
}

}  // namespace muster::diagnosis
