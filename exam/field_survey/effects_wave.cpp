// The way of waves: the ground, another exponent from some distance on, a floor.
#include <algorithm>

#include "exam/field_survey/effects.hpp"

namespace muster::exam::survey {
namespace {

std::vector<double> lengths(const Campaign& campaign) {
  std::vector<double> result;
  for (const Row& row : campaign.rows) result.push_back(path_of(campaign.scene, row).length);
  std::sort(result.begin(), result.end());
  return result;
}

std::optional<Planted> ground(const Campaign& campaign, Draws& draws) {
  if (!campaign.scene.panels.empty()) return {};  // a plain in the open
  const double permittivity = draws.log_between(3, 25), roughness = draws.between(0.5, 1);
  Planted planted{"two_ray"};
  planted.values = {{"reflection", roughness, ""}, {"permittivity", permittivity, ""}};
  planted.apply = [=, frequency = campaign.scene.frequency](Scene&, Scene& truth) {
    truth.terms.emplace_back([=](const Path& path) {
      return two_ray_gain(std::hypot(path.rx.x - path.tx.x, path.rx.y - path.tx.y), path.tx.z, path.rx.z, frequency,
                          permittivity, roughness);
    });
  };
  return planted;
}

std::optional<Planted> two_slopes(const Campaign& campaign, Draws& draws) {
  const std::vector<double> d = lengths(campaign);
  const double at = d[static_cast<std::size_t>(draws.between(0.2, 0.7) * static_cast<double>(d.size()))];
  if (d.back() < 3 * at) return {};
  const double change = draws.between(0.6, 2.5);
  Planted planted{"dual_slope"};
  planted.values = {{"break", at, "m"}, {"n_change", change, ""}};
  planted.apply = [=](Scene&, Scene& truth) {
    truth.terms.emplace_back(
        [=](const Path& path) { return path.length > at ? -10 * change * std::log10(path.length / at) : 0.0; });
  };
  return planted;
}

std::optional<Planted> storey(const Campaign& campaign, Draws& draws) {
  constexpr double z = 3.4;  // m
  int through = 0;
  for (const Row& row : campaign.rows) {
    const Path path = path_of(campaign.scene, row);
    through += (path.tx.z - z) * (path.rx.z - z) < 0;
  }
  const int all = static_cast<int>(campaign.rows.size());
  if (campaign.style != "walk" || through < all / 20 || through > all * 19 / 20) return {};
  const double loss = draws.between(4, 15);
  Planted planted{"height"};
  planted.values = {{"loss", loss, "dB"}};
  planted.apply = [=](Scene&, Scene& truth) {
    truth.terms.emplace_back([=](const Path& path) { return (path.tx.z - z) * (path.rx.z - z) < 0 ? -loss : 0.0; });
  };
  return planted;
}

}  // namespace

std::vector<Kind> wave_kinds() { return {{"two_ray", ground}, {"dual_slope", two_slopes}, {"height", storey}}; }

}  // namespace muster::exam::survey
