#include "exam/field_survey/campaign.hpp"
#include "exam/field_survey/coverage.hpp"

namespace muster::exam::survey {
namespace {

constexpr double wide = 10, deep = 9;     // m
constexpr double brick = 6, drywall = 3;  // dB
constexpr double gap = 0.9;               // m, of a door

struct Room {
  double x0, y0, x1, y1;
};

class Builder {
 public:
  explicit Builder(Draws& draws) : draws_(draws) {}

  // A wall along x or y, with gaps of doors that begin at the given coordinates along it.
  void wall(double x0, double y0, double x1, double y1, bool is_brick, std::vector<double> doors = {}) {
    const bool along_x = y0 == y1;
    double from = along_x ? x0 : y0;
    doors.push_back(1e9);
    for (const double door : doors) {
      const double to = std::min(door, along_x ? x1 : y1);
      if (to > from) along_x ? add(from, y0, to, y0, is_brick) : add(x0, from, x0, to, is_brick);
      from = door + gap;
    }
  }

  void add(double x0, double y0, double x1, double y1, bool is_brick) {
    panels.push_back({"w" + std::to_string(panels.size() + 1),
                      is_brick ? "brick" : "drywall",
                      {to_millimetre(x0), to_millimetre(y0)},
                      {to_millimetre(x1), to_millimetre(y1)},
                      is_brick ? brick : drywall});
  }

  // Rooms between two walls along x, `front` being the one with doors.
  void row_of_rooms(double y0, double y1, double front, int count) {
    std::vector<double> doors, cuts{0};
    for (int i = 1; i < count; ++i) cuts.push_back(wide * i / count + draws_.between(-0.6, 0.6));
    cuts.push_back(wide);
    for (int i = 0; i < count; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (i > 0) wall(cuts[k], y0, cuts[k], y1, draws_.flip());
      doors.push_back(cuts[k] + draws_.between(0.3, cuts[k + 1] - cuts[k] - gap - 0.3));
      rooms.push_back({cuts[k], y0, cuts[k + 1], y1});
    }
    wall(0, front, wide, front, draws_.flip(), doors);
  }

  std::vector<Panel> panels;
  std::vector<Room> rooms;

 private:
  Draws& draws_;
};

// 3 m of 7 dB in a room, so that the carrier can pass beside it.
Panel partition(Draws& draws, const Room& room) {
  const double margin = 0.75, span = 3;
  double x = draws.between(room.x0 + margin, room.x1 - margin), y = draws.between(room.y0 + margin, room.y1 - margin);
  Panel panel{"partition", "concrete", {x, y}, {x, y}, 7};
  const bool along_x = room.y1 - room.y0 < span + 2 * margin || draws.flip();
  const double slack = (along_x ? room.x1 - room.x0 : room.y1 - room.y0) - span;
  // From a wall into the room, or free on both sides.
  const double begin = draws.flip() ? 0 : slack - (slack > 2 * margin ? draws.between(margin, slack - margin) : 0);
  (along_x ? panel.from.x : panel.from.y) = (along_x ? room.x0 : room.y0) + begin;
  (along_x ? panel.to.x : panel.to.y) = (along_x ? room.x0 : room.y0) + begin + span;
  for (Point* end : {&panel.from, &panel.to}) *end = {to_millimetre(end->x), to_millimetre(end->y)};
  return panel;
}

int crossings(const Campaign& campaign, const Panel& panel) {
  int count = 0;
  for (const Row& row : campaign.rows) {
    const Path path = path_of(campaign.scene, row);
    count += passes(panel, path.tx, path.rx);
  }
  return count;
}

void list_rows(Campaign& campaign, Draws& draws) {
  Scene& scene = campaign.scene;
  const int stations = static_cast<int>(scene.radios.size()) - 1, rover = stations;
  const int polls = draws.whole(3000, 7000) / stations;
  const double start_z = to_millimetre(draws.between(0.3, 1.2)), period = draws.between(0.2, 0.5);
  const bool rover_sends = draws.flip(0.3);
  campaign.rows.clear();
  const std::vector<Pose> drive =
      covering_drive(scene.panels, {wide, deep}, {draws.between(1, 9), draws.between(1, 8), start_z}, 0.3, 0.2, polls);
  for (int i = 0; i < polls; ++i)
    for (int s = 0; s < stations; ++s) {
      const Pose& pose = drive[static_cast<std::size_t>(i)];
      Row row{i * period, s, rover, {to_millimetre(pose.at.x), to_millimetre(pose.at.y), start_z}, pose.yaw};
      if (rover_sends) std::swap(row.tx, row.rx);
      row.cell = static_cast<int>(campaign.rows.size());
      campaign.rows.push_back(row);
    }
}

}  // namespace

Campaign flat(Draws& draws) {
  Campaign campaign;
  campaign.style = "flat";
  Scene& scene = campaign.scene;
  for (bool useful = false; !useful;) {  // a partition that no link passes could not be missed
    Builder build(draws);
    build.wall(0, 0, wide, 0, true);
    build.wall(0, deep, wide, deep, true);
    build.wall(0, 0, 0, deep, true);
    build.wall(wide, 0, wide, deep, true);
    const double hall = draws.between(3.6, 4.0), hall_end = hall + draws.between(1.2, 1.5);
    build.row_of_rooms(0, hall, hall, 2);
    build.row_of_rooms(hall_end, deep, hall_end, draws.whole(2, 3));
    std::vector<Room> large;
    for (const Room& room : build.rooms)
      if (room.x1 - room.x0 >= 4.2) large.push_back(room);
    if (large.empty()) continue;
    scene.panels = build.panels;
    scene.panels.push_back(partition(draws, draws.one_of(large)));
    campaign.left_out = static_cast<int>(scene.panels.size()) - 1;
    scene.radios.clear();
    const int stations = draws.whole(1, 4);
    std::vector<Room> rooms = build.rooms;
    draws.shuffle(rooms);
    for (int s = 0; s < stations; ++s) {
      const Room& room = rooms[static_cast<std::size_t>(s) % rooms.size()];
      scene.radios.push_back(
          {"anchor" + std::to_string(s + 1),
           {to_millimetre(draws.between(room.x0 + 0.2, room.x1 - 0.2)),
            to_millimetre(draws.between(room.y0 + 0.2, room.y1 - 0.2)), to_millimetre(draws.between(0.8, 2.4))}});
    }
    scene.radios.push_back({"rover", {}, 0, true});
    list_rows(campaign, draws);
    useful = crossings(campaign, scene.panels.back()) >= 60;
  }
  scene.power = draws.whole(-10, 10);
  scene.frequency = draws.one_of(std::vector<double>{868e6, 2.44e9, 5.2e9});
  scene.l0 = 20 * std::log10(scene.frequency * 4e-8 * 3.141592653589793 / 2.99792458) + draws.between(-3, 3);
  scene.n = draws.between(1.7, 2.3);
  scene.scatter.reading = draws.between(1, 2);
  scene.scatter.step = draws.one_of(std::vector<double>{0.01, 0.1, 1});
  campaign.headings = draws.flip();
  campaign.states_scatter = draws.flip();
  campaign.states_frequency = draws.flip();
  return campaign;
}

}  // namespace muster::exam::survey
