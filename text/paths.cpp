#include "paths.hpp"

#include <algorithm>

#include "names.hpp"

namespace muster {

std::string no_file(const std::filesystem::path& path) {
  std::string turned = path.string();
  std::replace(turned.begin(), turned.end(), '\\', '/');
  const bool is_meant = turned != path.string() && std::filesystem::exists(turned);
  return "there is no file " + quote(path.string()) + (is_meant ? "; did you mean " + quote(turned) + "?" : "");
}

}  // namespace muster
