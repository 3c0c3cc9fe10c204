// Changes between two ticks: instances swapped, inserted, removed, made again; parameters set.
#include <algorithm>
#include <bit>
#include <cmath>

#include "claim.hpp"
#include "parameter_words.hpp"
#include "simulation.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/kinds.hpp"
#include "world_file/params.hpp"
#include "world_file/rows.hpp"

namespace muster {

std::size_t Simulation::find(const std::string& instance) const {
  std::vector<std::string> valid;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    if (instances_[i]->name() == instance) return i;
    valid.push_back(instances_[i]->name());
  }
  throw Error(Exit::invalid_input, "no instance is called " + quote(instance) + which_is(world_, instance, "instance") +
                                       "; " + suggest(instance, valid) +
                                       plugin_hint(instance, whose_plugin(world_.instances, instance)));
}

// Destroys the old instance only after the new one is linked.
void Simulation::replace(std::size_t at, std::unique_ptr<Instance> instance) {
  std::swap(instances_[at], instance);
  try {
    relink();
  } catch (...) {
    std::swap(instances_[at], instance);
    throw;
  }
  take_events(*instances_[at], tick_);
}

void Simulation::swap(const std::string& name, InstanceDeclaration replacement) {
  const auto at = find(name);
  const std::string old = instances_[at]->declared().plugin;
  replacement.name = name;
  guarded([&] { replace(at, make(std::move(replacement))); });
  const auto& plugin = instances_[at]->plugin();
  events_.push_back({tick_, name,
                     "swapped from " + old + " to " + plugin.id +
                         (plugin.cannot_hold ? std::string("; it cannot hold ") + plugin.cannot_hold : "")});
}

void Simulation::insert(InstanceDeclaration declaration, const std::string& before) {
  insert_at(before.empty() ? instances_.size() : find(before), {std::move(declaration)});
}

void Simulation::insert_all(std::vector<InstanceDeclaration> declarations) {
  insert_at(instances_.size(), std::move(declarations));
}

void Simulation::insert_at(std::size_t at, std::vector<InstanceDeclaration> declarations) {
  std::size_t end = at;
  guarded([&] {
    try {
      for (InstanceDeclaration& declaration : declarations) {
        for (const auto& instance : instances_) {
          if (instance->name() == declaration.name)
            throw Error(Exit::invalid_input,
                        "an instance is called " + quote(declaration.name) + " already: " + instance->title());
        }
        instances_.insert(instances_.begin() + static_cast<std::ptrdiff_t>(end), make(std::move(declaration)));
        ++end;
      }
      relink();
    } catch (...) {
      instances_.erase(instances_.begin() + static_cast<std::ptrdiff_t>(at),
                       instances_.begin() + static_cast<std::ptrdiff_t>(end));
      throw;
    }
  });
  for (; at < end; ++at) {
    take_events(*instances_[at], tick_);
    events_.push_back({tick_, instances_[at]->name(), std::string("inserted ") + instances_[at]->plugin().id});
  }
}

void Simulation::remove(const std::string& name) { remove_all({name}); }

void Simulation::remove_all(const std::vector<std::string>& names) {
  std::vector<std::pair<std::ptrdiff_t, std::unique_ptr<Instance>>> gone;
  guarded([&] {
    try {
      for (const std::string& name : names) {
        const auto at = instances_.begin() + static_cast<std::ptrdiff_t>(find(name));
        gone.emplace_back(at - instances_.begin(), std::move(*at));
        instances_.erase(at);
      }
      relink();
    } catch (...) {
      for (; !gone.empty(); gone.pop_back())
        instances_.insert(instances_.begin() + gone.back().first, std::move(gone.back().second));
      throw;
    }
  });
  for (const std::string& name : names) events_.push_back({tick_, name, "removed"});
}

void Simulation::remake(const std::string& name) {
  const auto at = find(name);
  auto params = instances_[at]->params();
  guarded([&] { replace(at, make(instances_[at]->declared())); });
  instances_[at]->params() = std::move(params);
}

namespace {

void check_value(const std::string& path, const muster_param& declared, double value) {
  const auto refuse = [&](const std::string& what) {
    throw Error(Exit::invalid_input, "parameter " + quote(path) + ": " + what);
  };
  const double most = declared.kind == MUSTER_CHOICE ? static_cast<double>(choices(declared).size()) - 1 : declared.max;
  if (!(value >= declared.min && value <= most))
    refuse(print_real(value) + " is out of bounds; expected " + expectation(declared));
  if (declared.kind != MUSTER_REAL && value != std::floor(value))
    refuse(print_real(value) + " is no integer; expected " + expectation(declared));
}

// What was set on the way goes over to a newer build of the plugin where that still has the parameter: of a choice the
// word, whose number may be another. All else is what the attributes and the new defaults say. Throws Error.
void carry_set_values(const Instance& from, Instance& to) {
  for (uint32_t i = 0; i < from.plugin().param_count; ++i) {
    const muster_param& old = from.plugin().params[i];
    const int found = to.find_param(old.name);
    const bool is_set = std::bit_cast<uint64_t>(from.params()[i]) != std::bit_cast<uint64_t>(from.given_params()[i]);
    if (!is_set || found < 0 || !is_settable(old)) continue;
    const muster_param& now = to.plugin().params[found];
    if (!is_settable(now) || (old.kind == MUSTER_CHOICE) != (now.kind == MUSTER_CHOICE)) continue;
    const std::string path = to.name() + '/' + now.name;
    double value = from.params()[i];
    if (old.kind == MUSTER_CHOICE) {
      const auto words = choices(now);
      const std::string word = choices(old).at(static_cast<std::size_t>(value));
      const auto at = std::find(words.begin(), words.end(), word);
      if (at == words.end())
        throw Error(Exit::invalid_input,
                    "parameter " + quote(path) + ": " + quote(word) + " is not a choice; " + suggest(word, words));
      value = static_cast<double>(at - words.begin());
    }
    check_value(path, now, value);
    to.params()[static_cast<std::size_t>(found)] = value;
  }
}

}  // namespace

void Simulation::reload(const std::string& name) {
  const auto at = find(name);
  const InstanceDeclaration declared = instances_[at]->declared();
  const auto key = library_key(declared);
  const auto library = libraries_[key];
  try {
    guarded([&] {
      auto made = make(declared, load_library(declared));
      carry_set_values(*instances_[at], *made);
      replace(at, std::move(made));
    });
  } catch (...) {
    libraries_[key] = library;
    throw;
  }
  events_.push_back({tick_, name, std::string("reloaded ") + instances_[at]->plugin().id});
}

void Simulation::close() {
  batches_.clear();
  instances_.clear();
  throw_destroy_fault();
}

void Simulation::throw_destroy_fault() {
  if (around_.destroy_faults.empty()) return;
  const std::string first = around_.destroy_faults.front();
  around_.destroy_faults.clear();
  throw Error(Exit::plugin_fault, first);
}

bool Simulation::is_claimed(const std::string& set) const {
  return std::any_of(instances_.begin(), instances_.end(), [&](const auto& instance) {
    const auto& claims = instance->claims();
    return std::any_of(claims.begin(), claims.end(), [&](const Claim& claim) { return claim.name.set == set; });
  });
}

bool Simulation::may_join(const std::string& set) const {
  return std::any_of(instances_.begin(), instances_.end(), [&](const auto& instance) {
    const auto& claims = instance->claims();
    return std::any_of(claims.begin(), claims.end(),
                       [&](const Claim& claim) { return claim.name.set == set && (claim.flags & MUSTER_JOINS); });
  });
}

// Drops the private sets of instances that no longer exist, and sets on demand that nobody claims any more.
void Simulation::drop_private_sets() {
  std::vector<std::string> unused;
  for (const auto& entry : board_.sets()) {
    const auto& name = entry.first;
    const auto& set = entry.second;
    const bool is_used = std::any_of(board_.tables().begin(), board_.tables().end(),
                                     [&](const auto& table) { return &table.second->set() == set.get(); });
    const auto* known = standard_set(standard_, name);
    const bool goes = known ? known->on_demand && !is_claimed(name) : name.starts_with("instance/");
    if (goes && !is_used) unused.push_back(name);
  }
  for (const auto& name : unused) board_.drop_set(name);
}

namespace {

// The one column that holds an attribute unchanged, or -1.
int column_of(const Attribute& attribute, std::size_t width) {
  const bool is_number = attribute.param.kind == MUSTER_REAL || attribute.param.kind == MUSTER_CHOICE;
  if (!attribute.store || attribute.count != 1 || !is_number) return -1;
  const auto columns = plain_columns(attribute, width);
  return columns.size() == 1 ? static_cast<int>(columns[0]) : -1;
}

Table* world_table(const Blackboard& board, const std::string& set_quantity) {
  const auto slash = set_quantity.find('/');
  const std::string logical = set_quantity.substr(0, slash) + "/*" + set_quantity.substr(slash);
  Table* base = board.find(logical + "@base");
  return base ? base : board.find(logical);
}

}  // namespace

std::vector<ParameterInfo> Simulation::parameters() const {
  std::vector<ParameterInfo> result;
  for (const auto& instance : instances_) {
    for (uint32_t i = 0; i < instance->plugin().param_count; ++i) {
      const auto& param = instance->plugin().params[i];
      if (is_settable(param)) result.push_back({instance->name() + '/' + param.name, &param, instance->params()[i]});
    }
  }
  for (const auto& row : world_.rows) {
    for (const auto& values : row.values) {
      const Table* table = values.attribute ? world_table(board_, values.table) : nullptr;
      const int column = table ? column_of(*values.attribute, table->width()) : -1;
      if (column < 0) continue;
      const auto at =
          static_cast<std::size_t>(table->set().find(row.name)) * table->width() + static_cast<std::size_t>(column);
      result.push_back({row.set + '/' + row.name + '/' + values.attribute->param.name, &values.attribute->param,
                        table->now().data[at]});
    }
  }
  return result;
}

ParameterInfo Simulation::parameter(const std::string& path) const {
  const auto all = parameters();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& info) { return info.path == path; });
  if (found != all.end()) return *found;
  for (const auto& instance : instances_) {
    if (const std::string fault = fixed_attribute(*instance, path); !fault.empty())
      throw Error(Exit::invalid_input,
                  fault + ", or beside this run one with another (muster compare WORLD " + instance->name() + "=" +
                      instance->declared().plugin + ":" + path.substr(path.rfind('/') + 1) +
                      "=VALUE; in a sweep <vary instance=" + quote(instance->name()) + " plugins=" +
                      quote(instance->declared().plugin + ":" + path.substr(path.rfind('/') + 1) + "=VALUE ...") +
                      "/>)");
  }
  for (const std::string& fault :
       {fixed_attribute_of_row(world_, standard_, path), state_fault(*this, path), fault_of_row(*this, path)}) {
    if (!fault.empty()) throw Error(Exit::invalid_input, fault);
  }
  const std::string owner = path.substr(0, path.rfind('/'));
  const std::string kind = owner.find('/') != owner.npos || owner == path ? "" : which_is(world_, owner);
  throw Error(Exit::invalid_input, unknown_parameter(path, all, whose_plugin(world_.instances, owner)) +
                                       (kind.empty() || has(owner) ? "" : "; it begins with " + quote(owner) + kind));
}

void Simulation::set_parameter(const std::string& path, double value) {
  const auto slash = path.rfind('/');
  const std::string owner = path.substr(0, slash);
  const std::string name = slash == std::string::npos ? "" : path.substr(slash + 1);
  for (const auto& instance : instances_) {
    const int found = instance->name() == owner ? instance->find_param(name) : -1;
    if (found >= 0 && is_settable(instance->plugin().params[found])) {
      check_value(path, instance->plugin().params[found], value);
      instance->params()[static_cast<std::size_t>(found)] = value;
      return;
    }
  }
  for (const auto& row : world_.rows) {
    if (row.set + '/' + row.name != owner) continue;
    for (const auto& values : row.values) {
      if (!values.attribute || name != values.attribute->param.name) continue;
      Table* table = world_table(board_, values.table);
      if (!table || column_of(*values.attribute, table->width()) < 0) continue;
      check_value(path, values.attribute->param, value);
      values.store(
          &value, table->stored().data.data() + static_cast<std::size_t>(table->set().find(row.name)) * table->width());
      return;
    }
  }
  parameter(path);  // throws with the nearest path
}

}  // namespace muster
