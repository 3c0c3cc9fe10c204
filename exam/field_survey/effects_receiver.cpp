// The receiver: clipping, compression, a floor, heavy tails.
#include <algorithm>
#include <limits>

#include "exam/field_survey/effects.hpp"

namespace muster::exam::survey {
namespace {

// Level that `share` of the mean levels lie below, dBm.
double quantile(const Campaign& campaign, double share) {
  std::vector<double> levels;
  for (const Row& row : campaign.rows) levels.push_back(mean_level(campaign.scene, row));
  std::sort(levels.begin(), levels.end());
  return std::round(levels[static_cast<std::size_t>(share * static_cast<double>(levels.size() - 1))]);
}

std::optional<Planted> clipped(const Campaign& campaign, Draws& draws) {
  const double top = quantile(campaign, draws.between(0.75, 0.97));
  Planted planted{"rssi_saturation"};
  planted.acts = "receiver";
  planted.values = {{"level", top, "dBm"}};
  planted.apply = [=](Scene&, Scene& truth) {
    truth.receiver.emplace_back([=](double level) { return std::min(level, top); });
  };
  return planted;
}

// Above a knee a dB more at the antenna is half a dB or less in the reading.
std::optional<Planted> compressed(const Campaign& campaign, Draws& draws) {
  const double knee = quantile(campaign, draws.between(0.5, 0.85)), slope = draws.between(0.2, 0.6);
  Planted planted{"rssi_compression"};
  planted.acts = "receiver";
  planted.kin = {"rssi_saturation"};
  planted.values = {{"knee", knee, "dBm"}, {"share", 1 - slope, "dB/dB"}};
  planted.apply = [=](Scene&, Scene& truth) {
    truth.receiver.emplace_back([=](double level) { return level > knee ? knee + slope * (level - knee) : level; });
  };
  return planted;
}

std::optional<Planted> silent_floor(const Campaign& campaign, Draws& draws) {
  const double floor = quantile(campaign, draws.between(0.05, 0.35));
  Planted planted{"rssi_floor"};
  planted.acts = "receiver";
  planted.values = {{"level", floor, "dBm"}};
  planted.apply = [=](Scene&, Scene& truth) {
    truth.receiver.emplace_back(
        [=](double level) { return level < floor ? std::numeric_limits<double>::quiet_NaN() : level; });
  };
  return planted;
}

std::optional<Planted> heavy_tails(const Campaign&, Draws&) {
  Planted planted{"outliers"};
  planted.acts = "reading_law";
  planted.also = {"fading_law"};
  planted.apply = [](Scene&, Scene& truth) { truth.scatter.freedom = 3; };
  return planted;
}

}  // namespace

std::vector<Kind> receiver_kinds() {
  return {{"rssi_saturation", clipped},
          {"rssi_compression", compressed},
          {"rssi_floor", silent_floor},
          {"outliers", heavy_tails}};
}

}  // namespace muster::exam::survey
