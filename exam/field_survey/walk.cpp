#include <algorithm>

#include "exam/field_survey/campaign.hpp"
#include "exam/field_survey/coverage.hpp"
#include "exam/field_survey/habits.hpp"

namespace muster::exam::survey {

Campaign walk(Draws& draws) {
  Campaign campaign;
  campaign.style = "walk";
  Scene& scene = campaign.scene;
  const double wide = draws.between(15, 50), deep = wide * draws.between(0.4, 0.9), size = draw_size(draws);
  if (draws.flip(0.85)) scene.panels = cross_walls(draws, wide, deep);
  const bool two_floors = draws.flip(0.3);
  const int stations = draws.whole(1, 4), repeats = draws.whole(2, 6);
  const int places = std::clamp(static_cast<int>(size / (stations * repeats)), 12, 700);
  for (int s = 0; s < stations; ++s)
    scene.radios.push_back(
        {"ap" + std::to_string(s + 1),
         {to_millimetre(draws.between(1, wide - 1)), to_millimetre(draws.between(1, deep - 1)),
          to_millimetre(two_floors && draws.flip() ? draws.between(4.5, 5.5) : draws.between(0.8, 2.6))}});
  scene.radios.push_back({"phone", {}, 0, true});
  draw_band(campaign, draws, draws.whole(0, 20), 2.6);
  scene.scatter = {draws.between(2, 5), draws.between(1.5, 6), draws.between(1.5, 4), draws.between(1, 2)};
  draw_habits(campaign, draws);
  campaign.headings = draws.flip(0.6);
  if (draws.flip(0.25)) campaign.powers = nominal_powers(draws, scene.power);
  const int levels = std::max(1, static_cast<int>(campaign.powers.size()));
  const bool phone_sends = draws.flip(0.3);
  const std::vector<Pose> drive =
      covering_drive(scene.panels, {wide, deep}, {wide / 2, deep / 2, 1.2}, std::max(0.6, wide / 40), 0.3, places);
  double t = 0;
  int cell = 0;
  for (int p = 0; p < places; ++p) {
    Point at = drive[static_cast<std::size_t>(p)].at;
    at.z = two_floors && p >= places / 2 ? 4.3 : 1.2;
    // The carrier turns at a place, so that headings do not follow from the way.
    for (int k = 0; k < repeats; ++k, t += 2) {
      const double yaw = drive[static_cast<std::size_t>(p)].yaw + 1.5707963267948966 * k + draws.between(-0.4, 0.4);
      for (int s = 0; s < stations; ++s) {
        Row row{
            t, s, stations, {to_millimetre(at.x), to_millimetre(at.y), at.z}, std::remainder(yaw, 6.283185307179586)};
        if (phone_sends) std::swap(row.tx, row.rx);
        row.cell = cell + s;
        row.power = (p + k) % levels;
        campaign.rows.push_back(row);
      }
    }
    cell += stations;
    t += draws.between(5, 40);
  }
  return campaign;
}

}  // namespace muster::exam::survey
