#include <algorithm>

#include "exam/field_survey/campaign.hpp"
#include "exam/field_survey/habits.hpp"

namespace muster::exam::survey {

Campaign mesh(Draws& draws) {
  Campaign campaign;
  campaign.style = "mesh";
  campaign.both_ways = true;
  Scene& scene = campaign.scene;
  const bool indoors = draws.flip();
  const double wide = indoors ? draws.between(12, 60) : draws.log_between(60, 6000),
               deep = wide * draws.between(0.4, 1), target = draw_size(draws);
  if (indoors && draws.flip(0.8)) scene.panels = cross_walls(draws, wide, deep);
  // All pairs, both ways, at least twice.
  const int most = static_cast<int>((1 + std::sqrt(1 + 2 * target)) / 2), radios = draws.whole(5, std::min(most, 16));
  const int snapshots = std::max(2, static_cast<int>(target / (radios * (radios - 1))));
  for (int i = 0; i < radios; ++i)
    scene.radios.push_back({"node" + std::to_string(i + 1),
                            {to_millimetre(draws.between(0, wide)), to_millimetre(draws.between(0, deep)),
                             to_millimetre(indoors ? draws.between(0.3, 2.2) : draws.between(1.2, 8))}});
  draw_band(campaign, draws, indoors ? draws.whole(-10, 15) : draws.whole(10, 30), indoors ? 2.6 : 3);
  scene.scatter.frozen = draws.between(2, 6);
  scene.scatter.reading = draws.between(1, 2);
  draw_habits(campaign, draws);
  if (draws.flip(0.35)) campaign.powers = nominal_powers(draws, scene.power);
  const int levels = std::max(1, static_cast<int>(campaign.powers.size()));
  for (int s = 0; s < snapshots; ++s)
    for (int tx = 0, order = 0; tx < radios; ++tx)
      for (int rx = 0; rx < radios; ++rx, ++order) {
        if (tx == rx) continue;
        Row row;
        row.t = 3600.0 * s + 0.5 * order;
        row.tx = tx;
        row.rx = rx;
        row.cell = std::min(tx, rx) * radios + std::max(tx, rx);
        row.power = s % levels;
        campaign.rows.push_back(row);
      }
  return campaign;
}

}  // namespace muster::exam::survey
