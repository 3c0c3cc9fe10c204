#include "diagnosis/pipeline/extended_world.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <fstream>

#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

std::string attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value ? value : "";
}

// The element that declares an instance ("radio.multiwall") or a row ("material/drywall"), or null.
XMLElement* element_of(XMLElement& root, const std::string& owner) {
  const auto slash = owner.find('/');
  for (XMLElement* e = root.FirstChildElement(); e; e = e->NextSiblingElement()) {
    const std::string name = attribute(*e, "name");
    if (slash != owner.npos ? name == owner.substr(slash + 1) && e->Name() == owner.substr(0, slash)
                            : name == owner || (name.empty() && e->Name() == owner))
      return e;
  }
  return nullptr;
}

std::string unused_name(XMLElement& root, const std::string& id) {
  const std::string stem = id.substr(id.find('.') + 1);
  for (int k = 1;; ++k) {
    std::string name = stem + "_" + std::to_string(k);
    if (!element_of(root, name)) return name;
  }
}

void write_file(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw Error(Exit::io, file.string() + ": cannot be written");
}

void add_cause(XMLElement& root, const CauseEstimate& cause, const fs::path& folder) {
  XMLElement* e = root.InsertNewChildElement(cause.id.c_str());
  const std::string own = unused_name(root, cause.id);
  e->SetAttribute("name", own.c_str());
  if (!cause.row.empty()) e->SetAttribute(cause.row_parameter.c_str(), cause.row.c_str());
  for (const auto& [name, word] : cause.words) e->SetAttribute(name.c_str(), word.c_str());
  for (const auto& [name, text] : cause.files) {
    e->SetAttribute(name.c_str(), (own + ".csv").c_str());
    write_file(folder / (own + ".csv"), text);
  }
  for (const auto& [name, value] : cause.held) e->SetAttribute(name.c_str(), print_real(value).c_str());
  for (const CauseValue& v : cause.values) e->SetAttribute(v.name.c_str(), print_real(v.value).c_str());
}

bool concerns(const CauseEstimate& cause, const std::string& name) {
  return cause.row == name ||
         std::any_of(cause.words.begin(), cause.words.end(), [&](const auto& word) { return word.second == name; });
}

// A mistake of the list of places is one in the order of all radios that stand.
bool is_about_the_list(const CauseEstimate& cause) {
  return std::count(cause.covariates.begin(), cause.covariates.end(), "map") > 0;
}

// Stations for radios of the data that a written cause refers to, in the order of the data and behind the world's own:
// the order in which they were numbered when the cause was found. Causes that refer to them follow.
void add_radios(XMLElement& root, const Diagnosis& found) {
  XMLElement* last = nullptr;
  for (XMLElement* e = root.FirstChildElement(); e; e = e->NextSiblingElement())
    if (const std::string kind = e->Name(); kind == "station" || kind == "robot" || kind == "radio") last = e;
  for (const AddedRadio& radio : found.added_radios) {
    if (std::none_of(found.causes.begin(), found.causes.end(), [&](const CauseEstimate& cause) {
          return cause.status == inference::Status::named &&
                 (concerns(cause, radio.name) || (radio.stands && is_about_the_list(cause)));
        }))
      continue;
    XMLElement* e = root.GetDocument()->NewElement("station");
    e->SetAttribute("name", radio.name.c_str());
    e->SetAttribute("at", (print_real(radio.x) + ' ' + print_real(radio.y) + ' ' + print_real(radio.z)).c_str());
    last ? root.InsertAfterChild(last, e) : root.InsertFirstChild(e);
    last = e;
  }
}

void copy_folder(const fs::path& from, const fs::path& to) {
  std::error_code failed;
  fs::create_directories(to, failed);
  for (const auto& entry : fs::directory_iterator(from)) {
    if (failed) break;
    if (entry.path().filename().string().starts_with('.')) continue;  // hidden: none of the world's
    if (entry.is_regular_file())
      fs::copy_file(entry.path(), to / entry.path().filename(), fs::copy_options::overwrite_existing, failed);
  }
  if (failed) throw Error(Exit::io, quote(to.string()) + " cannot be written: " + failed.message());
}

// What a world names by a path that its copy does not answer, such as a plan that worlds share or a model below the
// world's folder, is named by its whole path there. True if something is.
bool keep_paths(XMLElement& element, const fs::path& folder, const fs::path& copy) {
  bool changed = false;
  const auto keep = [&](const std::string& name, const fs::path& path) {
    std::error_code none;
    if (!fs::exists(path, none)) return false;
    element.SetAttribute(name.c_str(), fs::weakly_canonical(path).string().c_str());
    return changed = true;
  };
  std::vector<std::pair<std::string, std::string>> given;  // as attributes are changed on the way
  for (const auto* a = element.FirstAttribute(); a; a = a->Next()) given.emplace_back(a->Name(), a->Value());
  for (const auto& [name, value] : given) {
    std::error_code none;
    const fs::path path(value);
    if (value.empty() || path.is_absolute()) continue;
    // Above the folder of the copy lies what is none of the world's, whatever it is called.
    const bool is_copied = *path.lexically_normal().begin() != ".." && fs::exists(copy / path, none);
    if (is_copied && !fs::is_directory(copy / path, none)) continue;
    if (path.has_parent_path() || name == "packages") keep(name, folder / path);
    if (name == "model") keep(name, folder / "models" / path) || keep(name, folder / "models" / (value + ".urdf"));
  }
  for (XMLElement* e = element.FirstChildElement(); e; e = e->NextSiblingElement())
    changed |= keep_paths(*e, folder, copy);
  return changed;
}

void load(tinyxml2::XMLDocument& document, const fs::path& file) {
  if (document.LoadFile(file.string().c_str()) != tinyxml2::XML_SUCCESS)
    throw Error(Exit::io, file.string() + ": cannot be read again");
}

void save(tinyxml2::XMLDocument& document, const fs::path& file) {
  if (document.SaveFile(file.string().c_str()) != tinyxml2::XML_SUCCESS)
    throw Error(Exit::io, file.string() + ": cannot be written");
}

fs::path file_of(const fs::path& world) { return fs::is_directory(world) ? world / "world.xml" : world; }

fs::path folder_of(const fs::path& file) { return fs::absolute(file).parent_path(); }

bool is_same(const fs::path& one, const fs::path& other) {
  std::error_code none;
  return fs::equivalent(one, other, none);
}

}  // namespace

fs::path copy_world(const fs::path& world, const fs::path& out) {
  const fs::path file = file_of(world), folder = folder_of(file);
  fs::path written = out / file.filename();
  if (is_same(folder, out)) return written;
  copy_folder(folder, out);
  tinyxml2::XMLDocument document;
  load(document, file);
  if (keep_paths(*document.RootElement(), folder, out)) save(document, written);
  return written;
}

fs::path write_extended_world(const Diagnosis& found, const fs::path& world, const fs::path& out) {
  const fs::path file = file_of(world), folder = folder_of(file);
  if (is_same(folder, out))
    throw Error(Exit::invalid_input, quote(out.string()) + " holds the world itself; expected another folder");
  copy_folder(folder, out);
  tinyxml2::XMLDocument document;
  load(document, file);
  XMLElement& root = *document.RootElement();
  keep_paths(root, folder, out);
  for (const auto& [path, value] : found.parameters) {
    const auto slash = path.rfind('/');
    if (XMLElement* e = element_of(root, path.substr(0, slash)))
      e->SetAttribute(path.substr(slash + 1).c_str(), print_real(value).c_str());
  }
  add_radios(root, found);
  // Edits of places do not commute: what was found in a world put right for another stands after that.
  for (const bool first : {true, false}) {
    for (const CauseEstimate& cause : found.causes) {
      if (cause.status == inference::Status::named && cause.corrected_first == first) add_cause(root, cause, out);
    }
  }
  fs::path written = out / file.filename();
  if (document.SaveFile(written.string().c_str()) != tinyxml2::XML_SUCCESS)
    throw Error(Exit::io, written.string() + ": cannot be written");
  return written;
}

}  // namespace muster::diagnosis
