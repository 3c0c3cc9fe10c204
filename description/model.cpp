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

// The nearest name; all, where none is near.
std::string suggestion(const std::string& model, const std::vector<std::string>& names) {
  std::string near = nearest(model, names);
  if (!near.empty() || names.empty()) return near;
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "; expected one of " : ", ") + name;
  return all + ", or the path of a .urdf file";
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
    throw std::runtime_error("model '" + model + "' is xacro, not URDF; run xacro first: xacro " + model + " > " +
                             (fs::path(made).extension() == ".urdf" ? made : made + ".urdf"));
  }
  const bool is_path = is_path_of_a_file(model);
  const std::string file = is_path ? model : model + ".urdf";
  if (!is_path && model.find('/') != std::string::npos) {
    throw std::runtime_error("model '" + model + "' is neither a name nor a path to a .urdf file");
  }
  std::string tried;
  for (const std::string& directory : is_path ? own_first(directories) : directories) {
    const fs::path path = fs::path(directory) / file;  // an absolute file stays as it is
    std::error_code ignored;
    if (fs::exists(path, ignored)) return path.string();
    tried += (tried.empty() ? "" : ", ") + directory;
  }
  throw std::runtime_error("model '" + model + "' is not known: no " + file + " in " +
                           (tried.empty() ? "any directory" : tried) + suggestion(model, models_in(directories)));
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
  const auto find = [&](const std::string& path, const char* attribute, const char* what) -> std::string {
    if (path.empty()) return path;
    std::string tried;
    for (const std::string& directory : own_first(directories)) {
      std::error_code ignored;
      const fs::path here = fs::path(directory) / path;  // an absolute one stays as it is
      if (fs::exists(here, ignored)) return here.string();
      tried += (tried.empty() ? "" : ", ") + directory;
    }
    throw std::runtime_error(std::string(attribute) + "=\"" + path + "\": there is no such " + what + " in " + tried);
  };
  return {find(declared.packages, "packages", "folder"), find(declared.fittings, "fittings", "file")};
}

}  // namespace muster::description
