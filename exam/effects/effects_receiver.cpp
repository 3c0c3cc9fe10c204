// Effects of the receiver, and of the laws of single readings.
#include <algorithm>
#include <limits>

#include "exam/effects/effect.hpp"
#include "exam/reading_law.hpp"

namespace muster::exam {
namespace {

double level_at(const Scene& s, double share) {
  const Eigen::VectorXd mean = s.measured.design * coefficients(s.site);
  std::vector<double> sorted(mean.begin(), mean.end());
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

Effect rssi_saturation(const Scene& s, Random&) {
  const double top = level_at(s, 0.995) + 8;
  const auto cap = [=](double x) { return std::round(top - x); };
  Effect e{"rssi_saturation"};
  e.acts = Acts::receiver;
  e.linear = false;
  e.most = top - level_at(s, 0.6);
  e.receive = [=](double level, double x) { return std::min(level, cap(x)); };
  e.parameters = [=](double x) { return std::vector<Parameter>{{"level", cap(x), "dBm"}}; };
  return e;
}

// Below the floor the register reports its lowest code, or nothing.
Effect rssi_floor(const Scene& s, Random& random) {
  const double bottom = level_at(s, 0.005) - 8;
  const bool silent = random.chance(0.5);
  const auto floor = [=](double x) { return std::round(bottom + x); };
  Effect e{"rssi_floor"};
  e.acts = Acts::receiver;
  e.linear = false;
  e.most = level_at(s, 0.4) - bottom;
  e.receive = [=](double level, double x) {
    if (level >= floor(x)) return level;
    return silent ? std::numeric_limits<double>::quiet_NaN() : floor(x);
  };
  e.parameters = [=](double x) {
    return std::vector<Parameter>{{"level", floor(x), "dBm"}, {"silent", silent ? 1.0 : 0.0, ""}};
  };
  return e;
}

Effect law(const char* id, Acts acts, double least, double most) {
  Effect e{id};
  e.acts = acts;
  e.linear = false;
  e.least = least;
  e.most = most;
  return e;
}

// The true Rician factor is well below the stated one, or well above a low one.
Effect fading_law(const Scene& s, Random&) {
  const double stated = s.site.stated_reading.rician_k, way = stated > 6.5 ? -stated - 10 : 12;
  Effect e = law("fading_law", Acts::reading_law, 0.02, 1);
  e.change_reading = [=](ReadingLaw& reading, double x) { reading.rician_k = stated + x * way; };
  e.parameters = [=](double x) { return std::vector<Parameter>{{"rician_k", stated + x * way, "dB"}}; };
  return e;
}

Effect outliers(const Scene&, Random&) {
  Effect e = law("outliers", Acts::reading_law, 2e-4, 0.1);
  e.change_reading = [](ReadingLaw& reading, double x) { reading.outliers = x; };
  e.parameters = [](double x) { return std::vector<Parameter>{{"share", x, ""}, {"half_width", 20, "dB"}}; };
  return e;
}

// Three advertising channels, or more, each with its own level; the channel of a reading is not recorded.
Effect channel_mixture(const Scene&, Random& random) {
  std::vector<double> levels(static_cast<std::size_t>(2 + random.below(3)));
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = static_cast<double>(i) + random.uniform(-0.3, 0.3);
  double mean = 0, square = 0;
  for (const double l : levels) mean += l / static_cast<double>(levels.size());
  for (double& l : levels) l -= mean;
  for (const double l : levels) square += l * l / static_cast<double>(levels.size());
  Effect e = law("channel_mixture", Acts::reading_law, 0.3, 10);
  e.change_reading = [=](ReadingLaw& reading, double x) {
    reading.channels = levels;
    for (double& l : reading.channels) l *= x / std::sqrt(square);
  };
  e.parameters = [count = static_cast<double>(levels.size())](double x) {
    return std::vector<Parameter>{{"sd", x, "dB"}, {"channels", count, ""}};
  };
  return e;
}

Effect shadowing_correlation(const Scene& s, Random& random) {
  const double stated = s.site.stated_field.decorrelation, way = random.sign();
  Effect e = law("shadowing_correlation", Acts::field_law, 0.02, 1.5);
  e.change_field = [=](FieldLaw& field, double x) { field.decorrelation = stated * std::exp(way * x); };
  e.parameters = [=](double x) { return std::vector<Parameter>{{"decorrelation", stated * std::exp(way * x), "m"}}; };
  return e;
}

}  // namespace

std::vector<Recipe> receiver_recipes() {
  SiteNeeds single;
  single.single_fades = true;
  return {{"rssi_saturation", true, {}, rssi_saturation}, {"rssi_floor", true, {}, rssi_floor},
          {"fading_law", true, single, fading_law},       {"outliers", true, {}, outliers},
          {"channel_mixture", true, {}, channel_mixture}, {"shadowing_correlation", true, {}, shadowing_correlation}};
}

}  // namespace muster::exam
