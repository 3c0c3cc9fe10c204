#include "run_scene.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <muster/tables.hpp>
#include <sstream>

#include "description/mesh.hpp"
#include "robot_parts.hpp"

namespace muster::viewer {
namespace {

// A published table as rows, with the names of its set.
template <class Row>
struct NamedRows {
  NamedRows(const Simulation& run, const std::string& set, const std::string& quantity) {
    const Table* table = run.board().find(set + "/*/" + quantity);
    if (!table) return;
    const auto* first = reinterpret_cast<const Row*>(table->now().data.data());
    rows.assign(first, first + table->now().rows);
    names = table->set().names;
  }
  std::vector<Row> rows;
  std::vector<std::string> names;
};

std::string name_at(const Simulation& run, const char* set, double row) {
  const Set* found = run.board().find_set(set);
  return found && row >= 0 && row < static_cast<double>(found->names.size())
             ? found->names[static_cast<std::size_t>(row)]
             : "";
}

Json walls(const Simulation& run) {
  Json result = Json::array();
  const NamedRows<Wall> walls(run, "wall", "shape");
  for (std::size_t i = 0; i < walls.rows.size(); ++i) {
    const Wall& w = walls.rows[i];
    result.push_back({{"name", walls.names[i]},
                      {"from", std::vector<double>{w.x0, w.y0}},
                      {"to", std::vector<double>{w.x1, w.y1}},
                      {"base", w.base},
                      {"height", w.height},
                      {"thickness", w.thickness},
                      {"material", name_at(run, "material", w.material)}});
  }
  return result;
}

// As the world file has it, for a run in which no plugin reads how doors stand.
bool declared_open(const Simulation& run, const std::string& door) {
  for (const RowDeclaration& row : run.world().rows) {
    if (row.set != "door" || row.name != door) continue;
    for (const StoredValues& given : row.values)
      if (given.table == "door/state" && !given.values.empty()) return given.values[0] != 0;
  }
  return false;
}

Json doors(const Simulation& run) {
  Json result = Json::array();
  const NamedRows<Door> doors(run, "door", "shape");
  const NamedRows<DoorState> states(run, "door", "state");
  for (std::size_t i = 0; i < doors.rows.size(); ++i) {
    const Door& d = doors.rows[i];
    const bool open = i < states.rows.size() ? states.rows[i].open != 0 : declared_open(run, doors.names[i]);
    result.push_back({{"name", doors.names[i]},
                      {"wall", name_at(run, "wall", d.wall)},
                      {"at", d.at},
                      {"width", d.width},
                      {"height", d.height},
                      {"open", open}});
  }
  return result;
}

Json floors(const Simulation& run) {
  Json result = Json::array();
  const NamedRows<FloorShape> floors(run, "floor", "shape");
  for (std::size_t i = 0; i < floors.rows.size(); ++i) {
    const FloorShape& f = floors.rows[i];
    result.push_back({{"name", floors.names[i]},
                      {"corners", std::vector<double>{f.x0, f.y0, f.x1, f.y1, f.x2, f.y2, f.x3, f.y3}},
                      {"z", f.z}});
  }
  return result;
}

Json radios(const Simulation& run) {
  Json result = Json::array();
  const NamedRows<Mount> mounts(run, "radio", "mount");
  for (std::size_t i = 0; i < mounts.rows.size(); ++i) {
    const Mount& m = mounts.rows[i];
    const std::string robot = std::isnan(m.robot) ? "" : name_at(run, "robot", m.robot);
    result.push_back({{"name", mounts.names[i]},
                      {"robot", robot.empty() ? Json() : Json(robot)},
                      {"at", std::vector<double>{m.x, m.y, m.z}}});
  }
  return result;
}

std::string text_of(const Simulation& run, const std::string& path) {
  const auto found = run.world().texts.find(path);
  return found == run.world().texts.end() ? "" : found->second;
}

// The row that a robot's texts are of: its own, or that of which it joined as a copy.
std::string path_of(const Set& robots, std::size_t row) {
  std::size_t like = row;
  while (robots.like[like] != like && robots.like[like] < like) like = robots.like[like];
  return "robot/" + robots.names[like];
}

}  // namespace

RunScene::RunScene(const Simulation& run, std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {
  folders_.push_back(std::filesystem::absolute(run.world().file).parent_path());  // a world's own files come last
  fixed_ = Json{{"walls", walls(run)}, {"doors", doors(run)}, {"floors", floors(run)}, {"radios", radios(run)}};
  fixed_["meshes"] = meshes(run);
  for (const Pose& p : NamedRows<Pose>(run, "robot", "pose").rows)
    poses_.push_back({p.x, p.y, p.z, p.qw, p.qx, p.qy, p.qz});
}

// Placed as the world places them.
Json RunScene::meshes(const Simulation& run) {
  Json result = Json::array();
  const NamedRows<MeshShape> shapes(run, "mesh", "shape");
  for (std::size_t i = 0; i < shapes.rows.size(); ++i) {
    const MeshShape& shape = shapes.rows[i];
    const std::string file = text_of(run, "mesh/" + shapes.names[i] + "/file");
    try {
      auto mesh = description::read_mesh(folders_.back().string(), file, Eigen::Vector3d::Constant(shape.scale));
      const Eigen::Isometry3d place =
          Eigen::Translation3d(shape.x, shape.y, shape.z) * Eigen::AngleAxisd(shape.yaw, Eigen::Vector3d::UnitZ());
      for (auto& vertex : mesh.vertices) vertex = place * vertex;
      Json description{{"name", shapes.names[i]}};
      add_triangles(mesh, description);
      result.push_back(description);
    } catch (const std::runtime_error& wrong) {
      notes_.push_back("The mesh " + shapes.names[i] + " is not drawn: the file " + file + " " + wrong.what());
    }
  }
  return result;
}

void RunScene::add_model(const std::string& model, const description::UrdfSetting& declared) {
  if (model.empty() || models_.count(model)) return;
  Json& made = models_[model];
  std::vector<std::string> directories;
  for (const auto& folder : folders_) {
    directories.push_back(folder.string());
    directories.push_back((folder / "models").string());
  }
  try {
    made = parts_of(description::read_robot(description::find_model(model, directories), description::Meshes::visual,
                                            description::find_setting(declared, directories)));
    made["name"] = model;
  } catch (const std::runtime_error& wrong) {
    notes_.push_back("Robots of the model " + model + " are drawn as cylinders: " + wrong.what());
  }
}

Json RunScene::robots(const Simulation& run) {
  Json result = Json::array();
  const Set* set = run.board().find_set("robot");
  for (std::size_t row = 0; set && row < set->names.size(); ++row) {
    const std::string path = path_of(*set, row), model = text_of(run, path + "/model");
    add_model(model, {text_of(run, path + "/packages"), text_of(run, path + "/fittings")});
    result.push_back(
        {{"name", set->names[row]}, {"model", model}, {"pose", row < poses_.size() ? Json(poses_[row]) : Json()}});
  }
  return result;
}

Json RunScene::json(const Simulation& run) {
  Json result = fixed_;
  result["robots"] = robots(run);
  result["models"] = Json::array();
  for (const auto& [name, model] : models_) {
    if (!model.is_null()) result["models"].push_back(model);
  }
  return result;
}

Json chains_of(const Simulation& run) {
  Json result = Json::array();
  for (const auto& instance : run.instances()) {
    if (instance->declared().plugin != "observe.chain") continue;
    std::vector<std::string> names;
    for (const auto& attribute : instance->declared().attributes) {
      std::istringstream words(attribute.name == "chain" ? attribute.value : "");
      for (std::string word; words >> word;) names.push_back(word);
    }
    Json links = Json::array();
    for (std::size_t i = 1; i < names.size(); ++i) {
      std::string column = "rssi_" + names[i];
      std::replace_if(
          column.begin(), column.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
      links.push_back({{"from", names[i - 1]}, {"to", names[i]}, {"rssi", column}});
    }
    Json chain{{"table", "instance/" + instance->name() + "/chain"}, {"links", links}};
    if (const int threshold = instance->find_param("threshold"); threshold >= 0)
      chain["threshold"] = instance->params()[static_cast<std::size_t>(threshold)];
    result.push_back(chain);
  }
  return result;
}

}  // namespace muster::viewer
