#include "diagnosis/inference/noise/vecchia.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "diagnosis/inference/noise/neighbourhood.hpp"
#include "diagnosis/inference/noise/over_time.hpp"
#include "diagnosis/inference/noise/row_distance.hpp"
#include "diagnosis/inference/thresholds.hpp"

namespace muster::noise {
namespace {

using ByRow = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr std::size_t at_once = 1 << 16;  // pairs in one question to the model

// Fast path for one column: refinement calls it thousands of times.
Eigen::VectorXd applied_to_one(const Field& field, const Stencil& stencil, const double* x) {
  Eigen::VectorXd out(field.size());
  const auto slots = static_cast<Index>(field.slots());
  for (Index i = 0; i < field.size(); ++i) {
    const double* const weights = stencil.beside.data() + i * slots;
    double sum = stencil.own[at(i)] * x[i];
    for (Index a = 0; a < slots; ++a) {
      const Index j = field.neighbour(i, static_cast<int>(a));
      sum += weights[a] * x[std::max<Index>(j, 0)];  // the weight of none is 0
    }
    out[i] = sum;
  }
  return out;
}

Eigen::MatrixXd applied(const Field& field, const Stencil& stencil, const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  if (columns.cols() == 1) return applied_to_one(field, stencil, columns.data());
  const ByRow x = columns;
  ByRow out(x.rows(), x.cols());
  row_kernels().best().combine(field.combinations(stencil), x.data(), x.cols(), out.data());
  return out;
}

Stencil empty_stencil(const Field& field) {
  return {std::vector<double>(at(field.size())), std::vector<double>(at(field.size() * field.slots()))};
}

// Stores the results for a group of rows, lane by lane; `combination` has a value a slot, then the row's own.
void store(const Field& field, Index group, const Lanes* combination, Stencil& stencil) {
  for (Index lane = 0; lane < lanes; ++lane) {
    const Index i = group * lanes + lane;
    if (i >= field.size()) return;
    for (int a = 0; a < field.slots(); ++a) stencil.beside[at(i * field.slots() + a)] = combination[a].of[lane];
    stencil.own[at(i)] = combination[field.slots()].of[lane];
  }
}

// Drops slots that would stay empty: with one anchor there are no others.
Conditioning fillable(Conditioning conditioning, const std::vector<int>& group) {
  const bool one = std::all_of(group.begin(), group.end(), [&](int other) { return other == group.front(); });
  if (one) conditioning.others = 0;
  return conditioning;
}

}  // namespace

Field::Field(Sites sites, const Conditioning& conditioning)
    : sites_(std::move(sites)), moments_(moments_of(sites_)), recurring_(sites_) {
  const Conditioning with = fillable(conditioning, correlated().group);
  slots_ = with.slots();
  neighbours_ = neighbours_of(correlated(), with);
  float longest = 0;
  each_pair(false, [&](std::size_t, Index, Index, float, float both) { longest = std::max(longest, both); });
  spacing_ = std::max(spacing_, longest / (distances - 1.0));
  smooth_ = table(false);
  if (correlated().within() > 0) rough_ = table(true);
  if (correlated().stated) different_.assign(at(pairs()), Joint::other);
}

template <class Use>
void Field::each_pair(bool by_readings, const Use& use) const {
  const SiteFloats floats = floats_of(correlated());
  PlacedSites near(slots_ + 1);  // a row, then its neighbours
  const Places places = near.places(by_readings, anchors_move(correlated()), std::numeric_limits<float>::max());
  std::vector<float> place(at(near.filled())), both(place.size());
  for (Index i = 0; i < size(); ++i) {
    near.set(0, floats.row(i));
    for (int a = 0; a < slots_; ++a) {
      const Index j = neighbour(i, a);
      if (j < 0) continue;
      near.set(a + 1, floats.row(j));
      row_kernels().best().apart(places, a + 1, place.data(), both.data());
      for (int b = 0; b <= a; ++b) {
        const Index other = b < a ? neighbour(i, b) : i;
        if (other < 0) continue;
        const std::size_t pair = at((i / lanes) * pairs() + Index{a} * (a + 1) / 2 + b), from = b < a ? at(b + 1) : 0;
        use(pair * lanes + at(i % lanes), j, other, place[from], both[from]);
      }
    }
  }
}

Field::Table Field::table(bool by_readings) const {
  Table result;
  result.near.assign(at(groups() * pairs() * lanes), distances);
  result.joint.assign(result.near.size(), distances);
  each_pair(by_readings, [&](std::size_t slot, Index a, Index b, float place, float both) {
    result.near[slot] = static_cast<uint16_t>(entry(place) + within_site(a, b));
    if (correlated().group[at(a)] == correlated().group[at(b)])
      result.joint[slot] = static_cast<uint16_t>(entry(both) + within_site(a, b));
  });
  compare_ends(result);
  return result;
}

void Field::compare_ends(Table& table) const {
  table.kinds.assign(table.near.size() / lanes, Joint::other);
  for (std::size_t pair = 0; pair < table.kinds.size(); ++pair) {
    const auto near = table.near.begin() + static_cast<std::ptrdiff_t>(pair * lanes);
    const auto joint = table.joint.begin() + static_cast<std::ptrdiff_t>(pair * lanes);
    if (std::equal(near, near + lanes, joint)) {
      table.kinds[pair] = Joint::same;
    } else if (std::all_of(joint, joint + lanes, [](uint16_t entry) { return entry == distances; })) {
      table.kinds[pair] = Joint::uncorrelated;
    }
  }
}

std::vector<Family> Field::families() const {
  std::vector<Family> result;
  if (correlated().stated) result.push_back(Family::stated);
  result.insert(result.end(), noise::families.begin(), noise::families.end());
  return result;
}

std::vector<Family> Field::fixed_families() const {
  std::vector<Family> result;
  if (recurring_.share() < inference::thresholds::recurring_share) return result;
  for (const std::size_t part : {std::size_t{0}, std::size_t{1}}) {  // of the site, or of each stream
    if (part == 1 && (!recurring_.several_streams() || sites_.over_time())) continue;
    for (std::size_t k = 0; k < fixed_shares.size(); ++k) {
      if (correlated().stated) result.push_back(with_fixed(Family::stated, k, part));
      result.push_back(with_fixed(Family::exponential, k, part));
    }
  }
  return result;
}

const StatedTables& Field::stated(int k) const {
  const auto found = stated_tables_.find(k);
  if (found != stated_tables_.end()) return found->second;
  if (!neighbour_pairs_) neighbour_pairs_ = std::make_shared<const NeighbourPairs>(neighbour_pairs());
  return stated_tables_.emplace(k, neighbour_pairs_->tables(sites_, std::exp(k * StatedTables::step))).first->second;
}

NeighbourPairs Field::neighbour_pairs() const {
  NeighbourPairs result(at(groups() * pairs() * lanes));
  for (Index i = 0; i < size(); ++i) {
    for (int slot = 0; slot < slots_; ++slot) {
      const Index j = neighbour(i, slot);
      if (j < 0) continue;
      for (int other = 0; other <= slot; ++other) {
        const Index with = other < slot ? neighbour(i, other) : i;
        if (with < 0) continue;
        const Index pair = (i / lanes) * pairs() + Index{slot} * (slot + 1) / 2 + other;
        result.add(at(pair * lanes + i % lanes), j, with, within_site(j, with));
      }
    }
  }
  return result;
}

const std::vector<uint16_t>& Field::stated_triangle(int k) const {
  std::vector<uint16_t>& entries = stated_triangles_[k];
  if (!entries.empty()) return entries;
  entries.reserve(at(size() * (size() - 1) / 2));
  std::vector<uint32_t> before, row;
  const auto flush = [&] {
    std::vector<double> values(row.size());
    sites_.stated->covariances(sites_, std::exp(k * StatedTables::step), before, row, values.data());
    std::transform(values.begin(), values.end(), std::back_inserter(entries), StatedTables::entry_of);
    before.clear(), row.clear();
  };
  for (Index i = 1; i < size(); ++i) {
    for (Index j = 0; j < i; ++j) before.push_back(static_cast<uint32_t>(j));
    row.insert(row.end(), at(i), static_cast<uint32_t>(i));
    if (row.size() >= at_once) flush();
  }
  flush();
  return entries;
}

Field::Entries Field::entries(Index group, const Covariance& covariance, bool slopes) const {
  const Index first = group * pairs();
  if (is_stated(covariance.family)) {
    const auto [k, weight] = StatedTables::position_of(covariance.theta[1]);
    const int next = slopes || weight > 0 ? k + 1 : k;
    return {stated(k).pairs.data() + first * lanes, stated(next).pairs.data() + first * lanes, different_.data()};
  }
  const Table& from = is_rough(covariance.family) && !rough_.near.empty() ? rough_ : smooth_;
  return {from.near.data() + first * lanes, from.joint.data() + first * lanes, from.kinds.data() + first};
}

Combinations Field::combinations(const Stencil& stencil) const {
  return {size(), slots_, neighbours_.data(), stencil.own.data(), stencil.beside.data()};
}

uint16_t Field::entry(double distance) const {
  return static_cast<uint16_t>(std::min(distance / spacing_ + 0.5, distances - 1.0));
}

Whitener::Whitener(const Field& field, const Covariance& covariance, Stencil stencil)
    : field_(&field), covariance_(covariance), stencil_(std::move(stencil)) {}

Whitener::Whitener(const Field& field, const Covariance& covariance)
    : Whitener(field, covariance, empty_stencil(field)) {
  Neighbourhood neighbourhood(field, covariance, false);
  for (Index g = 0; g < field.groups(); ++g) {
    neighbourhood.factorise(g);
    store(field, g, neighbourhood.combination(), stencil_);
  }
  sum_up();
}

void Whitener::sum_up() {
  for (const double own : stencil_.own) log_scale_ += std::log(own);
}

Eigen::MatrixXd Whitener::operator()(const Eigen::Ref<const Eigen::MatrixXd>& columns) const {
  return applied(*field_, stencil_, columns);
}

Sheet Whitener::sheet(const Sheet& columns) const {
  Sheet out(columns.rows(), columns.cols());
  row_kernels().best().combine_floats(field_->combinations(stencil_), columns.data(), columns.cols(), out.data());
  return out;
}

WhitenerSlopes::WhitenerSlopes(const Field& field, const Covariance& covariance)
    : field_(&field), whitener_(field, covariance, empty_stencil(field)) {
  for (Stencil& stencil : stencils_) stencil = empty_stencil(field);
  Neighbourhood neighbourhood(field, covariance);
  for (Index g = 0; g < field.groups(); ++g) {
    neighbourhood.factorise(g);
    store(field, g, neighbourhood.combination(), whitener_.stencil_);
    neighbourhood.differentiate();
    const int used = static_cast<int>(std::min<Index>(lanes, field.size() - g * lanes));
    const auto depends = [&](int lane) { return !field.sites().is_alone(g * lanes + lane); };  // on theta
    for (int p = 0; p < parameters; ++p) {
      store(field, g, neighbourhood.slope(p), stencils_[static_cast<std::size_t>(p)]);
      for (int lane = 0; lane < used; ++lane) {
        if (depends(lane)) of_log_scale_[p] += neighbourhood.log_slope(p, lane);
      }
      for (int q = 0; q <= p; ++q) {
        for (int lane = 0; lane < used; ++lane) {
          if (depends(lane)) information_(p, q) += neighbourhood.information(p, q).of[lane];
        }
        information_(q, p) = information_(p, q);
      }
    }
  }
  for (Index i = 0; i < field.size(); ++i) {
    if (!field.sites().is_alone(i)) continue;
    for (Stencil& stencil : stencils_) stencil.own[at(i)] = 0;  // it has no neighbours
  }
  whitener_.sum_up();
}

Theta WhitenerSlopes::contracted(const Eigen::MatrixXd& x, const Eigen::MatrixXd& with) const {
  const auto filled = [](const Eigen::MatrixXd& columns) {
    ByRow result = ByRow::Zero(columns.rows(), (columns.cols() + lanes - 1) / lanes * lanes);
    result.leftCols(columns.cols()) = columns;
    return result;
  };
  const ByRow one = filled(x), other = filled(with);
  std::array<Combinations, parameters> four;
  for (std::size_t p = 0; p < parameters; ++p) four[p] = field_->combinations(stencils_[p]);
  Theta sums;
  row_kernels().best().contract(four.data(), one.data(), other.data(), one.cols(), sums.data());
  return sums;
}

}  // namespace muster::noise
