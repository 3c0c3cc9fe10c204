// Checks of a world before it is linked; each refusal names both sides.
#include <algorithm>
#include <muster/row_types.hpp>
#include <set>

#include "claim.hpp"
#include "link.hpp"
#include "text/names.hpp"

namespace muster {
namespace {

std::string both(const Instance& other) { return "; so does " + other.title(); }

// True where the two write a row in common. A rest gives way to rows that are claimed by name.
bool collide(const Claim& a, const Claim& b) {
  if (a.row >= 0 && b.row >= 0) return a.row == b.row;
  const bool a_rest = a.flags & MUSTER_REST, b_rest = b.flags & MUSTER_REST;
  if (a.row >= 0) return !b_rest;
  if (b.row >= 0) return !a_rest;
  return true;
}

}  // namespace

bool Linker::is_given(const std::string& logical) const {
  const std::string table = logical.substr(0, logical.find('/')) + logical.substr(logical.rfind('/'));
  for (const auto& element : standard_.elements) {
    if (table == element.own_row) return true;
    for (const auto& attribute : element.attributes) {
      if (table == attribute.table) return true;
    }
  }
  return false;
}

// A table over a set without rows is empty, whichever plugin would write it.
bool Linker::is_of_the_world(const std::string& logical) const {
  const Set* set = board_.find_set(logical.substr(0, logical.find('/')));
  return is_given(logical) || (set && set->is_named() && set->names.empty());
}

std::vector<Linker::Missing> Linker::missing_providers() const {
  std::vector<Missing> result;
  const auto ask_for = [&](const TableName& name, const Place& at, const std::string& by) {
    const Set* set = board_.find_set(name.set);
    const auto* quantity = standard_quantity(standard_, name);
    if (!quantity || !*quantity->provider || (set->is_named() && set->names.empty())) return;
    if (std::none_of(result.begin(), result.end(), [&](const Missing& m) { return m.plugin == quantity->provider; }))
      result.push_back({quantity->provider, at, by});
  };
  const auto ask_by = [&](const Claimed::By& by) {
    const InstanceDeclaration& declared = by.instance->declared();
    ask_for(by.get().name, by.instance->place(), declared.needed_by.empty() ? declared.name : declared.needed_by);
  };
  for (const auto& [logical, c] : claimed_) {
    if (!c.writers.empty() || !c.adders.empty()) continue;
    if (!c.modifiers.empty()) {
      if (!is_given(logical)) ask_by(c.modifiers[0]);
      continue;
    }
    const auto needing = std::find_if(c.readers.begin(), c.readers.end(),
                                      [](const auto& by) { return !(by.get().flags & MUSTER_OPTIONAL); });
    if (needing != c.readers.end()) ask_by(*needing);
  }
  for (const auto& record : world_.records) {
    const auto first = record.table.find('/'), last = record.table.rfind('/');
    if (first == last) continue;  // not a table's name: reported where it is to be recorded
    const TableName name{record.table.substr(0, first), "*", record.table.substr(last + 1), ""};
    const auto claimed = claimed_.find(name.logical());
    if (claimed == claimed_.end() || !claimed->second.is_written()) ask_for(name, record.place, "record");
  }
  for (const auto& occasion : world_.occasions) {
    if (!occasion.when) continue;
    const TableName name = table_of(*occasion.when);
    const auto claimed = claimed_.find(name.logical());
    if (board_.find_set(name.set) && (claimed == claimed_.end() || !claimed->second.is_written()))
      ask_for(name, occasion.when->place, "when");
  }
  return result;
}

void Linker::check() {
  // Standard tables first: of two plugins that write the same ones, users know these and not the plugins' own.
  const auto is_standard = [this](const std::string& logical) {
    const TableName name{logical.substr(0, logical.find('/')), "*", logical.substr(logical.rfind('/') + 1), ""};
    return standard_quantity(standard_, name) != nullptr;
  };
  for (const auto& [logical, c] : claimed_) {
    if (is_standard(logical)) check_writers(logical, c);
  }
  for (const auto& [logical, c] : claimed_) {
    if (!c.adders.empty() && is_given(logical))
      throw c.adders[0].instance->refused("adds to " + quote(logical) +
                                          ", which the world gives; expected a claim to modify it");
    check_columns(logical, c);
    if (!is_standard(logical)) check_writers(logical, c);
    check_stages(logical, c);
    check_listed(logical, c);
    check_reads(logical, c);
  }
  check_names();
  check_joins();
  check_carried();
  order();
}

// Names that a read may use: written tables, tables of the world, and those of a declared provider.
std::vector<std::string> Linker::readable() const {
  std::set<std::string> result;
  for (const auto& [logical, c] : claimed_) {
    if (!c.is_written() && !is_of_the_world(logical)) continue;
    for (const auto& table : tables_of(logical, c)) result.insert(table.name);
  }
  for (const auto& set : standard_.sets) {
    for (const auto& quantity : set.quantities) {
      const std::string logical = set.name + std::string("/*/") + quantity.name;
      if (*quantity.provider || is_of_the_world(logical)) result.insert(logical);
    }
  }
  return {result.begin(), result.end()};
}

// The remedy where a table has no writer: of a standard one its name is right, and a plugin is missing.
std::string Linker::expected_writer(const TableName& name, const std::string& table) const {
  const Quantity* standard = standard_quantity(standard_, name);
  if (!standard || !name.part.empty()) return suggest(table, readable());
  const std::string writer = *standard->writer ? standard->writer : standard->provider;
  if (!writer.empty()) return "expected a plugin that does, such as <" + writer + "/>";
  const std::string own = "expected a plugin of your own that does (muster new controller NAME begins one)";
  const bool is_car = name.quantity == "car_command";  // <control.car> makes commands of a controller's
  return own + (is_car ? ", or, in the place of " + std::string(standard->user) +
                             ", a controller that finds its own way, such as <control.waypoint robot=\"...\" "
                             "path=\"FILE.csv\"/>"
                       : "");
}

void Linker::check_reads(const std::string& logical, const Claimed& c) const {
  for (const auto& by : c.readers) {
    const Claim& claim = by.get();
    const std::string name = logical + (claim.name.part.empty() ? "" : '@' + claim.name.part);
    const auto tables = tables_of(logical, c);
    const bool found = claim.name.part.empty()
                           ? c.is_written() || is_of_the_world(logical)
                           : std::any_of(tables.begin(), tables.end(), [&](const auto& t) { return t.name == name; });
    if (!found && !(claim.flags & MUSTER_OPTIONAL) && !promised_.count(name)) {
      throw by.instance->refused("reads " + quote(claim.name.text()) + ", which nobody writes; " +
                                 expected_writer(claim.name, name));
    }
    // A controller may read what is not standard only if its writer calls it sensed.
    const bool own = claim.name.set == "instance/" + by.instance->name();
    if (by.instance->phase() != MUSTER_CONTROL || standard_quantity(standard_, claim.name) || own) continue;
    for (const auto* group : {&c.writers, &c.adders}) {
      for (const auto& writer : *group) {
        if (!(writer.get().flags & MUSTER_SENSED))
          throw by.instance->refused("reads " + quote(name) + ", which is truth: " + writer.instance->title() +
                                     " does not write it as sensed");
      }
    }
  }
}

namespace {

void check_phase(const std::string& does, const std::string& logical, const Claimed::By& one,
                 const Claimed::By& other) {
  if (one.instance->phase() == other.instance->phase()) return;
  throw one.instance->refused(does + ' ' + quote(logical) + " in the phase " + phase_name(one.instance->phase()) +
                              ", but " + other.instance->title() + " in " + phase_name(other.instance->phase()) +
                              "; a table is written in one phase");
}

}  // namespace

// Of two networks, or two kinds of physics, that both write what muster knows one such plugin for.
std::string Linker::one_of_a_kind(const Claimed::By& one, const Claimed::By& other) const {
  const Quantity* known = standard_quantity(standard_, one.get().name);
  const auto kind = [](const std::string& plugin) { return plugin.substr(0, plugin.find('.')); };
  const std::string provider = known ? known->provider : "";
  if (provider.empty() || kind(one.instance->declared().plugin) != kind(provider) ||
      kind(other.instance->declared().plugin) != kind(provider))
    return "";
  return ": a world has one " + kind(provider) + " plugin, which works for all";
}

// Of two that command a robot, where one of them only executes the commands of a program that the world does not have,
// as control.car does beside control.waypoint: which to take away, and why. Otherwise no more than that one has to go.
std::string Linker::which_of_two(const Claimed::By& one, const Claimed::By& other) const {
  for (const auto& [executor, driver] : {std::pair(&one, &other), std::pair(&other, &one)}) {
    const std::string plugin = executor->instance->declared().plugin;
    for (const Claim& claim : executor->instance->claims()) {
      const Quantity* given =
          claim.kind == MUSTER_READ && !claim.file ? standard_quantity(standard_, claim.name) : nullptr;
      if (!given || plugin != given->user || claimed_.at(claim.name.logical()).is_written()) continue;
      return "expected no " + plugin + ": it executes the " + quote(claim.name.text()) +
             " of a program, which nobody writes here, and " + driver->instance->declared().plugin +
             " drives the robot by itself";
    }
  }
  const std::string kind = one_of_a_kind(one, other);
  return "expected one of the two" +
         (kind.empty() && one.instance->phase() == MUSTER_CONTROL
              ? ", or one after the other: <swap at=\"2\" instance=" + quote(one.instance->name()) +
                    " plugin=" + quote(other.instance->declared().plugin) + " .../> and no other instance for it"
              : kind);
}

void Linker::check_writers(const std::string& logical, const Claimed& c) const {
  if (!c.writers.empty() && !c.adders.empty()) {
    const Instance& writer = *c.writers[0].instance;
    const std::string type = row_type(c.writers[0].get().columns.text()),
                      of = '<' + (type.empty() ? "..." : type) + '>';
    throw writer.refused("writes " + quote(logical) + ", to which " + c.adders[0].instance->title() +
                         " adds; expected one of the two, or add" + of + "(...) in place of write" + of +
                         "(...) in the source of " + writer.declared().plugin);
  }
  for (std::size_t i = 0; i < c.writers.size(); ++i) {
    const auto& one = c.writers[i];
    for (std::size_t j = 0; j < i; ++j) {
      const auto& other = c.writers[j];
      if (board_.find_set(one.get().name.set)->kind == SetKind::queue) continue;  // each appends rows of its own
      if (collide(one.get(), other.get()))
        throw one.instance->refused("writes " + quote(one.get().name.text()) + both(*other.instance) + "; " +
                                    which_of_two(one, other));
      check_phase("writes", logical, one, other);
    }
  }
  for (const auto& by : c.adders) check_phase("adds to", logical, by, c.adders[0]);
}

void Linker::check_columns(const std::string& logical, const Claimed& c) const {
  const Claimed::By* first = nullptr;
  for (const auto* group : {&c.writers, &c.adders, &c.modifiers, &c.readers}) {
    for (const auto& by : *group) {
      if (!first) first = &by;
      if (by.get().columns != first->get().columns)
        throw by.instance->refused("claims " + quote(logical) + " as \"" + by.get().columns.text() + "\", but " +
                                   first->instance->title() + " as \"" + first->get().columns.text() + '"');
    }
  }
}

// A stage sees each value of the stage before, and comes no earlier in a tick.
void Linker::check_stages(const std::string& logical, const Claimed& c) const {
  std::vector<Claimed::By> before = c.writers.empty() ? c.adders : c.writers;
  for (const auto& by : c.modifiers) {
    if (before.empty() && !is_of_the_world(logical))
      throw by.instance->refused(
          "modifies " + quote(logical) + ", which nobody writes" +
          (standard_quantity(standard_, by.get().name) ? "; " + expected_writer(by.get().name, logical) : ""));
    for (const auto& earlier : before) {
      if (earlier.instance == by.instance)
        throw by.instance->refused("modifies " + quote(logical) + ", which it writes or modifies itself");
      if (earlier.instance->phase() > by.instance->phase())
        throw by.instance->refused("modifies " + quote(logical) +
                                   " before it is written: " + earlier.instance->title() + " comes in the phase " +
                                   phase_name(earlier.instance->phase()));
      if (earlier.instance->every() % by.instance->every() != 0)
        throw by.instance->refused("modifies " + quote(logical) + " every " + std::to_string(by.instance->every()) +
                                   " ticks and would miss values: " + earlier.instance->title() + " writes every " +
                                   std::to_string(earlier.instance->every()));
    }
    before.push_back(by);
  }
}

// Columns of a listed set are of the same rows: they are written whenever its rows are listed, and read with them.
void Linker::check_listed(const std::string& logical, const Claimed& c) const {
  const auto found = listers_.find(logical.substr(0, logical.find('/')));
  const Set* set = board_.find_set(logical.substr(0, logical.find('/')));
  if (!set || set->kind != SetKind::listed) return;
  for (const auto* group : {&c.writers, &c.adders, &c.modifiers}) {
    for (const auto& by : *group) {
      if (found != listers_.end() && group != &c.writers && by.instance == found->second.front())
        throw by.instance->refused("adds to or modifies " + quote(logical) +
                                   ", whose rows it lists itself; expected it to write the table");
      if (found == listers_.end())
        throw by.instance->refused("writes " + quote(logical) + ", but nobody lists the rows of " + quote(set->name));
      const Instance& lister = *found->second.front();
      if (lister.every() % by.instance->every() != 0)
        throw by.instance->refused("writes " + quote(logical) + " every " + std::to_string(by.instance->every()) +
                                   " ticks, but " + lister.title() + " lists its rows every " +
                                   std::to_string(lister.every()));
      if (by.instance->phase() < lister.phase())
        throw by.instance->refused("writes " + quote(logical) + " before " + lister.title() + " lists its rows");
      for (const auto& reader : c.readers) {
        if (reader.instance->phase() >= lister.phase() && reader.instance->phase() < by.instance->phase())
          throw reader.instance->refused("reads " + quote(logical) + " after its rows are listed and before " +
                                         by.instance->title() + " writes it");
      }
    }
  }
}

// Parts and stages are named after instances: no two names may coincide.
void Linker::check_names() const {
  for (const auto& [logical, c] : claimed_) {
    std::map<std::string, const Instance*> owners;
    for (const auto& [table, claim, owner] : tables_of(logical, c)) {
      const auto [other, is_new] = owners.emplace(table, owner);
      if (is_new) continue;
      const Instance& one = owner ? *owner : *other->second;
      const Instance* rival = owner ? other->second : nullptr;
      throw one.refused("claims " + quote(table) + (rival ? both(*rival) : ", which is the world's"));
    }
  }
}

// One instance may join rows to a set: it alone counts them.
void Linker::check_joins() const {
  std::map<std::string, const Instance*> joiners;
  for (const Instance* instance : instances_) {
    for (const auto& claim : instance->claims()) {
      if (claim.kind != MUSTER_WRITE || !(claim.flags & MUSTER_JOINS)) continue;
      const Instance* first = joiners.emplace(claim.name.set, instance).first->second;
      if (first != instance)
        throw instance->refused("lets rows of " + quote(claim.name.set) + " join and leave" + both(*first));
    }
  }
}

// The rows seen so far would change with a queue's stages: messages would arrive twice, or never.
void Linker::check_queue_stages(const std::string& logical, const Claimed& c) const {
  const Table* old = board_.find(logical);
  if (!old || old->set().kind != SetKind::queue || !c.is_written()) return;
  std::set<std::string> stages{logical};
  for (const auto& by : c.modifiers) stages.insert(logical + '@' + by.instance->name());
  if (!c.modifiers.empty()) stages.insert(logical + "@base");
  const bool all_held = std::all_of(stages.begin(), stages.end(), [&](const auto& name) { return board_.find(name); });
  const bool all_kept = std::all_of(board_.tables().begin(), board_.tables().end(), [&](const auto& table) {
    return table.first.rfind(logical + '@', 0) != 0 || stages.count(table.first);
  });
  if (all_held && all_kept) return;
  throw Error(Exit::invalid_input, "the stages of the queue " + quote(logical) +
                                       " change in mid-run; expected them to stand from the start, and one to be "
                                       "swapped for another under its name");
}

// An old table whose columns differ holds the state of some plugin: it is not dropped unless the user requests it.
void Linker::check_carried() const {
  for (const auto& [logical, c] : claimed_) {
    check_queue_stages(logical, c);
    const auto tables = tables_of(logical, c);
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const auto& [name, claim, owner] = tables[i];
      const Table* old = before(logical, c, i);
      if (!old || old->columns() == claim->columns || (claim->flags & MUSTER_ADOPTS)) continue;
      if (claim->kind == MUSTER_WRITE && owner)
        throw owner->refused("writes " + quote(name) + " as \"" + claim->columns.text() + "\", but it holds \"" +
                             old->columns().text() + "\" and the plugin does not adopt that");
      throw Error(Exit::invalid_input, "the columns of " + quote(name) + " change from \"" + old->columns().text() +
                                           "\" to \"" + claim->columns.text() + '"');
    }
  }
}

}  // namespace muster
