#include "exam/field_survey/habits.hpp"

#include <numbers>

namespace muster::exam::survey {

double draw_size(Draws& draws) { return draws.flip() ? draws.log_between(80, 1000) : draws.log_between(1000, 6000); }

void draw_band(Campaign& campaign, Draws& draws, double power, double most_n) {
  static const std::vector<double> bands{150e6, 169e6, 433e6, 868e6, 915e6, 1.8e9, 2.44e9, 3.5e9, 5.2e9, 6.5e9};
  Scene& scene = campaign.scene;
  scene.frequency = draws.one_of(bands);
  scene.power = power;
  scene.l0 = 20 * std::log10(4 * std::numbers::pi * scene.frequency / 299792458.0) + draws.between(-3, 3);
  scene.n = draws.between(1.8, most_n);
}

void draw_habits(Campaign& campaign, Draws& draws) {
  campaign.scene.scatter.step = draws.one_of(std::vector<double>{0.01, 0.1, 0.5, 1, 1});
  const double u = draws.unit();
  campaign.clock = u < 0.55   ? Clock::seconds
                   : u < 0.7  ? Clock::none
                   : u < 0.85 ? Clock::row_number
                              : Clock::nanoseconds;
  campaign.states_frequency = draws.flip();
  campaign.states_scatter = draws.flip(0.7);
  const double listed = draws.one_of(std::vector<double>{1, 1, 0.6, 0});  // all, some or none of the radios
  for (std::size_t i = 0; i < campaign.scene.radios.size(); ++i) campaign.in_world.push_back(draws.flip(listed));
}

std::vector<double> nominal_powers(Draws& draws, double highest) {
  std::vector<double> powers{highest};
  for (int i = draws.whole(1, 3); i > 0; --i) powers.push_back(powers.back() - draws.whole(3, 8));
  return powers;
}

std::vector<Panel> cross_walls(Draws& draws, double wide, double deep) {
  static const std::vector<std::pair<const char*, double>> materials{{"drywall", 3}, {"brick", 6}, {"concrete", 11}};
  std::vector<Panel> panels;
  for (int i = draws.whole(2, 7); i > 0; --i) {
    const auto& [material, loss] = draws.one_of(materials);
    const bool along_x = draws.flip();
    const double line = (along_x ? deep : wide) * draws.between(0.1, 0.9), most = along_x ? wide : deep;
    double from = most * draws.between(0, 0.6), to = from + most * draws.between(0.25, 0.9);
    from = to_millimetre(from);
    to = to_millimetre(std::min(to, most));
    const double at = to_millimetre(line);
    Panel panel{"w" + std::to_string(panels.size() + 1), material, {from, at}, {to, at}, loss, 3};
    if (!along_x) panel.from = {at, from}, panel.to = {at, to};
    panels.push_back(panel);
  }
  return panels;
}

}  // namespace muster::exam::survey
