#include <algorithm>
#include <numbers>

#include "exam/field_survey/campaign.hpp"
#include "exam/field_survey/habits.hpp"

namespace muster::exam::survey {
namespace {

// A route of roads: straight legs that turn at crossings and stay within `reach` of the origin.
std::vector<Point> route(Draws& draws, double reach, int stops) {
  std::vector<Point> result;
  Point at{draws.between(-0.5, 0.5) * reach, draws.between(-0.5, 0.5) * reach};
  double heading = draws.between(0, 2 * std::numbers::pi);
  const double pitch = 5 * reach / stops;
  for (int i = 0; i < stops; ++i) {
    if (draws.flip(0.06)) heading += draws.sign() * draws.between(0.6, 1.8);
    if (std::hypot(at.x, at.y) > 0.9 * reach)  // back towards the middle
      heading = std::atan2(-at.y, -at.x) + draws.between(-0.7, 0.7);
    at.x += pitch * std::cos(heading);
    at.y += pitch * std::sin(heading);
    result.push_back(at);
  }
  return result;
}

}  // namespace

Campaign drive(Draws& draws) {
  Campaign campaign;
  campaign.style = "drive";
  Scene& scene = campaign.scene;
  // m; the longest links are about twice as long.
  const double reach = draws.log_between(60, 10000), size = draw_size(draws);
  const int masts = draws.whole(1, 4), repeats = draws.whole(1, 3);
  const int stops = std::clamp(static_cast<int>(size / (masts * repeats)), 20, 1000);
  for (int m = 0; m < masts; ++m) {
    const double away = reach * std::sqrt(draws.unit()) * 0.8, turn = draws.between(0, 2 * std::numbers::pi);
    scene.radios.push_back({"mast" + std::to_string(m + 1),
                            {to_millimetre(away * std::cos(turn)), to_millimetre(away * std::sin(turn)),
                             to_millimetre(reach < 500 ? draws.between(2, 12) : draws.between(8, 45))}});
  }
  scene.radios.push_back({"car", {}, 0, true});
  draw_band(campaign, draws, reach < 500 ? draws.whole(0, 20) : draws.whole(30, 43), 2.8);
  scene.scatter = {draws.between(2, 6), std::clamp(reach / draws.between(20, 80), 3.0, 150.0), draws.between(1, 3),
                   draws.between(1, 2)};
  draw_habits(campaign, draws);
  campaign.headings = draws.flip(0.4);
  const bool car_sends = draws.flip(0.3);
  const double height = to_millimetre(draws.between(1.4, 2.2)), speed = draws.between(5, 20);
  const std::vector<Point> way = route(draws, reach, stops);
  for (std::size_t p = 0; p < way.size(); ++p) {
    const Point before = way[p > 0 ? p - 1 : p], after = way[p > 0 ? p : p + 1];
    for (int k = 0; k < repeats; ++k)
      for (int m = 0; m < masts; ++m) {
        Row row{static_cast<double>(p) * 5 * reach / stops / speed + 0.2 * k,
                m,
                masts,
                {to_millimetre(way[p].x), to_millimetre(way[p].y), height},
                std::atan2(after.y - before.y, after.x - before.x)};
        if (car_sends) std::swap(row.tx, row.rx);
        row.cell = static_cast<int>(p) * masts + m;
        campaign.rows.push_back(row);
      }
  }
  std::stable_sort(campaign.rows.begin(), campaign.rows.end(), [](const Row& a, const Row& b) { return a.t < b.t; });
  return campaign;
}

}  // namespace muster::exam::survey
