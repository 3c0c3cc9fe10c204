// The map is wrong: walls, places and names.
#include <algorithm>

#include "exam/field_survey/effects.hpp"

namespace muster::exam::survey {
namespace {

void erase(std::vector<Panel>& panels, const std::string& name) {
  std::erase_if(panels, [&](const Panel& p) { return p.name == name; });
}

// Number of rows whose link passes a panel.
int crossings(const Campaign& campaign, const Panel& panel) {
  return static_cast<int>(std::count_if(campaign.rows.begin(), campaign.rows.end(), [&](const Row& row) {
    const Path path = path_of(campaign.scene, row);
    return passes(panel, path.tx, path.rx);
  }));
}

// A panel that some links pass and others do not.
std::optional<Panel> telling_panel(const Campaign& campaign, Draws& draws) {
  std::vector<Panel> telling;
  for (const Panel& panel : campaign.scene.panels) {
    const int count = crossings(campaign, panel), all = static_cast<int>(campaign.rows.size());
    if (count >= all / 50 && count <= all * 9 / 10) telling.push_back(panel);
  }
  if (telling.empty()) return {};
  return draws.one_of(telling);
}

std::optional<Planted> missing_wall(const Campaign& campaign, Draws& draws) {
  std::optional<Panel> panel;
  if (campaign.left_out >= 0)
    panel = campaign.scene.panels[static_cast<std::size_t>(campaign.left_out)];
  else
    panel = telling_panel(campaign, draws);
  if (!panel) return {};
  Planted planted{"unmapped_wall"};
  planted.values = {{"x0", panel->from.x, "m"},
                    {"y0", panel->from.y, "m"},
                    {"x1", panel->to.x, "m"},
                    {"y1", panel->to.y, "m"},
                    {"loss", panel->loss, "dB"}};
  planted.apply = [name = panel->name](Scene& map, Scene&) { erase(map.panels, name); };
  return planted;
}

std::optional<Planted> absent_wall(const Campaign& campaign, Draws& draws) {
  const auto panel = telling_panel(campaign, draws);
  if (!panel || (campaign.left_out >= 0 &&
                 panel->name == campaign.scene.panels[static_cast<std::size_t>(campaign.left_out)].name))
    return {};
  Planted planted{"wall_absent"};
  planted.rows = {"wall/" + panel->name};
  planted.also = {"wall_material"};
  planted.values = {{"share", 1, ""}};
  planted.apply = [name = panel->name](Scene&, Scene& truth) { erase(truth.panels, name); };
  return planted;
}

std::vector<int> standing(const Campaign& campaign) {
  std::vector<int> result;
  for (std::size_t i = 0; i < campaign.scene.radios.size(); ++i)
    if (!campaign.scene.radios[i].moves) result.push_back(static_cast<int>(i));
  return result;
}

// m, from end to end of all places.
double extent(const Campaign& campaign) {
  Point low{1e300, 1e300}, high{-1e300, -1e300};
  for (const Row& row : campaign.rows) {
    const Path path = path_of(campaign.scene, row);
    for (const Point& p : {path.tx, path.rx}) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  return std::hypot(high.x - low.x, high.y - low.y);
}

// The table has a radio where it is not.
std::optional<Planted> misplaced(const Campaign& campaign, Draws& draws) {
  const int which = draws.one_of(standing(campaign));
  const Radio& radio = campaign.scene.radios[static_cast<std::size_t>(which)];
  const double way = extent(campaign) * draws.log_between(0.06, 0.3), turn = draws.between(0, 6.283185307179586);
  const Point at{to_millimetre(radio.at.x + way * std::cos(turn)), to_millimetre(radio.at.y + way * std::sin(turn)),
                 radio.at.z};
  Planted planted{"tx_misplaced"};
  planted.rows = {"radio/" + radio.name};
  planted.kin = {"label_swap"};
  planted.values = {{"x", radio.at.x, "m"}, {"y", radio.at.y, "m"}};
  // The truth stays, so that no radio ends up inside a wall: the map moves.
  planted.apply = [which, at](Scene& map, Scene&) { map.radios[static_cast<std::size_t>(which)].at = at; };
  return planted;
}

std::optional<Planted> swapped(const Campaign& campaign, Draws& draws) {
  std::vector<int> radios = standing(campaign);
  if (radios.size() < 2) return {};
  draws.shuffle(radios);
  const auto a = static_cast<std::size_t>(radios[0]), b = static_cast<std::size_t>(radios[1]);
  Planted planted{"label_swap"};
  planted.rows = {"radio/" + campaign.scene.radios[a].name, "radio/" + campaign.scene.radios[b].name};
  planted.kin = {"tx_misplaced"};
  planted.apply = [a, b](Scene& map, Scene&) {
    std::swap(map.radios[a].at, map.radios[b].at);
    std::swap(map.radios[a].yaw, map.radios[b].yaw);
  };
  return planted;
}

// Each label on the next radio's place: the list of places slipped by one line.
std::optional<Planted> shifted(const Campaign& campaign, Draws&) {
  const std::vector<int> radios = standing(campaign);
  if (radios.size() < 3) return {};
  Planted planted{"labels_shifted"};
  planted.covariates = {"tx", "rx", "link", "place", "position", "tx_x", "tx_y", "rx_x", "rx_y"};
  planted.also = {"label_swap", "tx_misplaced"};
  for (const int i : radios) planted.rows.push_back("radio/" + campaign.scene.radios[static_cast<std::size_t>(i)].name);
  planted.apply = [radios](Scene& map, Scene&) {
    const Radio first = map.radios[static_cast<std::size_t>(radios[0])];
    for (std::size_t i = 0; i < radios.size(); ++i) {
      Radio& here = map.radios[static_cast<std::size_t>(radios[i])];
      const Radio next = i + 1 < radios.size() ? map.radios[static_cast<std::size_t>(radios[i + 1])] : first;
      here.at = next.at;
      here.yaw = next.yaw;
    }
  };
  return planted;
}

// The plan was drawn from behind: walls are mirrored about its middle, places are not.
std::optional<Planted> mirrored(const Campaign& campaign, Draws&) {
  if (campaign.scene.panels.size() < 3) return {};
  double low = 1e300, high = -1e300;
  for (const Panel& panel : campaign.scene.panels) {
    low = std::min({low, panel.from.x, panel.to.x});
    high = std::max({high, panel.from.x, panel.to.x});
  }
  Planted planted{"plan_mirrored"};
  planted.covariates = {"place", "position", "room", "link", "tx", "rx", "tx_x", "tx_y", "rx_x", "rx_y", "bearing"};
  planted.also = {"plan_turned", "wall_absent", "wall_material", "unmapped_wall", "obstacle", "room_clutter"};
  planted.apply = [turn = low + high](Scene& map, Scene&) {
    for (Panel& panel : map.panels)
      for (Point* end : {&panel.from, &panel.to}) end->x = to_millimetre(turn - end->x);
  };
  return planted;
}

}  // namespace

std::vector<Kind> map_kinds() {
  return {{"unmapped_wall", missing_wall}, {"wall_absent", absent_wall}, {"tx_misplaced", misplaced},
          {"label_swap", swapped},         {"labels_shifted", shifted},  {"plan_mirrored", mirrored, false}};
}

}  // namespace muster::exam::survey
