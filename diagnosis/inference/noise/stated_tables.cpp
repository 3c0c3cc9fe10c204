#include "diagnosis/inference/noise/stated_tables.hpp"

#include <numeric>

namespace muster::noise {

void NeighbourPairs::add(std::size_t slot, Index row, Index other, int more) {
  const auto [lower, upper] = std::minmax({static_cast<uint32_t>(row), static_cast<uint32_t>(other)});
  const auto [known, is_new] =
      numbers_.try_emplace(uint64_t{upper} << 32 | lower, static_cast<uint32_t>(lower_.size()));
  of_slot_[slot] = known->second;
  if (!is_new) return;
  lower_.push_back(lower), upper_.push_back(upper), more_.push_back(static_cast<uint16_t>(more));
}

StatedTables NeighbourPairs::tables(const Sites& sites, double decorrelation) const {
  StatedTables result;
  std::vector<uint32_t> all(static_cast<std::size_t>(sites.size()));
  std::iota(all.begin(), all.end(), 0u);
  Eigen::VectorXd own(sites.size()), correlations(static_cast<Index>(lower_.size()));
  sites.stated->covariances(sites, decorrelation, all, all, own.data());
  sites.stated->covariances(sites, decorrelation, lower_, upper_, correlations.data());
  result.own = own.cast<float>();
  result.pairs.assign(of_slot_.size(), distances);
  for (std::size_t slot = 0; slot < of_slot_.size(); ++slot) {
    const uint32_t pair = of_slot_[slot];
    if (pair == none) continue;
    result.pairs[slot] = static_cast<uint16_t>(StatedTables::entry_of(correlations[pair]) + more_[pair]);
  }
  return result;
}

}  // namespace muster::noise
