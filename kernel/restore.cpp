// Restores a snapshot in place: all of it is checked against the run before anything changes.
#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <utility>

#include "parameter_words.hpp"
#include "simulation.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/params.hpp"

namespace muster {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw Error(Exit::invalid_input, "the snapshot is of another world: " + what);
}

bool is_at(const InstanceDeclaration& declared, const Snapshot::SavedInstance& saved) {
  return static_cast<uint64_t>(declared.place.line) == saved.line &&
         static_cast<uint64_t>(declared.place.column) == saved.column;
}

// Checks that numbers of rows and of blobs fit their columns, so that no cell is read outside its table.
// A reference is null or a row of its set, as it is when a step writes it.
bool refers_to_rows(const Column& column, std::size_t c, const Cells& cells, std::size_t width,
                    const Snapshot& snapshot) {
  const auto found = snapshot.sets.find(column.reference);
  if (column.reference.empty() || found == snapshot.sets.end()) return true;
  const auto rows = static_cast<double>(std::max<std::size_t>(found->second.names.size(), found->second.listed));
  for (std::size_t r = 0; r < cells.rows; ++r) {
    const double row = cells.data[r * width + c];
    if (!std::isnan(row) && !(row >= 0 && row < rows && row == std::floor(row))) return false;
  }
  return true;
}

bool is_sound(const Table& table, const Snapshot::SavedSet& set, const Cells& cells, const Snapshot& snapshot) {
  const bool queue = table.set().kind == SetKind::queue;
  if (cells.rows > cells.data.size()) return false;  // nor can the product be beyond all numbers
  if (cells.data.size() != cells.rows * table.width() || cells.appended.size() != (queue ? cells.rows : 0))
    return false;
  if (!queue && cells.rows != (table.set().kind == SetKind::listed ? set.listed : set.names.size())) return false;
  for (std::size_t c = 0; c < table.width(); ++c) {
    for (std::size_t r = 0; table.columns()[c].bytes && r < cells.rows; ++r) {
      const double blob = cells.data[r * table.width() + c];
      if (!(blob >= 0 && blob <= static_cast<double>(cells.blobs.size()) && blob == std::floor(blob))) return false;
    }
    if (!refers_to_rows(table.columns()[c], c, cells, table.width(), snapshot)) return false;
  }
  return true;
}

// As an attribute or a change in the run can have set it: plugins count with choices and with rows.
bool is_sound(const muster_param& declared, double value, const Snapshot& snapshot) {
  if (std::bit_cast<uint64_t>(value) == std::bit_cast<uint64_t>(declared.value)) return true;  // not given
  if (declared.kind == MUSTER_REFERENCE) {
    const auto set = snapshot.sets.find(declared.text);
    return set != snapshot.sets.end() && value >= 0 && value == std::floor(value) &&
           value < static_cast<double>(set->second.names.size());
  }
  if (!is_settable(declared)) return true;
  if (declared.kind == MUSTER_FLAG) return value == 0 || value == 1;
  if (declared.kind != MUSTER_REAL && value != std::floor(value)) return false;
  if (declared.kind == MUSTER_CHOICE) return value >= 0 && value < static_cast<double>(choices(declared).size());
  return value >= declared.min && value <= declared.max;
}

bool has_sound_params(const muster_plugin& plugin, const std::vector<double>& values, const Snapshot& snapshot) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!is_sound(plugin.params[i], values[i], snapshot)) return false;
  }
  return true;
}

}  // namespace

void Simulation::check_fits(const Snapshot& snapshot) const {
  for (const auto& instance : instances_) {
    const auto found = snapshot.instances.find(instance->name());
    if (found == snapshot.instances.end()) refuse("it has no instance " + quote(instance->name()));
    if (found->second.plugin != instance->plugin().id)
      refuse("its instance " + quote(instance->name()) + " is a " + found->second.plugin + "; here it is a " +
             instance->plugin().id);
    const auto& params = found->second.params;
    if (params.size() != instance->params().size() || !has_sound_params(instance->plugin(), params, snapshot))
      refuse("its instance " + quote(instance->name()) + " has other parameters");
  }
  for (const auto& [name, saved] : snapshot.instances) {
    if (!has(name)) refuse("its instance " + quote(name) + ", a " + saved.plugin + ", is not in this one");
  }
  for (const auto& [name, set] : board_.sets()) {
    const bool is_private = name.starts_with("instance/");  // compared as tables
    if (!is_private && !snapshot.sets.count(name)) refuse("it has no set " + quote(name));
  }
  for (const auto& [name, saved] : snapshot.sets) {
    const Set* set = board_.find_set(name);
    if (!set) refuse("its set " + quote(name) + " is not here");
    const auto common = std::min(set->names.size(), saved.names.size());
    const bool same =
        std::equal(saved.names.begin(), saved.names.begin() + static_cast<std::ptrdiff_t>(common), set->names.begin());
    if (!same) {
      const auto [theirs, ours] = std::mismatch(
          saved.names.begin(), saved.names.begin() + static_cast<std::ptrdiff_t>(common), set->names.begin());
      refuse("it has the " + name + ' ' + quote(*theirs) + " where this one has " + quote(*ours) +
             "; expected the world that it was saved from");
    }
    // Rows beyond those of here are copies that joined: one that is like itself is of a world file.
    for (std::size_t i = common; i < saved.names.size() && i < saved.like.size(); ++i)
      if (saved.like[i] == i && !may_join(name))
        refuse("it has the " + name + ' ' + quote(saved.names[i]) +
               ", which this one has not; expected the world that it was saved from");
    const bool whole =
        saved.alive.size() == saved.names.size() && saved.like.size() == saved.names.size() &&
        std::all_of(saved.like.begin(), saved.like.end(), [&](auto row) { return row < saved.like.size(); });
    const bool is_unique = std::set<std::string>(saved.names.begin(), saved.names.end()).size() == saved.names.size();
    if (!whole || !(is_unique || !set->is_named())) refuse("its set " + quote(name) + " has other rows");
  }
  for (const auto& [name, table] : board_.tables()) {
    const auto found = snapshot.tables.find(name);
    if (found == snapshot.tables.end()) refuse("it has no table " + quote(name));
    if (found->second.columns != table->columns().text()) refuse("its table " + quote(name) + " has other columns");
    const auto set = snapshot.sets.find(table->set().name);
    if (set == snapshot.sets.end()) refuse("it has no set " + quote(table->set().name));
    if (!is_sound(*table, set->second, found->second.cells, snapshot))
      refuse("its table " + quote(name) + " has other rows");
  }
  for (const auto& [name, table] : snapshot.tables) {
    if (!board_.tables().count(name)) refuse("its table " + quote(name) + " is not here");
  }
  for (const auto& instance : instances_) {
    for (const auto& claim : instance->claims()) {
      const Table* table = claim.out ? claim.out : claim.in;
      if (claim.row < 0 || !table) continue;
      const Set& set = table->set();
      const auto& rows = snapshot.sets.at(set.kind == SetKind::queue ? set.owner : set.name);
      if (static_cast<std::size_t>(claim.row) >= rows.names.size()) refuse("it has no row for " + instance->title());
    }
  }
  for (const auto& instance : instances_) {
    const bool may_be_without = instance->isolation() && instance->isolation()->after == AfterCrash::without;
    if (snapshot.instances.at(instance->name()).given_up && !may_be_without)
      throw Error(Exit::invalid_input, "the run that was saved goes on without " + quote(instance->name()) +
                                           ", whose process had ended; expected --isolate " + instance->name() +
                                           "=without here, too");
  }
  if (snapshot.dt != world_.dt)  // last: of another world it is the least that differs
    throw Error(Exit::invalid_input, "the snapshot was saved at ticks of " + print_real(snapshot.dt) +
                                         " s, and here they are of " + print_real(world_.dt) + " s; expected dt=\"" +
                                         print_real(snapshot.dt) + '"');
}

// The world file may plan to change plugins between the snapshot and now: instances are made and removed until they are
// those of then. What went is kept aside. True if any did.
bool Simulation::put_instances(const Snapshot& snapshot, std::vector<std::unique_ptr<Instance>>& aside) {
  std::vector<InstanceDeclaration> candidates = world_.instances;
  std::set<std::string> planned;
  for (const auto& occasion : world_.occasions) {
    for (const auto& change : occasion.plugins) {
      planned.insert(change.instance);
      candidates.push_back(change.plugin);
      candidates.back().name = change.instance;
    }
  }
  const auto of_then = [&](const std::string& name, const Snapshot::SavedInstance& saved) {
    const auto found = std::find_if(candidates.begin(), candidates.end(),
                                    [&](const auto& each) { return each.name == name && is_at(each, saved); });
    return found == candidates.end() ? nullptr : &*found;
  };
  bool changed = false;
  for (std::size_t at = 0; at < instances_.size();) {
    const std::string name = instances_[at]->name();
    const auto saved = snapshot.instances.find(name);
    if (saved == snapshot.instances.end() && planned.count(name)) {
      aside.push_back(std::move(instances_[at]));
      instances_.erase(instances_.begin() + static_cast<std::ptrdiff_t>(at));
      changed = true;
      continue;
    }
    if (saved != snapshot.instances.end() && !is_at(instances_[at]->declared(), saved->second)) {
      if (const InstanceDeclaration* then = of_then(name, saved->second)) {
        aside.push_back(std::exchange(instances_[at], make(*then)));
        changed = true;
      }
    }
    ++at;
  }
  for (const auto& [name, saved] : snapshot.instances) {
    const InstanceDeclaration* then = has(name) ? nullptr : of_then(name, saved);
    if (!then) continue;
    instances_.insert(instances_.begin() + static_cast<std::ptrdiff_t>(place_of(*then)), make(*then));
    changed = true;
  }
  return changed;
}

// Undoes a change of instances: those of `order` are all here or aside; the others go.
void Simulation::put_back(const std::vector<const Instance*>& order, std::vector<std::unique_ptr<Instance>>& aside) {
  for (auto& instance : instances_) aside.push_back(std::move(instance));
  instances_.clear();
  for (const Instance* each : order)
    instances_.push_back(std::move(
        *std::find_if(aside.begin(), aside.end(), [&](const auto& instance) { return instance.get() == each; })));
  aside.clear();
}

// Links with empty tables, which a snapshot is to fill.
void Simulation::relink_anew() {
  batches_.clear();
  board_.take_tables();
  relink();
}

void Simulation::put(const Snapshot& snapshot) {
  stood_.clear();
  for (const auto& [name, saved] : snapshot.sets) {
    Set& set = *board_.find_set(name);
    set.cut(0);
    for (const auto& row : saved.names) set.add(row);
    set.alive = saved.alive;
    set.like = saved.like;
    set.listed = saved.listed;
  }
  for (const auto& [name, saved] : snapshot.tables) board_.find(name)->stored() = saved.cells;
  for (const auto& instance : instances_) {
    const auto& saved = snapshot.instances.at(instance->name());
    instance->params() = saved.params;
    instance->give_up(saved.given_up);
    instance->start_anew_elsewhere();
  }
  tick_ = planned_from_ = snapshot.tick;
  look_at_conditions();
}

void Simulation::restore(const Snapshot& snapshot) {
  const Snapshot own = this->snapshot();
  const auto planned_from = planned_from_;
  const auto mark = board_.mark();
  std::vector<const Instance*> order;
  for (const auto& instance : instances_) order.push_back(instance.get());
  std::vector<std::unique_ptr<Instance>> aside;
  try {
    if (put_instances(snapshot, aside)) relink_anew();
    check_fits(snapshot);
  } catch (...) {
    batches_.clear();
    put_back(order, aside);
    board_.back_to(mark);
    relink_anew();
    put(own);
    planned_from_ = planned_from;
    throw;
  }
  drop_private_sets();
  put(snapshot);
}

}  // namespace muster
