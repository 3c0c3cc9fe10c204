#include "simulation.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <sstream>

#include "carriers.hpp"
#include "clip_doubts.hpp"
#include "isolated_step.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/kinds.hpp"

namespace muster {

Simulation::Simulation(World world, const Standard& standard, Options options)
    : world_(std::move(world)), standard_(standard), options_(std::move(options)) {
  auto folders = options_.search_path;
  folders.push_back(std::filesystem::absolute(world_.file).parent_path());  // a world's own files come last
  around_ = {&standard_, &world_, &board_, std::move(folders), world_.seed, {}, nullptr};
  for (const auto& set : standard_.sets) {
    if (!set.on_demand) board_.add_set(set.name, set.kind, set.owner);
  }
  for (const auto& row : world_.rows) {
    for (const auto& name : row.sets) {
      Set& set = *board_.find_set(name);
      set.add(row.name);
      if (row.joins_later) set.alive.back() = 0;
    }
  }
  for (const auto& warning : world_.warnings)
    events_.push_back({0, "", "warning: " + warning.place.text() + ": " + warning.message});
  around_.tables = options_.tables ? options_.tables : std::make_shared<TableCache>();
  around_.isolated = options_.isolated;
  for (const auto& library : options_.libraries) share(library);
  loader_ = std::make_unique<LibraryLoader>(options_.search_path);
  for (const auto& declaration : options_.more) instances_.push_back(make(declaration));
  for (const auto& declaration : world_.instances) instances_.push_back(make(declaration));
  for (const auto& occasion : world_.occasions) {
    for (const auto& change : occasion.plugins)
      if (change.kind != PluginChange::Kind::remove) planned_.push_back(library_of(change.plugin));
  }
  add_providers();
  loader_.reset();
  check_isolated();
  if (options_.workers > 1) workers_ = std::make_unique<ThreadPool>(options_.workers);
  around_.workers = workers_.get();
  relink();
  std::set<std::string> told;  // once what several plugins say of one file: each reads a robot's description itself
  for (const auto& instance : instances_)
    std::erase_if(instance->events, [&](const std::string& message) { return !told.insert(message).second; });
  compare_carriers(instances_, [this](const std::string& warning) { note(warning); });
  run(0, MUSTER_SENSE, MUSTER_SENSE, 0);
  rehearse();
  look_at_conditions();
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (held_[i])
      note("warning: " + world_.occasions[i].place.text() + ": it holds from the start that " +
           world_.occasions[i].when->text + ", and so begins only when it has ceased to");
  }
}

Simulation::~Simulation() = default;

// All named are instances, now or by what the world plans. Throws Error.
void Simulation::check_isolated() const {
  std::vector<std::string> names;
  for (const auto& instance : instances_) names.push_back(instance->name());
  for (const auto& occasion : world_.occasions)
    for (const auto& change : occasion.plugins) names.push_back(change.instance);
  for (const auto& [name, how] : options_.isolated) {
    if (name != "*" && std::find(names.begin(), names.end(), name) == names.end())
      throw Error(Exit::invalid_input, "no instance is called " + quote(name) + which_is(world_, name, "instance") +
                                           "; " + suggest(name, names) +
                                           plugin_hint(name, whose_plugin(world_.instances, name)));
  }
}

std::string library_key(const InstanceDeclaration& declaration) {
  return declaration.plugin + (declaration.library ? ' ' + declaration.library->string() : "");
}

// One library serves all instances of a plugin.
std::shared_ptr<Library> Simulation::library_of(const InstanceDeclaration& declaration) {
  auto library = libraries_[library_key(declaration)].lock();
  return library ? library : load_library(declaration);
}

std::shared_ptr<Library> Simulation::load_library(const InstanceDeclaration& declaration) {
  const auto& plugin = declaration.plugin;
  const auto& where = declaration.place;
  auto library = loader_ ? loader_->load(plugin, declaration.library, where)
                         : Library::load(plugin, declaration.library, options_.search_path, where);
  libraries_[library_key(declaration)] = library;
  return library;
}

std::unique_ptr<Instance> Simulation::make(InstanceDeclaration declaration) {
  auto library = library_of(declaration);
  return make(std::move(declaration), std::move(library));
}

std::unique_ptr<Instance> Simulation::make(InstanceDeclaration declaration, std::shared_ptr<Library> library) {
  auto made = std::make_unique<Instance>(std::move(declaration), std::move(library), around_);
  if (made->isolation()) made->step_elsewhere(std::make_unique<IsolatedStep>(*made, around_));
  return made;
}

namespace {

// `: physics.ode, physics.planar`, the plugins in the folders that begin with the same word; "" where there are none.
std::string like_of(const std::string& plugin, const Library::SearchPath& folders) {
  const std::string kind = plugin.substr(0, plugin.find('.')), begin = kind + '_';
  std::set<std::string> found;
  for (const auto& folder : folders) {
    std::error_code none;
    for (const auto& file : std::filesystem::directory_iterator(folder, none)) {
      const std::string name = file.path().stem().string();
      if (file.path().extension() == ".so" && name.starts_with(begin))
        found.insert(kind + '.' + name.substr(begin.size()));
    }
  }
  return found.empty() ? "" : ": " + listed({found.begin(), found.end()});
}

}  // namespace

// What the world file plans to insert and to swap in, to be looked at.
std::vector<std::unique_ptr<Instance>> Simulation::make_planned() {
  std::vector<std::unique_ptr<Instance>> made;
  for (const auto& occasion : world_.occasions) {
    for (const auto& change : occasion.plugins) {
      if (change.kind == PluginChange::Kind::remove) continue;
      InstanceDeclaration declared = change.plugin;
      declared.name = change.instance;
      try {
        made.push_back(make(declared));
      } catch (const Error&) {  // of a plugin of another kind, its attributes are not what is wrong
        const auto now = std::find_if(instances_.begin(), instances_.end(),
                                      [&](const auto& each) { return each->name() == change.instance; });
        const uint32_t phase = library_of(declared)->plugins().back().phase;
        if (change.kind != PluginChange::Kind::swap || now == instances_.end() || (*now)->phase() == phase) throw;
        throw invalid(declared.place, quote(change.instance) + " is of the phase " + phase_name((*now)->phase()) +
                                          ", and " + declared.plugin + " of " + phase_name(phase) +
                                          "; expected a plugin of " + phase_name((*now)->phase()) +
                                          like_of((*now)->declared().plugin, around_.search_path));
      }
    }
  }
  return made;
}

// Adds the declared provider of each standard quantity that is read but has no writer, as if the world file named it;
// also for what joins later.
void Simulation::add_providers() {
  while (true) {
    const auto mark = board_.mark();
    auto planned = make_planned();
    std::vector<Instance*> all;
    for (const auto& instance : instances_) all.push_back(instance.get());
    for (const auto& instance : planned) all.push_back(instance.get());
    auto missing = Linker(all, standard_, world_, board_).missing_providers();
    promised_.clear();
    for (const Instance* instance : all) {
      const bool is_there =
          std::any_of(instances_.begin(), instances_.end(), [&](const auto& i) { return i.get() == instance; });
      if (is_there && !is_to_be_removed(instance->name())) continue;
      for (const Claim& claim : instance->claims())
        if (!claim.file && claim.kind != MUSTER_READ) promised_.insert(claim.name.logical());
    }
    std::erase_if(missing, [&](const Linker::Missing& m) {
      return std::any_of(all.begin(), all.end(), [&](const Instance* i) { return i->declared().plugin == m.plugin; });
    });
    if (!planned.empty()) {
      planned.clear();
      board_.back_to(mark);
    }
    if (missing.empty()) return;
    for (const auto& [plugin, at, by] : missing)
      instances_.push_back(make({plugin, plugin, 1, {}, {}, {}, {world_.file.string()}, false, at, by}));
  }
}

bool Simulation::is_to_be_removed(const std::string& instance) const {
  return std::any_of(world_.occasions.begin(), world_.occasions.end(), [&](const Occasion& occasion) {
    return std::any_of(occasion.plugins.begin(), occasion.plugins.end(), [&](const PluginChange& change) {
      return change.kind == PluginChange::Kind::remove && change.instance == instance;
    });
  });
}

void Simulation::relink() {
  stood_.clear();
  std::vector<Instance*> all;
  for (const auto& instance : instances_) all.push_back(instance.get());
  Linker linker(all, standard_, world_, board_);
  linker.promise(promised_);
  linker.check();
  batches_ = linker.build();
  for (const auto& instance : instances_) instance->start_anew_elsewhere();
  for (const auto& table : linker.dropped())
    events_.push_back({tick_, "",
                       linker.is_given(table) ? "nobody reads " + table + " any more, which the world gives"
                                              : "dropped " + table + ", which nobody writes any more"});
  auto unread = linker.unread();
  const auto beyond = beyond_clips(linker.claimed(), world_);
  unread.insert(unread.end(), beyond.begin(), beyond.end());
  for (const auto& warning : unread) {
    if (std::find(unread_.begin(), unread_.end(), warning) == unread_.end())
      events_.push_back({tick_, "", "warning: " + warning});
  }
  unread_ = std::move(unread);
  listed_.clear();
  for (const auto& [name, set] : board_.sets()) {
    if (set->kind == SetKind::listed) listed_.emplace_back(set.get(), set->listed);
  }
}

std::optional<TableView> Simulation::find_table(const std::string& name) const {
  try {
    return table(name);
  } catch (const Error&) {
    return std::nullopt;
  }
}

TableView Simulation::table(const std::string& name) const {
  if (const Table* whole = board_.find(name)) return {whole, -1};
  const auto first = name.find('/');
  const auto last = name.rfind('/');
  if (first != std::string::npos && first != last) {
    const std::string row = name.substr(first + 1, last - first - 1);
    const Table* table = board_.find(name.substr(0, first) + "/*" + name.substr(last));
    if (!table) table = board_.find("instance/" + row + "/*" + name.substr(last));
    if (table && table->set().kind == SetKind::fixed && table->set().name == "instance/" + row) return {table, 0};
    const int number = table && table->set().is_named() ? table->set().find(row) : -1;
    if (number >= 0) return {table, number};
    if (table && table->set().is_named())
      throw Error(Exit::invalid_input, "there is no " + table->set().name + ' ' + quote(row) +
                                           which_is(world_, row, table->set().name) + "; " +
                                           suggest(row, table->set().names));
  }
  throw Error(Exit::invalid_input, "there is no table " + quote(name) + "; " + suggest_table(name));
}

// Of a path such as "/rover/odom", whose set is not named: the table of the row's set whose quantity is nearest, for
// that row; "" if there is none.
std::string Simulation::of_named_row(const std::string& path, const std::set<std::string>& tables) const {
  std::istringstream parts(path);
  const std::string wanted = path.substr(path.rfind('/') + 1);
  for (std::string part; std::getline(parts, part, '/');) {
    for (const auto& set : standard_.sets) {
      const Set* here = part.empty() ? nullptr : board_.find_set(set.name);
      if (!here || !here->is_named() || here->find(part) < 0) continue;
      std::vector<std::string> quantities;
      const std::string begin = set.name + std::string("/*/");
      for (const auto& table : tables) {
        if (table.starts_with(begin)) quantities.push_back(table.substr(begin.size()));
      }
      const auto longer = std::find_if(quantities.begin(), quantities.end(),
                                       [&](const std::string& each) { return each.starts_with(wanted); });
      const std::string near = longer == quantities.end() ? nearest(wanted, quantities) : *longer;
      if (!near.empty()) return std::string(set.name) + '/' + part + '/' + near;
    }
  }
  return "";
}

// Tables of the same set that there are, and standard ones whose provider would join; the nearest by its quantity or by
// another word for it. Of a set that has none: all tables.
std::string Simulation::suggest_table(const std::string& name) const {
  std::set<std::string> valid;
  for (const auto& [other, table] : board_.tables()) valid.insert(other);
  const std::string wanted_set = name.substr(0, name.find('/')), wanted = name.substr(name.rfind('/') + 1);
  std::map<std::string, std::string> of_word;  // "position": "robot/*/pose"
  for (const auto& set : standard_.sets) {
    const Set* here = board_.find_set(set.name);  // none of one on demand that nobody claims
    const bool has_rows = here && here->rows() > 0;
    for (const auto& quantity : set.quantities) {
      const std::string table = set.name + std::string("/*/") + quantity.name;
      if (*quantity.provider && has_rows && set.kind == SetKind::live) valid.insert(table);
      if (wanted_set != set.name || !valid.count(table)) continue;
      for (std::size_t from = 0, to = 0; from < std::strlen(quantity.also); from = to + 1) {
        const std::string words = quantity.also;
        to = std::min(words.find(' ', from), words.size());
        of_word[words.substr(from, to - from)] = table;
      }
    }
  }
  for (const auto& table : valid) {
    if (table.substr(0, table.find('/')) == wanted_set && table.find('@') == table.npos)
      of_word[table.substr(table.rfind('/') + 1)] = table;
  }
  // "robot/rover/pose/x", as a condition names it.
  const std::string whole = name.substr(0, name.rfind('/')), quantity = whole.substr(whole.rfind('/') + 1);
  if (std::count(whole.begin(), whole.end(), '/') > 1 && valid.count(wanted_set + "/*/" + quantity))
    return quote(wanted) + " is taken for a column of it, and tables are named whole; expected " + quote(whole);
  if (of_word.empty()) {
    for (const auto& set : standard_.sets) {  // "pose": a quantity alone
      const std::string table = std::string(set.name) + "/*/" + name;
      if (valid.count(table))
        return "did you mean " + quote(table) + "? expected SET/ROW/QUANTITY, or SET/*/QUANTITY for all rows";
    }
    const std::string meant = of_named_row(name, valid);
    if (!meant.empty())
      return "did you mean " + quote(meant) + "? expected SET/ROW/QUANTITY, or SET/*/QUANTITY for all rows";
    const std::vector<std::string> all(valid.begin(), valid.end());
    if (!name.starts_with('/')) return suggest(name, all);
    const std::string question = did_you_mean(name, all);
    return "tables are SET/ROW/QUANTITY, and no topics; " + (question.empty() ? "" : question.substr(2) + ' ') +
           expected_one_of(all);
  }
  std::vector<std::string> words, tables;
  for (const auto& [word, table] : of_word) words.push_back(word);
  for (const auto& table : valid) {
    if (table.substr(0, table.find('/')) == wanted_set) tables.push_back(table);
  }
  const std::string near = nearest(wanted, words);
  return expected_one_of(tables) + (near.empty() ? "" : "; did you mean " + quote(of_word[near]) + "?");
}

Snapshot Simulation::snapshot() const {
  Snapshot result;
  result.tick = tick_;
  result.dt = world_.dt;
  for (const auto& [name, set] : board_.sets()) result.sets[name] = {set->names, set->alive, set->like, set->listed};
  for (const auto& [name, table] : board_.tables()) result.tables[name] = {table->columns().text(), table->now()};
  for (const auto& instance : instances_) {
    const Place& place = instance->declared().place;
    result.instances[instance->name()] = {instance->plugin().id, static_cast<uint64_t>(place.line),
                                          static_cast<uint64_t>(place.column), instance->params(),
                                          instance->is_given_up()};
  }
  return result;
}

}  // namespace muster
