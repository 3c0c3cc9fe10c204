#include "diagnosis/inference/noise/family.hpp"

#include <cmath>

namespace muster::noise {

std::string_view name_of(Family family) {
  switch (family) {
    case Family::exponential:
      return "exponential";
    case Family::matern32:
      return "matern32";
    case Family::matern52:
      return "matern52";
    case Family::two_scale:
      return "two_scale";
    case Family::gaussian:
      return "gaussian";
    case Family::stated:
      return "stated";
  }
  return "";
}

double correlation(Family family, double u) {
  switch (family) {
    case Family::exponential:
      return std::exp(-u);
    case Family::matern32:
      return (1 + u) * std::exp(-u);
    case Family::matern52:
      return (1 + u + u * u / 3) * std::exp(-u);
    case Family::two_scale:
      return 0.5 * std::exp(-2.5 * u) + 0.5 * std::exp(-0.4 * u);
    case Family::gaussian:
      return std::exp(-u * u);
    case Family::stated:
      break;
  }
  return 0;
}

double correlation_slope(Family family, double u) {
  switch (family) {
    case Family::exponential:
      return u * std::exp(-u);
    case Family::matern32:
      return u * u * std::exp(-u);
    case Family::matern52:
      return u * u * (1 + u) / 3 * std::exp(-u);
    case Family::two_scale:
      return 1.25 * u * std::exp(-2.5 * u) + 0.2 * u * std::exp(-0.4 * u);
    case Family::gaussian:
      return 2 * u * u * std::exp(-u * u);
    case Family::stated:
      break;
  }
  return 0;
}

bool is_rough(Family family) { return family == Family::exponential || family == Family::two_scale; }

double log_scale_of(Family family) {
  switch (family) {
    case Family::matern32:
      return -0.6;
    case Family::matern52:
      return -0.9;
    default:
      return 0;
  }
}

double efold(Family family) {
  if (family == Family::stated) return 1;  // by definition
  double low = 0, high = 10;
  for (int round = 0; round < 50; ++round) {
    const double middle = (low + high) / 2;
    (correlation(family, middle) > std::exp(-1.0) ? low : high) = middle;
  }
  return (low + high) / 2;
}

StatedField stated_by(const Covariance& c, double within) {
  if (c.family == Family::stated) return {std::sqrt(c.field_variance()), c.decorrelation()};
  const double of_reading = c.field_variance() / correlation(c.family, within / c.decorrelation());
  return {std::sqrt(of_reading), c.decorrelation() * efold(c.family)};
}

Covariance as_stated(const StatedField& field, Family family, const Theta& beside, double within) {
  Covariance result{family, beside};
  result.theta[1] = std::log(field.decorrelation / efold(family));
  const double of_mean = family == Family::stated ? 1 : correlation(family, within / result.decorrelation());
  result.theta[0] = 2 * std::log(std::max(field.shadowing, 0.05)) + std::log(of_mean);
  return result;
}

double Covariance::field_variance() const { return std::exp(theta[0]); }
double Covariance::decorrelation() const { return std::exp(theta[1]); }
double Covariance::reading_variance() const { return std::exp(theta[2]); }
double Covariance::shared() const { return 1 / (1 + std::exp(-theta[3])); }

}  // namespace muster::noise
