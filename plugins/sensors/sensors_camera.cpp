// A camera on a robot: depth and colour of walls, doors, meshes, the ground and other robots, without a display.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <muster/meshes.hpp>
#include <muster/plugin.hpp>
#include <muster/senses.hpp>
#include <optional>

#include "body_frame.hpp"
#include "description/mesh.hpp"
#include "description/world_robots.hpp"
#include "plugins/mesh_sizes.hpp"
#include "plugins/periods.hpp"
#include "plugins/scene_rows.hpp"
#include "plugins/world_folder.hpp"
#include "robot_solids.hpp"
#include "scene/slabs.hpp"
#include "view.hpp"

namespace {

using namespace muster;
using description::WorldRobots;
using Eigen::Isometry3d;
using Eigen::Vector3d;

// A door's leaf as a wall of its own.
scene::Wall leaf_of(const scene::Door& door, const scene::Wall& wall) {
  const double x = wall.x1 - wall.x0, y = wall.y1 - wall.y0, length = std::hypot(x, y);
  const double from = door.at / length, to = std::min(1.0, (door.at + door.width) / length);
  scene::Wall leaf = wall;
  leaf.x0 = wall.x0 + from * x, leaf.y0 = wall.y0 + from * y;
  leaf.x1 = wall.x0 + to * x, leaf.y1 = wall.y0 + to * y;
  leaf.height = std::min(door.height, wall.height);
  leaf.material = door.material;
  return leaf;
}

// Makes closed doors of another material than their wall's gaps with a wall in each, which have colours of their own.
void part_doors(std::vector<scene::Wall>& walls, std::vector<scene::Door>& doors) {
  for (scene::Door& door : doors) {
    const scene::Wall wall = walls[static_cast<std::size_t>(door.wall)];
    if (door.open || door.material == wall.material) continue;
    if (door.at < std::hypot(wall.x1 - wall.x0, wall.y1 - wall.y0)) walls.push_back(leaf_of(door, wall));
    door.open = true;
  }
}

struct SensorsCamera {
  static constexpr auto id = "sensors.camera/2";
  static constexpr auto summary = "a camera on a robot: depth and colour, with a sun, its shadows and fog";
  static constexpr auto manual =
      R"(At `rate` a picture of width x height pixels goes to image/*/message: a depth (metres along the camera's axis; float,
REP 118) and a colour (red, green, blue bytes) a pixel, row by row from the top left. The camera is a pinhole without
distortion: at x, y, z of the body it looks along the body's x, turned by `roll`, `pitch` (positive: down) and `yaw`.
Seen are walls as thick as they are, with their open doors, meshes of the world, the ground and other robots' bodies and
wheels (round ones with 24 sides), of one sample a pixel, in its middle. Not seen: the robot itself, legs, limbs, floors
other than the ground. Colours are those of materials (<material colour="red green blue">) under a sun (`sun_azimuth`
from east to north, `sun_elevation`) by Lambert's law with a share `ambient` of light from everywhere; its shadows are
cast within `shadows` of the camera, their edges good to 1.5/512 of that. Fog takes colours into the sky's with
exp(-fog x distance), and leaves depth as it is.
Depth has Gaussian noise of standard deviation depth_noise x depth^2, as of triangulation (Khoshelham and Elberink,
Sensors 2012); colours have one of `noise`, of 0 to 1. Pictures are large: 0.5 MB each at 320 x 240.)";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot that carries it").required(),
      integer("camera", 0, 0, 1000, "its number, where a robot has several"),
      integer("width", 320, 1, 4096, "pixels"),
      integer("height", 240, 1, 4096, "pixels"),
      real("fov", 1.2, 0.01, 3, "rad", "width of its field of view"),
      real("rate", 10, 1e-3, 1e6, "Hz", "of pictures, at most one a tick"),
      real("x", 0, -1e3, 1e3, "m", "its place on the body, forward"),
      real("y", 0, -1e3, 1e3, "m", "to the left"),
      real("z", 0.2, -1e3, 1e3, "m", "up"),
      real("roll", 0, -6.3, 6.3, "rad", "its turn about the body's x"),
      real("pitch", 0, -6.3, 6.3, "rad", "then about y: positive looks down"),
      real("yaw", 0, -6.3, 6.3, "rad", "then about z"),
      real("min_range", 0.1, 0, 1e3, "m", "least depth"),
      real("max_range", 100, 0.01, 1e6, "m", "largest depth"),
      real("depth_noise", 0, 0, 1, "1/m", "standard deviation of depth, for each square metre of it").free(),
      real("noise", 0, 0, 1, "", "standard deviation of a colour").free(),
      real("sun_azimuth", 0.8, -6.3, 6.3, "rad", "where the sun is, from east to north"),
      real("sun_elevation", 0.9, -1.6, 1.6, "rad", "over the horizon; below it there is none"),
      real("ambient", 0.4, 0, 1, "", "share of light from everywhere"),
      real("fog", 0, 0, 10, "1/m", "extinction: 3.9 over the visibility"),
      real("shadows", 12, 0, 1e3, "m", "how far shadows are cast; 0: none")};

  explicit SensorsCamera(Setup& s)
      : width(s.value("width")),
        height(s.value("height")),
        fov(s.value("fov")),
        rate(s.value("rate")),
        place{s.value("x"), s.value("y"), s.value("z")},
        turn{s.value("roll"), s.value("pitch"), s.value("yaw")},
        min_range(s.value("min_range")),
        max_range(s.value("max_range")),
        depth_noise(s.value("depth_noise")),
        noise(s.value("noise")),
        sun{s.value("sun_azimuth"), s.value("sun_elevation")},
        ambient(s.value("ambient")),
        fog(s.value("fog")),
        shadows(s.value("shadows")),
        self(static_cast<std::size_t>(s.param("robot"))),
        number(s.param("camera")),
        stream(s.stream("camera")),
        robots(s, description::Meshes::import),
        pose(s.read<Pose>("robot/*/pose")),
        wall(s.read<Wall>("wall/*/shape")),
        door(s.read<Door>("door/*/shape")),
        state(s.read<DoorState>("door/*/state")),
        mesh(s.read<MeshShape>("mesh/*/shape")),
        paint(s.read<Colouring>("material/*/colour")),
        image(s.write<Image>("image/{robot}/message", MUSTER_SENSED)) {
    for (std::size_t row = 1; row <= robots.size(); ++row) {
      models.push_back(model_text(s.host(), row - 1));
      const auto* robot = robots.of(static_cast<double>(row));
      if (!robot || bodies.count(robot)) continue;
      for (const description::Shape& shape : seen_of(*robot)) bodies[robot].push_back(facets_of(shape, body_colour));
    }
    read_meshes(s);
  }

  void step(const Step& k) {
    if (!is_due(k.time(), k.dt(), 1 / k[rate]) || !k.alive("robot", self)) return;
    for (std::size_t i = 0; i < lengths.size() && !view; ++i)
      warn_of_size(k, std::string(k.name("mesh", i)), lengths[i], k[mesh][i].scale, extent_of(k[pose]), "robots");
    if (!view || view->width() != static_cast<int>(k[width]) || view->height() != static_cast<int>(k[height]) ||
        fov_of_view != k[fov])
      view.emplace(static_cast<int>(k[width]), static_cast<int>(k[height]), fov_of_view = k[fov]);
    Light light;
    light.sun = {std::cos(k[sun[1]]) * std::cos(k[sun[0]]), std::cos(k[sun[1]]) * std::sin(k[sun[0]]),
                 std::sin(k[sun[1]])};
    light.ambient = k[ambient], light.fog = k[fog], light.shadows = k[shadows];
    std::vector<Facets> walls = walls_of(k);
    for (std::size_t i = 0; i < meshes.size(); ++i) meshes[i].colour = colour_of(k, k[mesh][i].material);
    view->look(frame_of(k[pose][self]) * mounting(k), scene(k, walls), light);
    send(k);
  }

 private:
  static constexpr Colour body_colour{0.3f, 0.38f, 0.5f};

  Isometry3d mounting(const Step& k) const {
    return Eigen::Translation3d(k[place[0]], k[place[1]], k[place[2]]) *
           Eigen::AngleAxisd(k[turn[2]], Vector3d::UnitZ()) * Eigen::AngleAxisd(k[turn[1]], Vector3d::UnitY()) *
           Eigen::AngleAxisd(k[turn[0]], Vector3d::UnitX());
  }

  Colour colour_of(const Step& k, double material) const {
    const Colouring& own = k[paint][static_cast<std::size_t>(material)];
    return {static_cast<float>(own.red), static_cast<float>(own.green), static_cast<float>(own.blue)};
  }

  std::vector<Facets> walls_of(const Step& k) const {
    std::vector<Facets> result;
    auto walls = scene_walls(k[wall]);
    auto doors = scene_doors(k[door], k[state], k[wall]);
    part_doors(walls, doors);
    for (const scene::Slab& slab : scene::slabs(walls, doors)) {
      description::Shape shape;
      shape.pose = Eigen::Translation3d(slab.x, slab.y, slab.z) *
                   Eigen::AngleAxisd(std::atan2(slab.sin_yaw, slab.cos_yaw), Vector3d::UnitZ());
      shape.geometry = description::Box{{slab.length, slab.thickness, slab.height}};
      result.push_back(facets_of(shape, colour_of(k, walls[static_cast<std::size_t>(slab.wall)].material)));
    }
    return result;
  }

  std::vector<Seen> scene(const Step& k, const std::vector<Facets>& walls) const {
    std::vector<Seen> result;
    for (const Facets& each : walls) result.push_back({&each, Isometry3d::Identity()});
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const MeshShape& at = k[mesh][i];
      Isometry3d frame = Eigen::Translation3d(at.x, at.y, at.z) * Eigen::AngleAxisd(at.yaw, Vector3d::UnitZ());
      frame.linear() *= at.scale;
      result.push_back({&meshes[i], frame});
    }
    for (std::size_t other = 0; other < k[pose].size(); ++other) {
      if (other == self || !k.alive("robot", other)) continue;
      const auto* robot = robots.of(model_of(k, other));
      if (!robot) continue;
      for (const Facets& each : bodies.at(robot)) result.push_back({&each, frame_of(k[pose][other])});
    }
    return result;
  }

  // Of a robot that joined as a copy: that of the first with the same description.
  double model_of(const Step& k, std::size_t robot) const {
    if (robot < models.size()) return static_cast<double>(robot + 1);
    const auto found = std::find(models.begin(), models.end(), model_text(k.host(), robot));
    return static_cast<double>(found - models.begin() + 1);
  }
  static std::string model_text(const muster_host* host, std::size_t robot) {
    const std::string of_row = std::string("robot/") + host->row_name(host, "robot", static_cast<uint32_t>(robot));
    std::string result;
    for (const char* attribute : {"/model", "/packages", "/fittings"}) {
      const char* text = host->text(host, (of_row + attribute).c_str());
      result += (text ? text : "") + std::string("\n");
    }
    return result;
  }

  void send(const Step& k) const {
    const std::size_t pixels = static_cast<std::size_t>(view->width()) * static_cast<std::size_t>(view->height());
    std::string depth(pixels * sizeof(float), '\0'), colour(pixels * 3, '\0');
    const Stream draws = stream.of(k.key("robot", self)).of(static_cast<uint64_t>(number));
    std::size_t i = 0;
    for (int y = 0; y < view->height(); ++y) {
      for (int x = 0; x < view->width(); ++x, ++i) {
        const float told = told_depth(k, draws, i, view->depth(x, y));
        std::memcpy(depth.data() + i * sizeof told, &told, sizeof told);
        const Colour seen = view->colour(x, y);
        const std::array<float, 3> parts{seen.red, seen.green, seen.blue};
        for (std::size_t c = 0; c < 3; ++c) colour[i * 3 + c] = told_colour(k, draws, i * 3 + c, parts[c]);
      }
    }
    Image& made = k.send(image, 0, depth);
    k.put_bytes(image, 0, Image::colour_column, colour);
    made.robot = static_cast<double>(self), made.camera = number, made.t = k.time();
    made.width = k[width], made.height = k[height], made.fov = k[fov];
  }

  float told_depth(const Step& k, const Stream& draws, std::size_t pixel, double depth) const {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    if (!k.expected() && k[depth_noise] > 0 && std::isfinite(depth))
      depth += k[depth_noise] * depth * depth * draws.of(0).normal(k.tick(), pixel);
    if (depth < k[min_range]) return -infinite;
    return depth > k[max_range] ? infinite : static_cast<float>(depth);
  }

  char told_colour(const Step& k, const Stream& draws, std::size_t part, float colour) const {
    double value = colour;
    if (!k.expected() && k[noise] > 0) value += k[noise] * draws.of(1).normal(k.tick(), part);
    constexpr double to_nearest = 0.5;  // lround() is a call, for every pixel
    return static_cast<char>(static_cast<unsigned char>(std::clamp(value, 0.0, 1.0) * 255 + to_nearest));
  }

  void read_meshes(const Setup& setup) {
    const muster_host* host = setup.host();
    const std::string folder = world_folder(host);
    for (uint32_t row = 0; row < host->rows(host, "mesh"); ++row) {
      const std::string name = host->row_name(host, "mesh", row), file = setup.text("mesh/" + name + "/file");
      description::Shape shape;
      try {
        shape.geometry = description::read_mesh(folder, file, Vector3d::Ones());
      } catch (const std::runtime_error& wrong) {
        throw BadInput("mesh \"" + name + "\": the file \"" + file + "\" " + wrong.what());
      }
      // What counts it for the radio warns itself.
      if (setup.text("world/radio.meshes/place").empty())
        lengths.push_back(description::bounds(shape).sizes().maxCoeff());
      meshes.push_back(facets_of(shape, {}));
      meshes.back().is_sheet = true;  // from a file: its faces may be turned either way
    }
  }

  Value width, height, fov, rate, place[3], turn[3], min_range, max_range, depth_noise, noise, sun[2], ambient, fog,
      shadows;
  std::size_t self;
  double number;
  Stream stream;
  WorldRobots robots;
  In<Pose> pose;
  In<Wall> wall;
  In<Door> door;
  In<DoorState> state;
  In<MeshShape> mesh;
  In<Colouring> paint;
  Out<Image> image;
  std::vector<std::string> models;  // of the robots of the world file
  std::map<const description::Robot*, std::vector<Facets>> bodies;
  std::vector<Facets> meshes;
  std::vector<double> lengths;  // of meshes [m]; none where another plugin tells of them
  std::optional<View> view;     // its memory is kept from picture to picture
  double fov_of_view = 0;
};

}  // namespace

MUSTER_PLUGIN_IS(SensorsCamera)
