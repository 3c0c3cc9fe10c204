#include "diagnosis/inference/noise/family.hpp"

#include <cmath>

namespace muster::noise {

namespace {

constexpr int apart = 16;  // families with different fixed shares: 0 for none, then the shares of each stream's part

std::size_t kind_of(Family family) { return static_cast<std::size_t>(family) / apart; }

// Its place in fixed_shares and in stream_parts. It has a share.
std::size_t share_of(Family family) { return (kind_of(family) - 1) % fixed_shares.size(); }
std::size_t part_of(Family family) { return (kind_of(family) - 1) / fixed_shares.size(); }

std::string plain_name(Family family) {
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

}  // namespace

Family with_fixed(Family family, std::size_t k, std::size_t part) {
  const std::size_t kind = 1 + k + part * fixed_shares.size();
  return static_cast<Family>(static_cast<int>(without_fixed(family)) + apart * static_cast<int>(kind));
}

Family without_fixed(Family family) { return static_cast<Family>(static_cast<int>(family) % apart); }

Family with_less_fixed(Family family) {
  if (kind_of(family) == 0) return family;
  return share_of(family) == 0 ? without_fixed(family) : with_fixed(family, share_of(family) - 1, part_of(family));
}

Family with_more_fixed(Family family) {
  if (kind_of(family) == 0 || share_of(family) == fixed_shares.size() - 1) return family;
  return with_fixed(family, share_of(family) + 1, part_of(family));
}

namespace {

constexpr std::size_t none_of_stream = 0, all_of_stream = 1, least_of_stream = 2;  // in stream_parts

}  // namespace

Family with_less_of_stream(Family family) {
  if (kind_of(family) == 0 || part_of(family) == none_of_stream || part_of(family) == all_of_stream) return family;
  return with_fixed(family, share_of(family),
                    part_of(family) == least_of_stream ? none_of_stream : part_of(family) - 1);
}

Family with_more_of_stream(Family family) {
  if (kind_of(family) == 0 || part_of(family) == all_of_stream || part_of(family) == stream_parts.size() - 1)
    return family;
  return with_fixed(family, share_of(family),
                    part_of(family) == none_of_stream ? least_of_stream : part_of(family) + 1);
}

double fixed_share(Family family) { return kind_of(family) == 0 ? 0 : fixed_shares[share_of(family)]; }

double stream_part(Family family) { return kind_of(family) == 0 ? 0 : stream_parts[part_of(family)]; }

bool is_stated(Family family) { return without_fixed(family) == Family::stated; }

std::string name_of(Family family) {
  const int percent = static_cast<int>(std::lround(100 * fixed_share(family)));
  std::string name = plain_name(without_fixed(family));
  if (percent == 0) return name;
  name += "_fixed_" + std::to_string(percent);
  const int own = static_cast<int>(std::lround(100 * stream_part(family)));
  return own == 0 ? name : own == 100 ? name + "_one_way" : name + "_one_way_" + std::to_string(own);
}

double correlation(Family family, double u) {
  switch (without_fixed(family)) {
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
  switch (without_fixed(family)) {
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

bool is_rough(Family family) { return without_fixed(family) == Family::exponential || family == Family::two_scale; }

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
  if (is_stated(family)) return 1;  // by definition
  double low = 0, high = 10;
  for (int round = 0; round < 50; ++round) {
    const double middle = (low + high) / 2;
    (correlation(family, middle) > std::exp(-1.0) ? low : high) = middle;
  }
  return (low + high) / 2;
}

StatedField stated_by(const Covariance& c, double within) {
  const double variance = (1 - fixed_share(c.family)) * c.field_variance();
  if (is_stated(c.family)) return {std::sqrt(variance), c.decorrelation()};
  const double of_reading = variance / correlation(c.family, within / c.decorrelation());
  return {std::sqrt(of_reading), c.decorrelation() * efold(c.family)};
}

Covariance as_stated(const StatedField& field, Family family, const Theta& beside, double within) {
  Covariance result{family, beside};
  result.theta[1] = std::log(field.decorrelation / efold(family));
  const double of_mean = is_stated(family) ? 1 : correlation(family, within / result.decorrelation());
  result.theta[0] =
      2 * std::log(std::max(field.shadowing, 0.05)) + std::log(of_mean) - std::log(1 - fixed_share(family));
  return result;
}

double Covariance::field_variance() const { return std::exp(theta[0]); }
double Covariance::decorrelation() const { return std::exp(theta[1]); }
double Covariance::reading_variance() const { return std::exp(theta[2]); }
double Covariance::shared() const { return 1 / (1 + std::exp(-theta[3])); }

}  // namespace muster::noise
