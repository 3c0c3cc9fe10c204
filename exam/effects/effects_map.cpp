// Effects of the building: walls, rooms, obstacles.
#include <algorithm>
#include <numbers>

#include "exam/effects/effect.hpp"

namespace muster::exam {
namespace {

Vec2 in_plan(Vec3 p) { return {p.x, p.y}; }

// Height of a link at its nearest point to a place.
double height_at(Vec3 p, Vec3 q, Vec2 place) {
  const double x = q.x - p.x, y = q.y - p.y;
  const double share = std::clamp(((place.x - p.x) * x + (place.y - p.y) * y) / (x * x + y * y), 0.0, 1.0);
  return p.z + share * (q.z - p.z);
}

// Share of readings whose link crosses each wall.
std::vector<double> shares_crossed(const Scene& s) {
  std::vector<double> result(s.site.plan.walls.size());
  for (const auto& crossed : s.measured.crossings)
    for (const Crossing& c : crossed)
      result[static_cast<std::size_t>(c.wall)] += 1 / static_cast<double>(s.measured.size());
  return result;
}

int crossed_wall(const Scene& s, Random& random) {
  const std::vector<double> shares = shares_crossed(s);
  std::vector<int> often;
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (shares[i] > 0.02) often.push_back(static_cast<int>(i));
  return often.empty() ? static_cast<int>(std::max_element(shares.begin(), shares.end()) - shares.begin())
                       : random.pick(often);
}

auto by_wall(int wall) {
  return [wall](const Data& data, double strength) {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.size()));
    for (std::size_t i = 0; i < data.size(); ++i)
      for (const Crossing& c : data.crossings[i])
        if (c.wall == wall) result[static_cast<Eigen::Index>(i)] += strength;
    return result;
  };
}

// One wall has another material than on the map.
Effect wall_material(const Scene& s, Random& random) {
  const int wall = crossed_wall(s, random);
  const Wall& w = s.site.plan.walls[static_cast<std::size_t>(wall)];
  const double mapped = s.site.plan.materials[static_cast<std::size_t>(w.material)].loss, sign = mapped < 5.5 ? 1 : -1;
  Effect e{"wall_material"};
  e.rows = {"wall/" + w.name};
  e.least = 0.5;
  e.most = sign > 0 ? 12 : mapped - 1.5;
  e.shift = [=, walls = by_wall(wall)](const Data& data, double x) -> Eigen::VectorXd {
    return walls(data, -sign * x);
  };
  e.parameters = [=](double x) {
    return std::vector<Parameter>{{"loss", mapped + sign * x, "dB"}, {"change", sign * x, "dB"}};
  };
  return e;
}

Effect wall_absent(const Scene& s, Random& random) {
  const int wall = crossed_wall(s, random);
  const Wall& w = s.site.plan.walls[static_cast<std::size_t>(wall)];
  const double loss = s.site.plan.materials[static_cast<std::size_t>(w.material)].loss;
  Effect e{"wall_absent"};
  e.rows = {"wall/" + w.name};
  e.least = e.most = 1;
  e.shift = [=, walls = by_wall(wall)](const Data& data, double x) -> Eigen::VectorXd { return walls(data, x * loss); };
  e.parameters = [=](double) { return std::vector<Parameter>{{"change", -loss, "dB"}}; };
  return e;
}

// True if robots drove through a segment, or closer to a disk than its radius.
template <class Hit>
bool driven(const Scene& s, Hit hit) {
  for (const Data* data : {&s.measured, &s.second}) {
    std::vector<const Reading*> last(static_cast<std::size_t>(s.site.robots), nullptr);
    for (const Reading& r : data->readings) {
      const Reading*& before = last[static_cast<std::size_t>(r.robot)];
      if (before && before->t < r.t && hit(in_plan(before->at), in_plan(r.at))) return true;
      if (!before || before->t < r.t) before = &r;
    }
  }
  return false;
}

template <class Meets>
double share_of_links(const Scene& s, Meets meets) {
  double count = 0;
  const std::size_t stride = 1 + s.measured.size() / 1000;
  for (std::size_t i = 0; i < s.measured.size(); i += stride)
    count += meets(in_plan(place_of(s.site, s.measured.readings[i])), in_plan(s.measured.readings[i].at));
  return count * static_cast<double>(stride) / static_cast<double>(s.measured.size());
}

Effect unmapped_wall(const Scene& s, Random& random) {
  Wall wall{"unmapped", {}, {}, s.site.plan.top(), 0.1, 0};
  for (int attempt = 0; attempt < 400; ++attempt) {
    const Room& room = random.pick(s.site.plan.rooms);
    const Vec2 middle{random.uniform(room.low.x, room.high.x), random.uniform(room.low.y, room.high.y)};
    const double tilt = (random.chance(0.5) ? 0 : std::numbers::pi / 2) + 0.25 * random.normal(),
                 half = random.uniform(0.7, 2.5);
    const double x = half * std::cos(tilt), y = half * std::sin(tilt);
    wall.a = s.site.plan.to_world({middle.x - x, middle.y - y});
    wall.b = s.site.plan.to_world({middle.x + x, middle.y + y});
    if (driven(s, [&](Vec2 p, Vec2 q) { return meeting(p, q, wall.a, wall.b).has_value(); })) continue;
    if (share_of_links(s, [&](Vec2 p, Vec2 q) { return meeting(p, q, wall.a, wall.b).has_value(); }) > 0.03) break;
  }
  Effect e{"unmapped_wall"};
  e.shift = scaled([&site = s.site, wall](const Reading& r) {
    const Vec3 from = place_of(site, r);
    const auto m = meeting(in_plan(from), in_plan(r.at), wall.a, wall.b);
    return m && from.z + m->along_link * (r.at.z - from.z) < wall.height ? -1.0 : 0.0;
  });
  e.parameters = [=](double x) {
    return std::vector<Parameter>{
        {"x0", wall.a.x, "m"}, {"y0", wall.a.y, "m"}, {"x1", wall.b.x, "m"}, {"y1", wall.b.y, "m"}, {"loss", x, "dB"}};
  };
  return e;
}

// A machine or a full cabinet: most of its loss lies near the surface. Links from high stations pass above it.
Effect obstacle(const Scene& s, Random& random) {
  Vec2 at;
  double radius = 0.4;
  for (int attempt = 0; attempt < 400; ++attempt) {
    const Room& room = random.pick(s.site.plan.rooms);
    at = s.site.plan.to_world({random.uniform(room.low.x, room.high.x), random.uniform(room.low.y, room.high.y)});
    radius = random.uniform(0.25, 1);
    const auto hit = [&](Vec2 p, Vec2 q) {
      return chord(p, q, at, radius) > 0 || std::hypot(q.x - at.x, q.y - at.y) < radius;
    };
    if (!driven(s, hit) && share_of_links(s, hit) > 0.03) break;
  }
  Effect e{"obstacle"};
  e.shift = scaled([&site = s.site, at, radius](const Reading& r) {
    const Vec3 from = place_of(site, r);
    const double way = chord(in_plan(from), in_plan(r.at), at, radius);
    return height_at(from, r.at, at) > site.plan.top() ? 0.0 : -(1 - std::exp(-way / radius)) / (1 - std::exp(-2.0));
  });
  e.parameters = [=](double x) {
    return std::vector<Parameter>{{"x", at.x, "m"}, {"y", at.y, "m"}, {"radius", radius, "m"}, {"loss", x, "dB"}};
  };
  e.most = 30;
  return e;
}

Effect room_clutter(const Scene& s, Random& random) {
  std::vector<int> visits(s.site.plan.rooms.size());
  for (const Reading& r : s.measured.readings)
    if (const int room = s.site.plan.room_at(in_plan(r.at)); room >= 0) ++visits[static_cast<std::size_t>(room)];
  std::vector<int> known;  // rooms in which robots spent at least 3 % of the time
  for (std::size_t i = 0; i < visits.size(); ++i)
    if (visits[i] * 33 > static_cast<int>(s.measured.size())) known.push_back(static_cast<int>(i));
  if (known.empty()) known.push_back(static_cast<int>(std::max_element(visits.begin(), visits.end()) - visits.begin()));
  const Room room = s.site.plan.rooms[static_cast<std::size_t>(random.pick(known))];
  const Vec2 centre = s.site.plan.to_world({(room.low.x + room.high.x) / 2, (room.low.y + room.high.y) / 2});
  Effect e{"room_clutter"};
  e.shift = scaled([&site = s.site, room](const Reading& r) {
    if (!room.holds(site.plan.to_own(in_plan(r.at)))) return 0.0;
    return -(1 - std::exp(-length_within(site.plan, room, in_plan(place_of(site, r)), in_plan(r.at)) / 0.8));
  });
  e.parameters = [=](double x) {
    return std::vector<Parameter>{{"x", centre.x, "m"}, {"y", centre.y, "m"}, {"loss", x, "dB"}};
  };
  return e;
}

// Each further wall costs less: waves find ways around.
Effect multiwall_saturation(const Scene& s, Random& random) {
  const double power = random.uniform(1.2, 2);
  Effect e{"multiwall_saturation"};
  e.linear = false;
  e.least = 0.02;
  e.most = 1.5;
  e.shift = [&site = s.site, power](const Data& data, double x) -> Eigen::VectorXd {
    const auto losses = static_cast<Eigen::Index>(site.plan.materials.size());
    const Eigen::VectorXd through = -data.design.rightCols(losses) * coefficients(site).tail(losses);
    return through.unaryExpr([=](double l) { return l - l / std::pow(1 + std::pow(x * l / 12, power), 1 / power); });
  };
  e.parameters = [=](double x) { return std::vector<Parameter>{{"scale", 12 / x, "dB"}, {"power", power, ""}}; };
  return e;
}

// Fresnel loss of a slab's two faces relative to normal incidence, in dB; field along the wall.
double slant_loss(double cosine, double permittivity) {
  const double c = std::max(cosine, 0.15), inside = std::sqrt(permittivity - 1 + c * c), root = std::sqrt(permittivity);
  const auto through = [](double outer, double inner) {
    return 4 * outer * inner / ((outer + inner) * (outer + inner));
  };
  return -20 * std::log10(through(c, inside) / through(1, root));
}

Effect incidence(const Scene&, Random& random) {
  const double permittivity = random.uniform(2.5, 6);
  Effect e{"incidence"};
  e.least = 0.05;
  e.most = 3;
  e.shift = [permittivity](const Data& data, double x) {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.size()));
    for (std::size_t i = 0; i < data.size(); ++i)
      for (const Crossing& c : data.crossings[i])
        result[static_cast<Eigen::Index>(i)] -= x * slant_loss(c.cosine, permittivity);
    return result;
  };
  e.parameters = [=](double x) { return std::vector<Parameter>{{"scale", x, ""}, {"permittivity", permittivity, ""}}; };
  return e;
}

// A ceiling missing from the map, below the two stations above it. Its loss is the mean over links through it, mostly
// at flat angles.
Effect height(const Scene& s, Random&) {
  Effect e{"height"};
  for (std::size_t i = 0; i < s.site.plan.stations.size(); ++i)
    if (s.site.plan.stations[i].at.z > s.site.plan.top()) e.rows.push_back(radio_row(s.site, static_cast<int>(i)));
  const auto loss = [&site = s.site](const Reading& r) {
    const Vec3 from = place_of(site, r);
    if (from.z < site.plan.top()) return 0.0;
    const double sine = (from.z - r.at.z) / distance_of(from, r.at);
    return 1 + 0.15 * (std::min(1 / sine, 4.0) - 1);
  };
  double sum = 0, links = 0;
  for (const Reading& r : s.measured.readings) {
    sum += loss(r);
    links += loss(r) > 0;
  }
  e.shift = scaled([=](const Reading& r) { return -loss(r); });
  e.parameters = [mean = sum / std::max(links, 1.0)](double x) {
    return std::vector<Parameter>{{"loss", x * mean, "dB"}};
  };
  return e;
}

}  // namespace

std::vector<Recipe> map_recipes() {
  SiteNeeds high;
  high.plan.high_stations = true;
  return {{"wall_material", true, {}, wall_material}, {"wall_absent", true, {}, wall_absent},
          {"unmapped_wall", true, {}, unmapped_wall}, {"obstacle", true, {}, obstacle},
          {"room_clutter", true, {}, room_clutter},   {"multiwall_saturation", true, {}, multiwall_saturation},
          {"incidence", true, {}, incidence},         {"height", true, high, height}};
}

}  // namespace muster::exam
