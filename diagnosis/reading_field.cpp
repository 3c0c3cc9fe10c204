#include "diagnosis/reading_field.hpp"

#include <cmath>

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr noise::Conditioning conditioning{12, 0, 1};
constexpr double far_off = 4;  // standard deviations; what is further off tells its neighbours no more than that

std::vector<Index> finite(const VectorXd& residual) {
  std::vector<Index> result;
  for (Index i = 0; i < residual.size(); ++i) {
    if (std::isfinite(residual[i])) result.push_back(i);
  }
  return result;
}

noise::Readings some(const noise::Readings& all, const std::vector<Index>& which) {
  noise::Readings result;
  result.tx_at = all.tx_at(Eigen::all, which);
  result.rx_at = all.rx_at(Eigen::all, which);
  for (const Index i : which) {
    if (!all.t.empty()) result.t.push_back(all.t[static_cast<std::size_t>(i)]);
    result.tx.push_back(all.tx[static_cast<std::size_t>(i)]);
    result.rx.push_back(all.rx[static_cast<std::size_t>(i)]);
  }
  return result;
}

// Every reading a row of its own, in the given order.
noise::Sites sites_of(const noise::Readings& readings) {
  noise::RowLimits single;
  single.way = -1;
  const noise::Rows rows(readings, single);
  return rows.sites(readings).of(rows.row_of());
}

}  // namespace

ReadingField::ReadingField(const noise::Readings& readings, const VectorXd& residual)
    : residual_(residual(finite(residual))), field_(sites_of(some(readings, finite(residual))), conditioning) {}

const ReadingField::Known& ReadingField::known(const FieldShape& shape, int place) {
  const auto found = known_.find({shape, place});
  if (found != known_.end()) return found->second;
  constexpr double log_variance = 3;  // the field's, dB^2; what is worked out does not depend on it
  const noise::Covariance at{shape.family, {log_variance, 1e-3 * shape.distance, log_variance + 1e-3 * place, 0}};
  const noise::Whitener whitener(field_, at);
  const VectorXd own = Eigen::Map<const VectorXd>(whitener.stencil().own.data(), size());
  ReadingView view{1e-3 * place, {}, {}};
  const auto spread = (own.array().inverse().square() - at.reading_variance()) / at.field_variance();
  view.log_spread = spread.max(1e-3).log();
  const auto entry = known_.emplace(std::pair(shape, place), Known{std::move(view), whitener}).first;
  entry->second.view.error = error_of(shape, place, residual_);
  return entry->second;
}

const ReadingView& ReadingField::view(const FieldShape& shape, int place) { return known(shape, place).view; }

VectorXd ReadingField::error_of(const FieldShape& shape, int place, const VectorXd& residual) {
  const noise::Whitener& whitener = known(shape, place).whitener;
  const VectorXd own = Eigen::Map<const VectorXd>(whitener.stencil().own.data(), size());
  const VectorXd white = whitener(residual);
  const VectorXd off = (white - white.cwiseMax(-far_off).cwiseMin(far_off)).cwiseQuotient(own);
  return whitener(residual - off).cwiseQuotient(own) + off;
}

}  // namespace muster::diagnosis
