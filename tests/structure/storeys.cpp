#include "storeys.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include "source_tree.hpp"

namespace muster::test {
namespace {

bool ends_in_star(std::string_view name) { return name.ends_with("/*"); }
std::string_view without_star(std::string_view name) { return name.substr(0, name.size() - 2); }

// The folder of `path` that the row "X/*" makes a room of; empty if there is none.
std::string starred_room(std::string_view star, std::string_view path) {
  const std::string_view parent = without_star(star);
  if (path.size() <= parent.size() || !lies_in(path, parent)) return {};
  const auto slash = path.find('/', parent.size() + 1);
  return slash == path.npos ? std::string() : std::string(path.substr(0, slash));
}

struct Room {
  std::string name{};
  const Storey* storey = nullptr;
};

// The narrowest room that holds a file; a row that names it comes before one with a star.
Room room_of(const std::string& path, const Storeys& storeys) {
  Room found;
  for (const Storey& storey : storeys) {
    const bool star = ends_in_star(storey.room);
    std::string name;
    if (star)
      name = starred_room(storey.room, path);
    else if (lies_in(path, storey.room) || unit_of(path) == storey.room)
      name = storey.room;
    if (name.empty() || name.size() < found.name.size() || (star && name == found.name)) continue;
    found = {std::move(name), &storey};
  }
  return found;
}

bool covers(const std::string& allowed, const Room& room) {
  if (ends_in_star(allowed)) return room.name.size() > allowed.size() - 2 && lies_in(room.name, without_star(allowed));
  return room.name == allowed;
}

// True of an entry that names a row, or one folder that a row with a star makes a room of.
bool names(const std::string& allowed, const Storey& storey) {
  return allowed == storey.room || covers(allowed, {storey.room, &storey}) ||
         (ends_in_star(storey.room) && starred_room(storey.room, allowed + '/') == allowed);
}

bool is_allowed(const Room& from, const Room& to) {
  const auto& allowed = from.storey->may_include;
  return from.name == to.name ||
         std::any_of(allowed.begin(), allowed.end(), [&](const std::string& a) { return covers(a, to); });
}

std::string list_of(const std::vector<std::string>& names) {
  std::string result;
  for (const std::string& name : names) result += (result.empty() ? "" : ", ") + name;
  return result.empty() ? "nothing" : result;
}

}  // namespace

std::vector<std::string> top_folders(const Storeys& storeys) {
  std::set<std::string> folders;
  for (const Storey& storey : storeys) folders.insert(storey.room.substr(0, storey.room.find('/')));
  return {folders.begin(), folders.end()};
}

std::vector<std::string> table_faults(const std::filesystem::path& root, const Storeys& storeys) {
  std::vector<std::string> faults;
  for (const Storey& storey : storeys) {
    const std::string folder(ends_in_star(storey.room) ? without_star(storey.room) : storey.room);
    // The tree must build without any one folder of plugins.
    if (!folder.starts_with("plugins/") && !is_directory(root / folder) && !exists(root / (folder + ".hpp")))
      faults.push_back(storey.room + ": there is no such folder or unit");
    for (const std::string& allowed : storey.may_include) {
      bool is_known = false;
      bool is_below = true;
      for (const Storey& other : storeys) {
        if (!names(allowed, other)) continue;
        is_known = true;
        is_below = is_below && &other < &storey;
      }
      if (!is_known)
        faults.push_back(storey.room + ": may include " + allowed + ", which is no room of the table");
      else if (!is_below)
        faults.push_back(storey.room + ": may include " + allowed + ", which does not lie below it");
    }
  }
  return faults;
}

std::vector<std::string> homeless_folders(const IncludeGraph& graph, const Storeys& storeys) {
  std::set<std::string> folders;
  for (const std::string& file : graph.files) {
    if (!room_of(file, storeys).storey) folders.insert(folder_of(file));
  }
  return {folders.begin(), folders.end()};
}

std::vector<std::string> upward_includes(const IncludeGraph& graph, const Storeys& storeys) {
  std::vector<std::string> faults;
  for (const Include& include : graph.includes) {
    const Room from = room_of(include.from, storeys), to = room_of(include.to, storeys);
    if (!from.storey || (to.storey && is_allowed(from, to))) continue;
    faults.push_back(include.from + ":" + std::to_string(include.line) + ": " + from.name + " includes " +
                     (to.storey ? to.name : "what has no storey") + " (" + include.to + "); it may include " +
                     list_of(from.storey->may_include));
  }
  return faults;
}

}  // namespace muster::test
