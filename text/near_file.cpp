#include "text/near_file.hpp"

#include <algorithm>
#include <system_error>
#include <vector>

#include "text/names.hpp"

namespace muster {

namespace fs = std::filesystem;

namespace {

// The folders in this one that have a world.xml, as `the worlds "a/b", "a/c"`; "" if there are none.
std::string worlds_below(const fs::path& folder) {
  std::error_code failed;
  std::vector<std::string> found;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, failed), end; !failed && at != end;
       at.increment(failed)) {
    if (fs::exists(at->path() / "world.xml", failed)) found.push_back(quote(at->path().string()));
  }
  std::sort(found.begin(), found.end());
  return found.empty() ? "" : (found.size() == 1 ? "the world " : "the worlds ") + listed(found);
}

}  // namespace

std::string near_file(const fs::path& path) {
  constexpr std::size_t most_entries = 10'000;
  std::error_code failed;
  if (std::string text = path.string(); text.find('\\') != text.npos) {
    std::replace(text.begin(), text.end(), '\\', '/');
    if (fs::exists(text, failed)) return "; did you mean " + quote(text) + "?";
  }
  const fs::path folder = path.parent_path();
  std::vector<std::string> names;
  for (fs::directory_iterator at(folder.empty() ? "." : folder, failed), end; !failed && at != end;
       at.increment(failed)) {
    names.push_back(at->path().filename().string());
    if (names.size() > most_entries) return "";
  }
  std::sort(names.begin(), names.end());  // folders have no order of their own
  std::string near = nearest(path.filename().string(), names);
  if (near.empty() && path.filename() == "world.xml") {  // of a folder that was named: its only other world
    std::erase_if(names, [](const std::string& name) { return !name.ends_with(".xml"); });
    if (names.size() == 1) near = names[0];
    if (const std::string below = worlds_below(folder); !below.empty()) return "; it holds " + below;
  }
  return near.empty() ? "" : "; did you mean " + quote((folder / near).string()) + "?";
}

}  // namespace muster
