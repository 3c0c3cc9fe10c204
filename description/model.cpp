#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "description/file_text.hpp"
#include "description/robot.hpp"

namespace muster::description {

namespace fs = std::filesystem;

namespace {

// Names of the models in the directories, for the message.
std::vector<std::string> models_in(const std::vector<std::string>& directories) {
  std::vector<std::string> names;
  for (const std::string& directory : directories) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(directory, ignored)) {
      if (entry.path().extension() == ".urdf") names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

// Robots of others, by words of their names, and the model that is most like them.
struct Alike {
  const char *foreign, *here;
};
constexpr Alike alike[] = {{"burger", "waffle"},     {"turtlebot", "waffle"},      {"turtlebot2", "waffle"},
                           {"turtlebot3", "waffle"}, {"turtlebot4", "waffle"},     {"jackal", "husky"},
                           {"pioneer3at", "husky"},  {"warthog", "husky"},         {"iris", "hummingbird"},
                           {"x500", "hummingbird"},  {"quadrotor", "hummingbird"}, {"drone", "hummingbird"},
                           {"racecar", "f1tenth"},   {"hexapod", "rdk"},           {"rhex", "rdk"},
                           {"box", "crate"},         {"diffbot", "scarab"},        {"pioneer2dx", "scarab"}};

// The model that is a word of the name, as "husky" of "husky_a200", or that is like it; "" where there is none.
std::string by_word(const std::string& model, const std::vector<std::string>& names) {
  const auto is_there = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<std::string> words;
  for (std::size_t from = 0, to = 0; from <= model.size(); from = to + 1) {
    to = std::min(model.find_first_of("_-./: ", from), model.size());
    words.push_back(model.substr(from, to - from));
  }
  for (const std::string& word : words)
    if (is_there(word)) return word;
  for (const std::string& word : words) {
    for (const auto& [foreign, here] : alike)
      if (word == foreign && is_there(here)) return here;
  }
  return "";
}

// The nearest by sense or by letters, and all.
std::string suggestion(const std::string& model, const std::vector<std::string>& names) {
  const std::string like = by_word(model, names);
  const std::string near = like.empty() ? nearest(model, names) : "; did you mean \"" + like + "\"?";
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "one of " : ", ") + name;
  return near + (near.empty() ? "; expected " : " expected ") +
         (all.empty() ? "a URDF file" : all + ", or a URDF file") + ", such as \"" +
         fs::path(model).filename().string() + ".urdf\"";
}

// Kinds of files that are no description here, by their ends.
std::string of_other_kind(const std::string& model) {
  const std::string end = fs::path(model).extension().string();
  if (end == ".sdf" || end == ".world") return "SDF";
  if (end == ".usd" || end == ".usda" || end == ".usdz") return "USD";
  if (end == ".proto" || end == ".wbt") return "a file of Webots";
  if (end == ".stl" || end == ".dae" || end == ".obj" || end == ".glb") return "a mesh";
  return "";
}

// The same directories with those of the world's folder first, which come last: a folder and its "models" stay
// together.
std::vector<std::string> own_first(const std::vector<std::string>& directories) {
  std::vector<std::string> result;
  for (auto at = directories.rbegin(); at != directories.rend(); ++at) {
    const bool is_models = at + 1 != directories.rend() && *at == *(at + 1) + "/models";
    if (is_models) result.push_back(*(at + 1));
    result.push_back(*at);
    if (is_models) ++at;
  }
  return result;
}

bool is_path_of_a_file(const std::string& model) {
  const std::string kind = fs::path(model).extension().string();
  return kind == ".urdf" || kind == ".xml";  // MJCF
}

}  // namespace

std::string find_model(const std::string& model, const std::vector<std::string>& directories) {
  if (fs::path(model).extension() == ".xacro") {
    const std::string made = fs::path(model).stem().string();
    throw std::runtime_error(model + " is xacro, not URDF; run xacro first: xacro " + model + " > " +
                             (fs::path(made).extension() == ".urdf" ? made : made + ".urdf"));
  }
  const bool is_path = is_path_of_a_file(model);
  const std::string file = is_path ? model : model + ".urdf";
  if (const std::string kind = of_other_kind(model); !kind.empty())
    throw std::runtime_error(
        model + " is " + kind + ", which muster does not read as a robot; expected URDF or MJCF" +
        (kind == "a mesh" ? ", in which a mesh may be a shape"
         : kind == "SDF"
             ? ": the URDF or xacro that it was made from (gz sdf -p makes SDF of URDF, and does not go back)"
             : ": the one that it was made from, or that its program exports"));
  if (!is_path && model.find('/') != std::string::npos) {
    throw std::runtime_error("\"" + model + "\" is neither a name nor the path of a .urdf file" +
                             suggestion(model, models_in(directories)));
  }
  std::string tried;
  for (const std::string& directory : is_path ? own_first(directories) : directories) {
    const fs::path path = fs::path(directory) / file;  // an absolute file stays as it is
    std::error_code ignored;
    if (fs::exists(path, ignored)) return path.string();
    tried += (tried.empty() ? "" : ", ") + directory;
  }
  for (const std::string& directory : directories) {
    std::error_code ignored;
    if (!is_path && fs::is_regular_file(fs::path(directory) / model, ignored))
      throw std::runtime_error(model +
                               " is no name of a robot's file; expected one that ends in .urdf, or in .xml for a "
                               "MuJoCo model (MJCF): \"" +
                               fs::path(model).stem().string() + ".xml\"");
  }
  if (!is_path)
    throw std::runtime_error("there is no model \"" + model + "\"" + suggestion(model, models_in(directories)));
  throw std::runtime_error("there is no file " + file + " in " + (tried.empty() ? "any folder" : tried) +
                           suggestion(fs::path(model).stem().string(), models_in(directories)));
}

std::string doubt_of_model(const std::string& model, const std::vector<std::string>& directories) {
  if (is_path_of_a_file(model)) return "";
  std::string first;
  std::error_code ignored;
  for (const std::string& directory : directories) {
    const std::string path = (fs::path(directory) / (model + ".urdf")).string();
    if (!fs::exists(path, ignored)) continue;
    if (first.empty()) first = path;
    if (path == first || fs::equivalent(path, first, ignored)) continue;
    return "model=\"" + model + "\" is " + first + "; the file " + path + " is not read; expected model=\"" + model +
           ".urdf\" where that is meant";
  }
  return "";
}

UrdfSetting find_setting(const UrdfSetting& declared, const std::vector<std::string>& directories) {
  const auto find = [&](const std::string& path, const char* what) -> std::string {
    if (path.empty()) return path;
    std::string tried;
    for (const std::string& directory : own_first(directories)) {
      std::error_code ignored;
      const fs::path here = fs::path(directory) / path;  // an absolute one stays as it is
      if (fs::exists(here, ignored)) return here.string();
      tried += (tried.empty() ? "" : ", ") + directory;
    }
    throw std::runtime_error("there is no " + std::string(what) + " " + path + " in " + tried);
  };
  return {find(declared.packages, "folder"), find(declared.fittings, "file")};
}

std::vector<std::string> models_with(const std::string& word, const std::vector<std::string>& directories) {
  constexpr std::size_t most_bytes = 1u << 20;
  std::vector<std::string> result;
  for (const std::string& name : models_in(directories)) {
    for (const std::string& directory : directories) {
      const fs::path path = fs::path(directory) / (name + ".urdf");
      std::error_code ignored;
      if (!fs::exists(path, ignored) || fs::file_size(path, ignored) > most_bytes) continue;
      if (read_file(path.string(), most_bytes).find(word) != std::string::npos) result.push_back(name);
      break;
    }
  }
  return result;
}

}  // namespace muster::description
