// What a world must fulfil before it is linked; each refusal names both sides.
#include "claim.hpp"
#include "link.hpp"
#include "names.hpp"

#include <algorithm>

namespace muster {
namespace {

Error refused(const Instance& instance, const std::string& what) {
  return Error(Exit::invalid_input, instance.title() + ": " + what);
}

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

const char* phase_name(uint32_t phase) {
  static const char* names[] = {"no phase", "CONTROL", "ACTUATE", "PHYSICS", "RADIO", "NETWORK", "SENSE", "OBSERVE"};
  return names[phase <= MUSTER_OBSERVE ? phase : 0];
}

bool Linker::is_of_the_world(const std::string& logical) const {
  const auto set_end = logical.find('/');
  const Set* set = board_.find_set(logical.substr(0, set_end));
  const auto slash = logical.rfind('/');
  const std::string table = logical.substr(0, set_end) + logical.substr(slash);
  for (const auto& element : standard_.elements) {
    if (table == element.own_row) return true;
    for (const auto& attribute : element.attributes) {
      if (table == attribute.table) return true;
    }
  }
  // A table over a set without rows is empty, whoever might have written it.
  return set && set->is_named() && set->names.empty();
}

std::vector<std::string> Linker::missing_providers() const {
  std::vector<std::string> result;
  for (const auto& [logical, c] : claimed_) {
    if (c.is_written() || c.readers.empty()) continue;
    const bool needed = std::any_of(c.readers.begin(), c.readers.end(), [](const auto& by) { return !(by.get().flags & MUSTER_OPTIONAL); });
    const auto& name = c.readers[0].get().name;
    const Set* set = board_.find_set(name.set);
    const auto* quantity = standard_quantity(standard_, name);
    if (!needed || !quantity || !*quantity->provider || (set->is_named() && set->names.empty())) continue;
    if (std::find(result.begin(), result.end(), quantity->provider) == result.end()) result.push_back(quantity->provider);
  }
  return result;
}

void Linker::check() {
  for (const auto& [logical, c] : claimed_) {
    check_columns(logical, c);
    check_writers(logical, c);
    check_stages(logical, c);
    check_listed(logical, c);
    check_reads(logical, c);
  }
  check_carried();
  order();
}

void Linker::check_reads(const std::string& logical, const Claimed& c) const {
  for (const auto& by : c.readers) {
    const Claim& claim = by.get();
    const std::string name = logical + (claim.name.part.empty() ? "" : '@' + claim.name.part);
    const auto tables = tables_of(logical, c);
    const bool found = claim.name.part.empty() ? c.is_written() || is_of_the_world(logical)
                                               : std::any_of(tables.begin(), tables.end(), [&](const auto& t) { return t.first == name; });
    if (!found && !(claim.flags & MUSTER_OPTIONAL)) {
      std::vector<std::string> written;
      for (const auto& [other, claims] : claimed_) {
        for (const auto& [table, first] : tables_of(other, claims)) written.push_back(table);
      }
      throw refused(*by.instance, "reads " + quote(name) + ", which nobody writes; " + suggest(name, written));
    }
    // A controller may read what is not standard only if its writer calls it sensed.
    if (by.instance->phase() != MUSTER_CONTROL || standard_quantity(standard_, claim.name) || c.writers.empty()) continue;
    const bool own = claim.name.set == "instance/" + by.instance->name();
    if (!own && !(c.writers[0].get().flags & MUSTER_SENSED))
      throw refused(*by.instance, "reads " + quote(name) + ", which is truth: " + c.writers[0].instance->title() + " does not write it as sensed");
  }
}

void Linker::check_writers(const std::string& logical, const Claimed& c) const {
  if (!c.writers.empty() && !c.adders.empty())
    throw refused(*c.adders[0].instance, "adds to " + quote(logical) + ", which " + c.writers[0].instance->title() + " writes");
  for (std::size_t i = 0; i < c.writers.size(); ++i) {
    const auto& one = c.writers[i];
    const bool joins = one.get().flags & MUSTER_JOINS;
    for (std::size_t j = 0; j < i; ++j) {
      const auto& other = c.writers[j];
      if (joins != ((other.get().flags & MUSTER_JOINS) != 0)) continue;
      if (board_.find_set(one.get().name.set)->kind == SetKind::queue) continue;  // each appends rows of its own
      if (collide(one.get(), other.get())) throw refused(*one.instance, "writes " + quote(one.get().name.set + '/' + one.get().name.row + '/' + one.get().name.quantity) + both(*other.instance));
      if (one.instance->phase() != other.instance->phase())
        throw refused(*one.instance, std::string("writes ") + quote(logical) + " in the phase " + phase_name(one.instance->phase()) + ", but " + other.instance->title() + " in " + phase_name(other.instance->phase()) + "; a table is written in one phase");
    }
  }
  for (const auto& by : c.adders) {
    if (by.instance->phase() != c.adders[0].instance->phase())
      throw refused(*by.instance, std::string("adds to ") + quote(logical) + " in the phase " + phase_name(by.instance->phase()) + ", but " + c.adders[0].instance->title() + " in " + phase_name(c.adders[0].instance->phase()) + "; a table is written in one phase");
  }
}

void Linker::check_columns(const std::string& logical, const Claimed& c) const {
  const Claimed::By* first = nullptr;
  for (const auto* group : {&c.writers, &c.adders, &c.modifiers, &c.readers}) {
    for (const auto& by : *group) {
      if (by.get().flags & MUSTER_JOINS) continue;
      if (!first) first = &by;
      if (by.get().columns != first->get().columns)
        throw refused(*by.instance, "claims " + quote(logical) + " as \"" + by.get().columns.text() + "\", but " + first->instance->title() + " as \"" + first->get().columns.text() + '"');
    }
  }
}

// A stage sees each value of the stage before, and comes no earlier in a tick.
void Linker::check_stages(const std::string& logical, const Claimed& c) const {
  std::vector<Claimed::By> before = c.writers.empty() ? c.adders : c.writers;
  for (const auto& by : c.modifiers) {
    if (before.empty() && !is_of_the_world(logical)) throw refused(*by.instance, "modifies " + quote(logical) + ", which nobody writes");
    for (const auto& earlier : before) {
      if (earlier.instance == by.instance) throw refused(*by.instance, "modifies " + quote(logical) + ", which it writes or modifies itself");
      if (earlier.instance->phase() > by.instance->phase())
        throw refused(*by.instance, "modifies " + quote(logical) + " before it is written: " + earlier.instance->title() + " comes in the phase " + phase_name(earlier.instance->phase()));
      if (earlier.instance->every() % by.instance->every() != 0)
        throw refused(*by.instance, "modifies " + quote(logical) + " every " + std::to_string(by.instance->every()) + " ticks and would miss values: " + earlier.instance->title() + " writes every " + std::to_string(earlier.instance->every()));
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
      if (found == listers_.end()) throw refused(*by.instance, "writes " + quote(logical) + ", but nobody lists the rows of " + quote(set->name));
      const Instance& lister = *found->second.front();
      if (lister.every() % by.instance->every() != 0)
        throw refused(*by.instance, "writes " + quote(logical) + " every " + std::to_string(by.instance->every()) + " ticks, but " + lister.title() + " lists its rows every " + std::to_string(lister.every()));
      if (by.instance->phase() < lister.phase())
        throw refused(*by.instance, "writes " + quote(logical) + " before " + lister.title() + " lists its rows");
      for (const auto& reader : c.readers) {
        if (reader.instance->phase() >= lister.phase() && reader.instance->phase() < by.instance->phase())
          throw refused(*reader.instance, "reads " + quote(logical) + " after its rows are listed and before " + by.instance->title() + " writes it");
      }
    }
  }
}

// A table of before whose columns differ is somebody's state: it is not thrown away unasked.
void Linker::check_carried() const {
  for (const auto& [logical, c] : claimed_) {
    for (const auto& [name, claim] : tables_of(logical, c)) {
      const Table* old = board_.find(name);
      if (!old || old->columns() == claim->columns || (claim->flags & MUSTER_ADOPTS)) continue;
      for (const auto& by : c.writers) {
        if (&by.get() == claim)
          throw refused(*by.instance, "writes " + quote(name) + " as \"" + claim->columns.text() + "\", but it holds \"" + old->columns().text() + "\" and the plugin does not adopt that");
      }
      throw Error(Exit::invalid_input, "the columns of " + quote(name) + " change from \"" + old->columns().text() + "\" to \"" + claim->columns.text() + '"');
    }
  }
}

}  // namespace muster
