#include "run_log/scene_log.hpp"

#include <algorithm>
#include <cmath>
#include <muster/tables.hpp>

#include "mcap/rewrite.hpp"
#include "run_log/ros_types.hpp"
#include "run_log/table_log.hpp"
#include "run_log/tables/cdr.hpp"

namespace muster::run_log {
namespace {

constexpr double transforms_interval = 0.01;  // s; at most so often: viewers interpolate
constexpr const char* world_frame = "world";

template <class Row>
struct Rows {
  Rows(const Simulation& run, const std::string& set, const std::string& quantity) {
    const Table* table = run.board().find(set + "/*/" + quantity);
    if (!table) return;
    first = reinterpret_cast<const Row*>(table->now().data.data());
    count = std::min(table->now().rows, table->set().names.size());
    names = &table->set().names;
    alive = &table->set().alive;
  }
  const Row* first = nullptr;
  std::size_t count = 0;
  const std::vector<std::string>* names = nullptr;
  const std::vector<std::uint8_t>* alive = nullptr;
};

void put_time(CdrWriter& to, std::uint64_t now) {
  to.put(static_cast<std::int32_t>(now / 1'000'000'000)).put(static_cast<std::uint32_t>(now % 1'000'000'000));
}

struct Colour {
  float r, g, b, a;
};
constexpr Colour wall_colour{0.75f, 0.75f, 0.72f, 0.6f}, open_door{0.35f, 0.65f, 0.35f, 0.25f},
    shut_door{0.6f, 0.4f, 0.2f, 0.8f}, radio_colour{0.85f, 0.35f, 0.1f, 1}, robot_colour{0.1f, 0.4f, 0.75f, 0.9f},
    text_colour{1, 1, 1, 1};

enum class Shape : std::int32_t { cube = 1, sphere = 2, cylinder = 3, text = 9 };

struct Marker {
  std::string_view frame, space;
  Shape shape;
  double x, y, z, yaw;
  double length, width, height;
  Colour colour;
  std::string_view text{};
};

void put_marker(CdrWriter& to, const Marker& m, std::int32_t id, std::uint64_t now) {
  put_time(to, now);
  to.text(m.frame).text(m.space).put(id).put(static_cast<std::int32_t>(m.shape)).put(std::int32_t{0});
  for (const double v : {m.x, m.y, m.z, 0.0, 0.0, std::sin(m.yaw / 2), std::cos(m.yaw / 2)}) to.put(v);
  for (const double v : {m.length, m.width, m.height}) to.put(v);
  for (const float v : {m.colour.r, m.colour.g, m.colour.b, m.colour.a}) to.put(v);
  put_time(to, 0);                // lifetime: it stays
  to.put(std::uint8_t{1});        // it moves with its frame
  to.count(0).count(0).text("");  // points, colours, texture
  put_time(to, 0);
  to.text("").text("").count(0).count(0);                           // the texture: frame, format, data, coordinates
  to.text(m.text).text("").text("").count(0).put(std::uint8_t{0});  // text, mesh
}

void add_building(const Simulation& run, std::vector<Marker>& markers) {
  const Rows<Wall> walls(run, "wall", "shape");
  const auto along = [&](const Wall& w, double from, double to, double height, double thicker, Colour colour) {
    const double length = std::hypot(w.x1 - w.x0, w.y1 - w.y0), middle = (from + to) / 2 / length;
    markers.push_back({world_frame, "building", Shape::cube, w.x0 + (w.x1 - w.x0) * middle,
                       w.y0 + (w.y1 - w.y0) * middle, w.base + height / 2, std::atan2(w.y1 - w.y0, w.x1 - w.x0),
                       to - from, w.thickness + thicker, height, colour});
  };
  for (std::size_t i = 0; i < walls.count; ++i) {
    const Wall& w = walls.first[i];
    along(w, 0, std::hypot(w.x1 - w.x0, w.y1 - w.y0), w.height, 0, wall_colour);
  }
  const Rows<Door> doors(run, "door", "shape");
  const Rows<DoorState> states(run, "door", "state");
  for (std::size_t i = 0; i < std::min(doors.count, states.count); ++i) {
    const Door& d = doors.first[i];
    if (!(d.wall >= 0 && d.wall < static_cast<double>(walls.count))) continue;
    along(walls.first[static_cast<std::size_t>(d.wall)], d.at, d.at + d.width, d.height, 0.02,
          states.first[i].open != 0 ? open_door : shut_door);
  }
}

void add_radios(const Simulation& run, std::vector<Marker>& markers) {
  const Rows<Mount> radios(run, "radio", "mount");
  for (std::size_t i = 0; i < radios.count; ++i) {
    const Mount& m = radios.first[i];
    if (!std::isnan(m.robot)) continue;
    markers.push_back({world_frame, "stations", Shape::sphere, m.x, m.y, m.z, 0, 0.2, 0.2, 0.2, radio_colour});
    markers.push_back(
        {world_frame, "names", Shape::text, m.x, m.y, m.z + 0.3, 0, 0, 0, 0.25, text_colour, (*radios.names)[i]});
  }
}

}  // namespace

SceneLog::SceneLog(const Simulation& run, mcap::Sink& sink) : sink_(sink) {
  every_ = static_cast<std::uint64_t>(std::max(1.0, std::round(transforms_interval / run.world().dt)));
}

void SceneLog::send(std::uint16_t channel, std::uint32_t sequence, std::uint64_t now) {
  sink_.message({channel, sequence, now, now, message_});
}

void SceneLog::write(const Simulation& run) {
  if (!scene_) write_building(run);
  write_robots(run);
  if (run.tick() % every_ == 0) write_transforms(run);
  write_events(run);
}

void SceneLog::write_transforms(const Simulation& run) {
  const Rows<Pose> poses(run, "robot", "pose");
  if (poses.count == 0) return;
  if (!transforms_)
    transforms_ =
        sink_.channel({0, sink_.schema({0, tf_message.name, "ros2msg", tf_message.definition}), "/tf", "cdr", {}});
  const std::uint64_t now = log_time(run.time());
  CdrWriter to(message_);
  to.count(static_cast<std::size_t>(std::count_if(poses.alive->begin(),
                                                  poses.alive->begin() + static_cast<std::ptrdiff_t>(poses.count),
                                                  [](std::uint8_t alive) { return alive != 0; })));
  for (std::size_t i = 0; i < poses.count; ++i) {
    if (!(*poses.alive)[i]) continue;
    const Pose& p = poses.first[i];
    put_time(to, now);
    to.text(world_frame).text((*poses.names)[i]);
    const double values[] = {p.x, p.y, p.z, p.qx, p.qy, p.qz, p.qw};
    to.reals(values, std::size(values));
  }
  send(*transforms_, transforms_sent_++, now);
}

void SceneLog::write_building(const Simulation& run) {
  scene_ = sink_.channel({0,
                          sink_.schema({0, marker_array.name, "ros2msg", marker_array.definition}),
                          "/scene",
                          "cdr",
                          {{mcap::still, "true"}}});
  std::vector<Marker> markers;
  add_building(run, markers);
  add_radios(run, markers);
  const std::uint64_t now = log_time(run.time());
  CdrWriter to(message_);
  to.count(markers.size());
  for (const Marker& marker : markers) put_marker(to, marker, next_marker_++, now);
  send(*scene_, scenes_sent_++, now);
}

// Those that were not there before.
void SceneLog::write_robots(const Simulation& run) {
  const Rows<Pose> poses(run, "robot", "pose");
  if (robots_drawn_ >= poses.count) return;
  const std::uint64_t now = log_time(run.time());
  CdrWriter to(message_);
  to.count(2 * (poses.count - robots_drawn_));
  for (; robots_drawn_ < poses.count; ++robots_drawn_) {
    const std::string& name = (*poses.names)[robots_drawn_];
    put_marker(to, {name, "robots", Shape::cylinder, 0, 0, 0.15, 0, 0.3, 0.3, 0.3, robot_colour}, next_marker_++, now);
    put_marker(to, {name, "names", Shape::text, 0, 0, 0.55, 0, 0, 0, 0.25, text_colour, name}, next_marker_++, now);
  }
  send(*scene_, scenes_sent_++, now);
}

void SceneLog::write_events(const Simulation& run) {
  constexpr std::uint8_t info = 20;
  if (!events_)
    events_ =
        sink_.channel({0, sink_.schema({0, log_line.name, "ros2msg", log_line.definition}), "/events", "cdr", {}});
  for (; events_sent_ < run.events().size(); ++events_sent_) {
    const Event& event = run.events()[events_sent_];
    const std::uint64_t at = log_time(static_cast<double>(event.tick) * run.world().dt);
    CdrWriter to(message_);
    put_time(to, at);
    to.put(info).text(event.instance).text(event.message).text("").text("").put(std::uint32_t{0});
    send(*events_, static_cast<std::uint32_t>(events_sent_), std::min(at, log_time(run.time())));
  }
}

}  // namespace muster::run_log
