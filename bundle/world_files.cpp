#include "world_files.hpp"

#include <algorithm>
#include <functional>
#include <set>

#include "text/error.hpp"
#include "text/text_file.hpp"
#include "text/xml.hpp"

namespace muster::bundle {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_of_xml_file = 16 << 20;
constexpr std::string_view of_package = "package://";

bool is_file(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none);
}
bool is_folder(const fs::path& path) {
  std::error_code none;
  return fs::is_directory(path, none);
}

// Without a last '/', so that its last part is its name.
fs::path plain(const fs::path& path) {
  const fs::path result = fs::absolute(path).lexically_normal();
  return result.has_filename() ? result : result.parent_path();
}

// Where it is below the folder: its path from there.
std::optional<std::string> below(const fs::path& folder, const fs::path& path) {
  const fs::path result = path.lexically_relative(folder);
  if (result.empty() || *result.begin() == "..") return {};
  return result.generic_string();
}

std::string joined(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).lexically_normal().generic_string();
}

// The byte at that line and character.
std::size_t offset_of(const std::string& text, const Place& place) {
  std::size_t at = 0;
  for (int line = 1; line < place.line; ++line) at = text.find('\n', at) + 1;
  for (int column = 1; column < place.column; ++column) do
      ++at;
    while (at < text.size() && (text[at] & 0xC0) == 0x80);
  return at;
}

}  // namespace

// A value in an XML file that is another in the bundle.
struct WorldFiles::Edit {
  Place place;  // of the value
  std::string value;
};

WorldFiles::WorldFiles(const fs::path& world, std::vector<fs::path> plugins) : folder_(plain(world).parent_path()) {
  for (const fs::path& folder : plugins) plugins_.push_back(plain(folder));
  const std::string name = folder_.filename().string();
  inside_ = "world/" + (name.empty() || name == "/" ? std::string("world") : name);
  outside_ = "outside";
  while (fs::exists(folder_ / outside_)) outside_ += '_';
  world_name_ = inside_ + '/' + world.filename().string();
  add(plain(world), world_name_);
}

// A folder of its name below outside/, or below a number where another has that name already: the last part of a path
// stays, for a ROS package is known by it.
std::string WorldFiles::elsewhere(const fs::path& folder) {
  if (const auto known = elsewhere_.find(folder); known != elsewhere_.end()) return known->second;
  const std::string last = folder.has_filename() ? folder.filename().string() : std::string("root");
  const auto is_taken = [&](const std::string& name) {
    return std::any_of(elsewhere_.begin(), elsewhere_.end(), [&](const auto& one) { return one.second == name; });
  };
  std::string name = inside_ + '/' + outside_ + '/' + last;
  for (int number = 2; is_taken(name); ++number)
    name = inside_ + '/' + outside_ + '/' + std::to_string(number) + '/' + last;
  return elsewhere_[folder] = name;
}

std::string WorldFiles::name_of(const fs::path& source) {
  if (const auto inside = below(folder_, source)) return joined(inside_, *inside);
  for (const fs::path& folder : plugins_)
    if (const auto inside = below(folder, source)) return joined("plugins", *inside);
  return joined(elsewhere(source.parent_path()), source.filename().string());
}

void WorldFiles::add(const fs::path& source, const std::string& name, const std::string& named) {
  const auto [at, is_new] = files_.try_emplace(name, BundledFile{source, {}, named});
  if (!is_new) return;
  static const std::set<std::string> readable{".xml", ".urdf"};
  if (readable.count(source.extension().string())) read_named_in(source, name);
}

// Each attribute that names a file there is, from the file's own folder, or from the folders of meshes and packages.
void WorldFiles::read_named_in(const fs::path& source, const std::string& name) {
  const fs::path folder = source.parent_path();
  const std::string own = fs::path(name).parent_path().generic_string();
  std::vector<Edit> edits;
  std::string meshes;
  const auto take = [&](const XmlAttribute& given) {
    if (given.value.empty() || given.value.size() > 4096) return;
    if (given.name == "meshdir") meshes = given.value;
    if (given.value.starts_with(of_package)) {
      const std::string rest = given.value.substr(of_package.size());
      const std::string package = rest.substr(0, rest.find('/'));
      fs::path root = packages_;
      if (!root.empty() && !is_folder(root / package) && root.filename() == package) root = root.parent_path();
      const fs::path file = (root / rest).lexically_normal();
      if (root.empty() || !is_file(file) || !below(root, file)) return;
      const bool is_itself = root != packages_;
      const std::string base =
          below(folder_, packages_) ? joined(inside_, *below(folder_, packages_)) : elsewhere(packages_);
      add(file, is_itself ? joined(fs::path(base).parent_path().generic_string(), rest) : joined(base, rest));
      return;
    }
    for (const std::string& from : {std::string(), meshes}) {
      const fs::path file = (folder / from / given.value).lexically_normal();
      if (!is_file(file)) continue;
      const std::string kept = joined(from, given.value);
      if (!fs::path(given.value).is_absolute() && !kept.starts_with("../")) return add(file, joined(own, kept));
      const std::string to = name_of(file);
      const std::string value = fs::path(to).lexically_relative(own).generic_string();
      if (value != given.value) edits.push_back({given.value_place, value});
      return add(file, to, given.value);
    }
  };
  // The folder of a robot's packages, which is no file.
  const auto take_packages = [&](const XmlAttribute& given) {
    const fs::path packages = plain(folder / given.value);
    if (given.value.empty() || !is_folder(packages)) return;
    const auto inside = below(folder_, packages);
    if (inside && !fs::path(given.value).is_absolute() && !joined("", given.value).starts_with("../")) return;
    const std::string to = inside ? joined(inside_, *inside) : elsewhere(packages);
    const std::string value = fs::path(to).lexically_relative(own).generic_string();
    if (value != given.value) edits.push_back({given.value_place, value});
  };
  const std::function<void(const XmlElement&)> look = [&](const XmlElement& element) {
    for (const XmlAttribute& given : element.attributes)
      element.name == "robot" && given.name == "packages" ? take_packages(given) : take(given);
    for (const XmlElement& child : element.children) look(child);
  };
  try {
    look(read_xml(source));
  } catch (const Error&) {
    if (name == world_name_) throw;
    return;  // whoever reads it tells
  }
  if (edits.empty()) return;
  std::string text = read_text_file(source, most_of_xml_file).text;
  std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) {
    return std::pair(a.place.line, a.place.column) > std::pair(b.place.line, b.place.column);
  });
  for (const Edit& edit : edits) {
    const std::size_t at = offset_of(text, edit.place);
    text.replace(at, text.find(text.at(at - 1), at) - at, xml_escaped(edit.value));
  }
  files_[name].text = std::move(text);
}

// As robots' files are found: in the folders of plugins, then in the world's own.
std::optional<fs::path> WorldFiles::found(const std::string& given) const {
  if (given.empty()) return {};
  auto folders = plugins_;
  folders.push_back(folder_);
  for (const fs::path& folder : folders)
    for (const fs::path& path : {folder / given, folder / "models" / given})
      if (is_file(path)) return path.lexically_normal();
  return {};
}

void WorldFiles::add_robot(const std::string& model, const std::string& packages, const std::string& fittings) {
  packages_ = packages.empty() ? fs::path() : plain(folder_ / packages);
  const bool is_path = fs::path(model).extension() == ".urdf" || fs::path(model).extension() == ".xml";
  if (const auto file = found(is_path || model.empty() ? model : model + ".urdf")) {
    const std::string name = name_of(*file);
    add(*file, name);
    read_named_in(*file, name);  // it may be known, but with another folder of packages
  }
  if (const auto file = found(fittings)) add(*file, name_of(*file));
  packages_.clear();
}

void WorldFiles::add_plugin(const fs::path& library) {
  files_.try_emplace("plugins/" + library.filename().string(), BundledFile{plain(library), {}, ""});
}

void WorldFiles::add_data(const fs::path& file) {
  if (!is_file(file)) throw Error(Exit::invalid_input, "--data: " + file.string() + " is no file; expected one");
  add(plain(file), name_of(plain(file)));
}

bool WorldFiles::has(const fs::path& source) const {
  const fs::path wanted = plain(source);
  return std::any_of(files_.begin(), files_.end(), [&](const auto& one) { return one.second.source == wanted; });
}

}  // namespace muster::bundle
