#include "include_graph.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "source_tree.hpp"

namespace muster::test {
namespace {

namespace fs = std::filesystem;

struct Directive {
  std::string_view name{};
  bool quoted = false;
};

std::optional<Directive> directive_in(std::string_view line) {
  const auto skip_blanks = [&] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
  skip_blanks();
  for (const std::string_view word : {"#", "include"}) {
    if (!line.starts_with(word)) return {};
    line.remove_prefix(word.size());
    skip_blanks();
  }
  if (line.empty() || (line[0] != '"' && line[0] != '<')) return {};
  const bool quoted = line[0] == '"';
  const auto end = line.find(quoted ? '"' : '>', 1);
  if (end == line.npos) return {};
  return Directive{line.substr(1, end - 1), quoted};
}

std::optional<std::string> resolve(const fs::path& root, const std::string& from, const Directive& directive) {
  std::vector<fs::path> folders{"", "plugins", "plugin_api"};
  if (directive.quoted) folders.insert(folders.begin(), folder_of(from));
  for (const fs::path& folder : folders) {
    const fs::path candidate = (folder / directive.name).lexically_normal();
    if (fs::is_regular_file(root / candidate)) return candidate.generic_string();
  }
  return {};
}

void read_file(const fs::path& root, const TextFile& file, IncludeGraph& graph) {
  graph.files.push_back(file.path);
  int number = 0;
  for (std::size_t at = 0; at < file.text.size();) {
    const auto end = std::min(file.text.find('\n', at), file.text.size());
    const auto directive = directive_in(std::string_view(file.text).substr(at, end - at));
    at = end + 1;
    ++number;
    if (!directive) continue;
    if (auto to = resolve(root, file.path, *directive)) {
      graph.includes.push_back({file.path, number, *std::move(to)});
    } else if (directive->quoted) {
      graph.unresolved.push_back(file.path + ":" + std::to_string(number) + ": \"" + std::string(directive->name) +
                                 "\" is not beside the file, below the root, in plugins/ or in plugin_api/");
    }
  }
}

using Edges = std::map<std::string, std::map<std::string, const Include*>>;  // unit, included unit, one include of it

Edges edges_of(const IncludeGraph& graph) {
  Edges edges;
  for (const Include& include : graph.includes) {
    const std::string from = unit_of(include.from), to = unit_of(include.to);
    edges[to];
    if (from != to) edges[from].emplace(to, &include);
  }
  return edges;
}

class Tarjan {
 public:
  explicit Tarjan(const Edges& edges) : edges_(edges) {
    for (const auto& [unit, included] : edges_) {
      if (!index_.contains(unit)) visit(unit);
    }
  }
  const std::vector<std::set<std::string>>& components() const { return components_; }

 private:
  int visit(const std::string& unit) {
    const int index = static_cast<int>(index_.size());
    int lowest = index;
    index_[unit] = index;
    open_.push_back(unit);
    for (const auto& [next, include] : edges_.at(unit)) {
      if (const auto seen = index_.find(next); seen == index_.end())
        lowest = std::min(lowest, visit(next));
      else if (std::find(open_.begin(), open_.end(), next) != open_.end())
        lowest = std::min(lowest, seen->second);
    }
    if (lowest == index) {
      const auto first = std::find(open_.begin(), open_.end(), unit);
      components_.emplace_back(first, open_.end());
      open_.erase(first, open_.end());
    }
    return lowest;
  }

  const Edges& edges_;
  std::map<std::string, int> index_{};
  std::vector<std::string> open_{};
  std::vector<std::set<std::string>> components_{};
};

// A shortest walk from a unit back to itself inside its component, by breadth-first search.
std::vector<const Include*> walk_round(const Edges& edges, const std::set<std::string>& component) {
  const std::string& start = *component.begin();
  std::map<std::string, const Include*> reached_by;
  std::vector<std::string> queue{start};
  for (std::size_t next = 0; !reached_by.contains(start); ++next) {
    const std::string unit = queue.at(next);
    for (const auto& [included, include] : edges.at(unit)) {
      if (component.contains(included) && reached_by.emplace(included, include).second) queue.push_back(included);
    }
  }
  std::vector<const Include*> walk{reached_by.at(start)};
  while (unit_of(walk.back()->from) != start) walk.push_back(reached_by.at(unit_of(walk.back()->from)));
  std::reverse(walk.begin(), walk.end());
  return walk;
}

std::string message_of(const Edges& edges, std::set<std::string> component) {
  std::string message = std::to_string(component.size()) + " units include one another in a circle:";
  for (const Include* step : walk_round(edges, component)) {
    message += "\n  " + step->from + ":" + std::to_string(step->line) + " includes " + step->to;
    component.erase(unit_of(step->from));
  }
  for (const std::string& unit : component) message += "\n  and " + unit;
  return message + "\nmove what two of them share into a header below both";
}

}  // namespace

std::string unit_of(const std::string& file) {
  const auto dot = file.rfind('.');
  const auto slash = file.rfind('/');
  return dot == file.npos || (slash != file.npos && dot < slash) ? file : file.substr(0, dot);
}

IncludeGraph read_includes(const fs::path& root, const std::vector<std::string>& folders) {
  IncludeGraph graph;
  for (const TextFile& file : cpp_files(root, folders)) read_file(root, file, graph);
  return graph;
}

std::vector<std::string> circles(const IncludeGraph& graph, std::size_t largest) {
  const Edges edges = edges_of(graph);
  const Tarjan tarjan(edges);
  std::vector<std::string> messages;
  for (const auto& component : tarjan.components()) {
    if (component.size() > largest) messages.push_back(message_of(edges, component));
  }
  return messages;
}

}  // namespace muster::test
