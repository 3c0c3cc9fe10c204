#include "diagnosis/replicates/noise_checks.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/calibration/distributions.hpp"
#include "text/names.hpp"

namespace muster::diagnosis {
namespace {

double normal_tails(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }
double two_sided(double tail) { return std::min(1.0, 2 * std::min(tail, 1 - tail)); }

std::string printed(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

// Sums of squares of some pieces, and the freedom of their sum (Satterthwaite).
struct Sums {
  double squares = 0, fitted = 0, fitted_squares = 0;
  void add(const CheckedPiece& piece) {
    squares += piece.error * piece.error;
    fitted += piece.variance;
    fitted_squares += piece.variance * piece.variance;
  }
  double freedom() const { return fitted * fitted / fitted_squares; }
  double ratio() const { return squares / fitted; }
};

void check_size(const std::vector<CheckedPiece>& pieces, NoiseCheck& one) {
  std::vector<double> variances;
  for (const auto& piece : pieces) variances.push_back(piece.split);
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  Sums all, quiet, loud;
  for (const auto& piece : pieces) {
    all.add(piece);
    (piece.split < *middle ? quiet : loud).add(piece);
  }
  const auto n = static_cast<double>(pieces.size());
  one.measured_sd = std::sqrt(all.squares / n);
  one.fitted_sd = std::sqrt(all.fitted / n);
  one.variance_p = two_sided(chi_square_tail(all.freedom(), all.freedom() * all.ratio()));
  if (!(quiet.fitted > 0) || !(loud.squares > 0)) return;
  one.quiet_ratio = std::sqrt(quiet.ratio() / loud.ratio());
  one.quiet_p = two_sided(fisher_tail(quiet.freedom(), loud.freedom(), quiet.ratio() / loud.ratio()));
}

// Regression on the course itself, through 0; the standard error allows for unequal variances (White, 1980).
void take_scale(std::vector<CheckedPiece>& pieces, NoiseCheck& one) {
  double products = 0, squares = 0, scatter = 0;
  for (const auto& p : pieces) products += p.error * p.predicted, squares += p.predicted * p.predicted;
  if (!(squares > 0)) return;
  one.scale = products / squares;
  for (auto& p : pieces) {
    p.error -= one.scale * p.predicted;
    scatter += p.error * p.error * p.predicted * p.predicted;
  }
  one.scale_stderr = std::sqrt(scatter) / squares;
  if (scatter > 0) one.scale_p = normal_tails(one.scale / one.scale_stderr);
}

void take_mean(std::vector<CheckedPiece>& pieces, NoiseCheck& one) {
  double sum = 0, squares = 0;
  for (const auto& p : pieces) sum += p.error;
  one.mean = sum / static_cast<double>(pieces.size());
  for (auto& p : pieces) p.error -= one.mean, squares += p.error * p.error;
  if (squares > 0) one.mean_p = normal_tails(sum / std::sqrt(squares));
}

void check_neighbours(const std::vector<CheckedPiece>& pieces, NoiseCheck& one) {
  double products = 0, squared_products = 0, squares = 0;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    if (!pieces[i].follows) continue;
    const double a = pieces[i - 1].error, b = pieces[i].error;
    products += a * b, squared_products += a * b * a * b, squares += (a * a + b * b) / 2;
  }
  if (!(squared_products > 0)) return;
  one.correlation = products / squares;
  one.correlation_p = normal_tails(products / std::sqrt(squared_products));
}

}  // namespace

NoiseCheck checked(const PieceKind& kind, const std::vector<CheckedPiece>& given) {
  NoiseCheck one{.name = kind.name, .unit = kind.unit};
  std::vector<CheckedPiece> pieces;
  bool is_whole = true;  // since the last piece that is used
  for (const auto& piece : given) {
    if (piece.variance > 0) pieces.push_back(piece), pieces.back().follows = piece.follows && is_whole;
    is_whole = piece.variance > 0;
  }
  constexpr std::size_t least = 8;
  if (pieces.size() < least) return one;
  one.pieces = pieces.size();
  check_size(pieces, one);
  take_scale(pieces, one);
  take_mean(pieces, one);
  check_neighbours(pieces, one);
  return one;
}

std::vector<std::string> doubts_of(const NoiseCheck& one, double alpha) {
  std::vector<std::string> result;
  const std::string name = quote(one.name), mend = ", which is no noise and is taken for it until the world is mended";
  if (one.scale_p < alpha)
    result.push_back(name + " is " + printed(100 * std::abs(one.scale)) + " % (+- " + printed(196 * one.scale_stderr) +
                     ") " + (one.scale > 0 ? "more" : "less") + " than the world's: a scale" + mend);
  if (one.mean_p < alpha)
    result.push_back(name + " is off by " + printed(one.mean) + ' ' + one.unit + " on the mean: a bias" + mend);
  if (one.correlation_p < alpha)
    result.push_back("errors of " + name + " that follow one another are " +
                     (one.correlation > 0 ? "alike" : "opposite") + " (correlation " + printed(one.correlation) +
                     "): they are not white, and the interval is too narrow");
  if (one.variance_p < alpha)
    result.push_back(name + " scatters by " + printed(one.measured_sd) + ' ' + one.unit +
                     ", and with the fitted noise by " + printed(one.fitted_sd) +
                     ": its noise is of another kind than the world's");
  if (one.quiet_p < alpha)
    result.push_back("where the world has little noise " + name + " scatters " + printed(one.quiet_ratio) +
                     " times as much as it says, held against where it has much: the noise does not grow as the "
                     "world's does");
  return result;
}

}  // namespace muster::diagnosis
