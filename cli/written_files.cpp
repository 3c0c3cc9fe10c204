#include "written_files.hpp"

#include <functional>

#include "text/error.hpp"
#include "text/xml.hpp"
#include "viewer/record_folder.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;

bool same(const fs::path& one, const fs::path& other) {
  std::error_code none;
  if (fs::equivalent(one, other, none)) return true;
  return fs::weakly_canonical(fs::absolute(one), none) == fs::weakly_canonical(fs::absolute(other), none);
}

// Where an attribute of the world names this file: "path of world.xml:9:54"; empty if none does. What is wrong with
// the world is told by its reader.
std::string named_in(const fs::path& world, const fs::path& file) try {
  std::string found;
  const std::function<void(const XmlElement&)> look = [&](const XmlElement& element) {
    for (const XmlAttribute& given : element.attributes) {
      std::error_code none;
      if (found.empty() && !given.value.empty() && fs::equivalent(world.parent_path() / given.value, file, none))
        found = given.name + " of " + given.value_place.text();
    }
    for (const XmlElement& child : element.children) look(child);
  };
  look(read_xml(world));
  return found;
} catch (const Error&) {
  return {};
}

}  // namespace

void WrittenFiles::reads(const fs::path& file, const std::string& as) {
  if (!file.empty()) read_.emplace_back(file, as);
}

void WrittenFiles::reads_world(const fs::path& world) {
  std::error_code none;
  worlds_.push_back(fs::is_directory(world, none) ? world / "world.xml" : world);
  reads(worlds_.back(), "the world");
}

void WrittenFiles::writes(const fs::path& file, const std::string& option) {
  if (file.empty()) return;
  const auto refuse = [&](const std::string& what) {
    throw Error(Exit::invalid_input,
                option + ": " + file.string() + " is " + what + "; expected another file to write");
  };
  std::error_code none;
  if (fs::is_directory(file, none)) refuse("a folder");
  for (const auto& [other, as] : written_)
    if (same(file, other)) refuse("written by this command already (" + as + ")");
  written_.emplace_back(file, option);
  if (!fs::exists(file, none)) return;
  if (!fs::is_regular_file(file, none)) refuse("a device or a pipe, which a file would take the place of");
  for (const auto& [other, as] : read_)
    if (same(file, other)) refuse("read by this command (" + as + ")");
  for (const fs::path& world : worlds_)
    if (const std::string where = named_in(world, file); !where.empty()) refuse("read by this command (" + where + ")");
}

void WrittenFiles::writes_folder(const fs::path& folder, const std::string& option, const std::string& of_file) {
  std::error_code none;
  if (fs::exists(folder, none) && !fs::is_directory(folder, none))
    throw Error(Exit::invalid_input, option + ": " + folder.string() + " is a file; expected a folder");
  for (const char* ending : {".csv", ".mcap", ".json", ".html", ".xml", ".svg", ".png"}) {
    if (folder.extension() == ending && !fs::exists(folder, none))
      throw Error(
          Exit::invalid_input,
          option + ": " + folder.string() + " is called like a file, and a folder is made; expected " + option + ' ' +
              folder.stem().string() +
              (of_file.empty() ? ""
                               : ", or " + of_file + ' ' + folder.string() + " for what is recorded, in one file"));
  }
}

void WrittenFiles::replaces_no_record(const fs::path& folder, const std::string& option) {
  std::error_code none;
  bool has_record = fs::exists(folder / viewer::run_file, none);
  for (const auto& entry : fs::directory_iterator(folder, none))
    has_record |= entry.path().string().ends_with(".csv.part");
  if (has_record)
    throw Error(Exit::invalid_input, option + ": " + folder.string() +
                                         " has the record of a run, which that of a run that goes on would replace; "
                                         "expected another folder");
}

}  // namespace muster::cli
