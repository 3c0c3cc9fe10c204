// The files that a world reads, and where they lie in its bundle. What lies in the world's folder keeps its place; what
// the world fetches from elsewhere goes to the folder outside/ in it, and the copy of the world says so.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace muster::bundle {

struct BundledFile {
  std::filesystem::path source;
  std::optional<std::string> text;  // in place of the source's bytes, where a path in it is another here
  std::string named;                // the path as the author wrote it, where the bundle has another
};

class WorldFiles {
 public:
  // `world` is the file. `plugins`: the folders in which plugins and models are looked for. Throws Error.
  WorldFiles(const std::filesystem::path& world, std::vector<std::filesystem::path> plugins);

  // What a <robot> names: its model, the folder of packages that it refers to, its fittings; each may be empty.
  void add_robot(const std::string& model, const std::string& packages, const std::string& fittings);
  void add_plugin(const std::filesystem::path& library);
  // A file that no XML names.
  void add_data(const std::filesystem::path& file);
  bool has(const std::filesystem::path& source) const;

  const std::filesystem::path& folder() const { return folder_; }  // of the world
  const std::string& world() const { return world_name_; }         // its file in the bundle
  // By their names in the bundle.
  const std::map<std::string, BundledFile>& files() const { return files_; }

 private:
  struct Edit;
  void add(const std::filesystem::path& source, const std::string& name, const std::string& named = "");
  void read_named_in(const std::filesystem::path& source, const std::string& name);
  std::string elsewhere(const std::filesystem::path& folder);
  std::string name_of(const std::filesystem::path& source);
  std::optional<std::filesystem::path> found(const std::string& given) const;

  std::filesystem::path folder_;  // the world's
  std::string world_name_, inside_, outside_;
  std::vector<std::filesystem::path> plugins_;
  std::map<std::filesystem::path, std::string> elsewhere_;  // folders outside of the world's
  std::filesystem::path packages_;                          // of the robot that is read
  std::map<std::string, BundledFile> files_;
};

}  // namespace muster::bundle
