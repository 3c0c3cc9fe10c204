#include "link.hpp"

#include <algorithm>

#include "claim.hpp"
#include "text/names.hpp"

namespace muster {

Linker::Linker(const std::vector<Instance*>& instances, const Standard& standard, const World& world, Blackboard& board)
    : instances_(instances), standard_(standard), world_(world), board_(board) {
  gather();
}

void Linker::gather() {
  for (Instance* instance : instances_) {
    for (std::size_t i = 0; i < instance->claims().size(); ++i) {
      const Claim& claim = instance->claims()[i];
      const bool only_joins =
          claim.kind == MUSTER_WRITE && (claim.flags & MUSTER_JOINS);  // the right to join claims no cells
      if (claim.file || only_joins) continue;
      auto& claimed = claimed_[claim.name.logical()];
      auto& group = claim.kind == MUSTER_READ    ? claimed.readers
                    : claim.kind == MUSTER_WRITE ? claimed.writers
                    : claim.kind == MUSTER_ADD   ? claimed.adders
                                                 : claimed.modifiers;
      group.push_back({instance, i});
      const auto* set = standard_set(standard_, claim.name.set);
      if (claim.kind == MUSTER_WRITE && set && set->kind == SetKind::listed &&
          claim.name.quantity == set->quantities[0].name)
        listers_[claim.name.set].push_back(instance);
    }
  }
}

// All tables of a quantity; the last is the one that readers get.
std::vector<Linker::Needed> Linker::tables_of(const std::string& logical, const Claimed& c) const {
  std::vector<Needed> result;
  for (const auto& by : c.adders) {
    const auto& part = by.get().name.part;
    result.push_back({logical + '@' + by.instance->name() + (part.empty() ? "" : '.' + part), &by.get(), by.instance});
  }
  const auto* any = !c.writers.empty()     ? &c.writers[0]
                    : !c.adders.empty()    ? &c.adders[0]
                    : !c.readers.empty()   ? &c.readers[0]
                    : !c.modifiers.empty() ? &c.modifiers[0]
                                           : nullptr;
  if (!any) return result;
  result.push_back({logical, &any->get(), c.writers.empty() ? nullptr : any->instance});
  if (c.modifiers.empty()) return result;
  result.back().name += "@base";
  for (const auto& by : c.modifiers) result.push_back({logical + '@' + by.instance->name(), &by.get(), by.instance});
  result.back().name = logical;
  return result;
}

// Orders the instances of each phase by their dependencies (longest path from a source).
void Linker::order() {
  const auto wait = [this](Instance* who, Instance* whom, const std::string& what) {
    if (who != whom && who->phase() == whom->phase()) waits_[who].emplace(whom, what);
  };
  for (const auto& [logical, c] : claimed_) {
    std::vector<Claimed::By> chain = c.writers;
    chain.insert(chain.end(), c.adders.begin(), c.adders.end());
    for (const auto& modifier : c.modifiers) {
      for (const auto& earlier : chain) wait(modifier.instance, earlier.instance, logical);
      chain.push_back(modifier);
    }
    for (const auto& reader : c.readers) {
      const auto& part = reader.get().name.part;
      for (const auto& writer : chain) {
        const auto& name = writer.instance->name();
        const bool is_stage = writer.get().kind == MUSTER_MODIFY;
        if (part.empty() || (part == "base" && !is_stage) || part == name || part.rfind(name + '.', 0) == 0)
          wait(reader.instance, writer.instance, logical);
      }
    }
    const auto listers = listers_.find(logical.substr(0, logical.find('/')));
    if (listers == listers_.end()) continue;
    for (const auto* group : {&c.writers, &c.adders, &c.modifiers, &c.readers}) {
      for (const auto& by : *group) {
        for (Instance* lister : listers->second) wait(by.instance, lister, logical);
      }
    }
  }
  std::vector<Instance*> left = instances_;
  while (!left.empty()) {
    std::vector<Instance*> ready;
    for (Instance* instance : left) {
      const auto& whom = waits_[instance];
      const bool can = std::all_of(whom.begin(), whom.end(), [this](const auto& w) { return depth_.count(w.first); });
      if (can) ready.push_back(instance);
    }
    if (ready.empty()) report_cycle(left);
    for (Instance* instance : ready) {
      std::size_t depth = 0;
      for (const auto& [whom, what] : waits_[instance]) depth = std::max(depth, depth_[whom] + 1);
      depth_[instance] = depth;
      std::erase(left, instance);
    }
  }
}

void Linker::report_cycle(const std::vector<Instance*>& stuck) const {
  std::vector<Instance*> path = {stuck.front()};
  std::string text;
  while (true) {
    const auto& whom = waits_.at(path.back());
    // The first in the order of the world file: the message must not depend on addresses.
    const auto next = std::find_if(stuck.begin(), stuck.end(), [&](Instance* other) { return whom.count(other) > 0; });
    const auto first = std::find(path.begin(), path.end(), *next) - path.begin();
    path.push_back(*next);
    if (static_cast<std::size_t>(first) + 1 == path.size()) continue;
    for (auto i = static_cast<std::size_t>(first); i + 1 < path.size(); ++i)
      text += (text.empty() ? "" : "; ") + path[i]->name() + " needs " + quote(waits_.at(path[i]).at(path[i + 1])) +
              " of " + path[i + 1]->name();
    const Instance& one = *path[static_cast<std::size_t>(first)];
    throw Error(Exit::invalid_input, one.title() + ": a cycle inside the phase " + phase_name(one.phase()) + ": " +
                                         text +
                                         "; let one of them work in another phase, so that it is read a tick later");
  }
}

void Linker::fill_from_world(Table& table, const TableName& name) const {
  const std::string target = name.set + '/' + name.quantity;
  for (const auto& row : world_.rows) {
    const auto set = std::find(row.sets.begin(), row.sets.end(), name.set);
    if (set == row.sets.end()) continue;
    double* cells = table.stored().data.data() + static_cast<std::size_t>(table.set().find(row.name)) * table.width();
    if (target == row.own_row) cells[0] = board_.find_set(row.set)->find(row.name);
    for (const auto& values : row.values) {
      if (values.table != target) continue;
      if (values.store)
        values.store(values.values.data(), cells);
      else
        std::copy(values.values.begin(), values.values.end(), cells);
    }
  }
}

namespace {

// Copies the cells of columns that both tables have; the others keep their initial values.
void adopt(const Table& old, Table& table) {
  table.stored().blobs = old.now().blobs;
  for (std::size_t c = 0; c < table.width(); ++c) {
    const int from = old.columns().find(table.columns()[c].name);
    if (from < 0 || old.columns()[static_cast<std::size_t>(from)] != table.columns()[c]) continue;
    for (std::size_t r = 0; r < std::min(old.now().rows, table.now().rows); ++r)
      table.stored().data[r * table.width() + c] = old.now().data[r * old.width() + static_cast<std::size_t>(from)];
  }
}

}  // namespace

// The table whose values a new one inherits. Where stages came or went, values follow their writers: the base of a
// chain was the table itself, and the last stage bears the table's name.
Table* Linker::before(const std::string& logical, const Claimed& c, std::size_t place) const {
  Table* whole = board_.find(logical);
  if (place < c.adders.size()) return board_.find(tables_of(logical, c)[place].name);
  const auto stage = place - c.adders.size();
  Table* found = board_.find(logical + '@' + (stage == 0 ? "base" : c.modifiers[stage - 1].instance->name()));
  return found ? found : whole;
}

Table& Linker::make(const std::string& name, const Claim& claim, Table* before) {
  const auto* quantity = standard_quantity(standard_, claim.name);
  auto table =
      std::make_unique<Table>(name, *board_.find_set(claim.name.set), claim.columns, quantity ? quantity->initial : "");
  if (before && before->columns() == table->columns()) {
    if (held_by_.at(before) == 1)
      table->take_over(std::move(*before));
    else
      table->take_over(*before);
  } else {
    table->grow();
    fill_from_world(*table, claim.name);
    if (before) adopt(*before, *table);
  }
  return board_.add(std::move(table));
}

void Linker::make_tables(const std::string& logical, const Claimed& c, const std::vector<Table*>& held) {
  if (!c.is_written() && !is_of_the_world(logical)) return;  // optional reads of a table that has no writer
  std::vector<Table*> tables;
  for (const auto& needed : tables_of(logical, c))
    tables.push_back(&make(needed.name, *needed.claim, held[tables.size()]));
  Sum sum;
  std::vector<Instance*> adders;
  for (std::size_t i = 0; i < c.adders.size(); ++i) {
    Claim& claim = c.adders[i].get();
    claim.in = claim.out = tables[i];
    sum.parts.push_back(tables[i]);
    writers_of_[tables[i]].push_back(c.adders[i].instance);
    adders.push_back(c.adders[i].instance);
  }
  Table* stage = tables[c.adders.size()];
  if (!adders.empty()) {
    sum.total = stage;
    writers_of_[stage] = adders;
    sums_.emplace_back(sum, adders);
  }
  for (const auto& by : c.writers) {
    Claim& claim = by.get();
    claim.in = claim.out = stage;
    const auto& listers = listers_[claim.name.set];
    claim.lists =
        stage->set().kind == SetKind::listed && std::find(listers.begin(), listers.end(), by.instance) != listers.end();
    claim.staged = false;
    claim.others.clear();
    for (const auto& other : c.writers) {
      if (claim.row >= 0 || other.get().row < 0 || stage->set().kind == SetKind::queue) continue;
      claim.staged = true;
      claim.others.push_back(other.get().row);
    }
    writers_of_[stage].push_back(by.instance);
  }
  for (std::size_t i = 0; i < c.modifiers.size(); ++i) {
    Claim& claim = c.modifiers[i].get();
    claim.in = stage;
    claim.out = stage = tables[c.adders.size() + 1 + i];
    writers_of_[stage].push_back(c.modifiers[i].instance);
  }
  if (!c.modifiers.empty()) board_.alias(logical + '@' + c.modifiers.back().instance->name(), *stage);
}

void Linker::point_readers(const std::string& logical, const Claimed& c) {
  for (const auto& by : c.readers) {
    Claim& claim = by.get();
    claim.in = board_.find(logical + (claim.name.part.empty() ? "" : '@' + claim.name.part));
    if ((claim.flags & MUSTER_OPTIONAL) && !c.is_written() && !is_of_the_world(logical)) claim.in = nullptr;
    if (claim.in) see_each_once(by);
  }
  for (const auto& by : c.modifiers) see_each_once(by);
}

// Determines for a claim on a queue which rows are new to it at its step.
void Linker::see_each_once(const Claimed::By& by) const {
  Claim& claim = by.get();
  if (claim.in->set().kind != SetKind::queue) return;
  claim.window = by.instance->every();
  // Its own messages are published after its step, as those of later phases are.
  const auto writers = writers_of_.find(claim.in);
  claim.late = writers != writers_of_.end() &&
               std::any_of(writers->second.begin(), writers->second.end(), [&](const Instance* writer) {
                 return writer == by.instance || writer->phase() > by.instance->phase();
               });
  claim.from_start = by.instance->phase() != MUSTER_SENSE;
  claim.in->keep =
      std::max(claim.in->keep, claim.late || by.instance->phase() == MUSTER_OBSERVE ? claim.window : claim.window - 1);
}

std::vector<Batch> Linker::make_batches() {
  std::vector<Batch> batches;
  std::map<Instance*, std::size_t> batch_of;
  for (uint32_t phase = MUSTER_CONTROL; phase <= MUSTER_OBSERVE; ++phase) {
    const auto first = batches.size();
    for (Instance* instance : instances_) {
      if (instance->phase() != phase) continue;
      const auto at = first + depth_[instance];
      if (batches.size() <= at) batches.resize(at + 1);
      batches[at].phase = phase;
      batches[at].instances.push_back(instance);
      batches[at].any_shared |= !instance->is_direct();
      batch_of[instance] = at;
    }
  }
  const auto last = [&](const std::vector<Instance*>& writers) {
    std::size_t result = 0;
    for (Instance* writer : writers) result = std::max(result, batch_of[writer]);
    return result;
  };
  for (const auto& [sum, adders] : sums_) batches[last(adders)].sums.push_back(sum);
  for (const auto& [name, table] : board_.tables()) {
    const auto writers = writers_of_.find(table.get());
    if (writers != writers_of_.end()) batches[last(writers->second)].publish.push_back(table.get());
  }
  return batches;
}

std::vector<Batch> Linker::build() {
  std::map<std::string, std::vector<Table*>> held;
  for (const auto& [logical, c] : claimed_) {
    for (std::size_t i = 0; i < tables_of(logical, c).size(); ++i)
      ++held_by_[held[logical].emplace_back(before(logical, c, i))];
  }
  const auto old = board_.take_tables();
  for (const auto& [logical, c] : claimed_) make_tables(logical, c, held[logical]);
  for (const auto& [logical, c] : claimed_) point_readers(logical, c);
  for (Instance* instance : instances_) {
    bool direct = true;
    for (Claim& claim : instance->claims()) {
      claim.direct = claim.out && !claim.lists && !claim.staged && claim.row < 0 &&
                     claim.out->set().kind == SetKind::fixed && !claim.columns.any_bytes();
      direct &= claim.direct || !claim.out;
    }
    instance->set_direct(direct);
  }
  for (const auto& [name, table] : old) {
    if (!held_by_.count(table.get()) && !board_.find(name)) dropped_.push_back(name);
  }
  return make_batches();
}

}  // namespace muster
