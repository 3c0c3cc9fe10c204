// What the world file plans: at a tick, or each time that a condition begins to hold.
#include "occasions.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "claim.hpp"
#include "parameter_words.hpp"
#include "simulation.hpp"
#include "text/doubts.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/kinds.hpp"
#include "world_file/params.hpp"

namespace muster {
namespace {

bool precedes(const Place& a, const Place& b) { return std::tie(a.line, a.column) < std::tie(b.line, b.column); }

bool holds(const Condition& condition, double value) {
  switch (condition.relation) {
    case Condition::Relation::below:
      return value < condition.value;
    case Condition::Relation::above:
      return value > condition.value;
    case Condition::Relation::is:
      return value == condition.value;
  }
  return false;
}

// Where the file has the instance first: what is swapped in stands where the first one stood.
const Place& first_place(const World& world, const InstanceDeclaration& declared) {
  for (const auto& instance : world.instances) {
    if (instance.name == declared.name) return instance.place;
  }
  for (const auto& occasion : world.occasions) {
    for (const auto& change : occasion.plugins)
      if (change.kind == PluginChange::Kind::insert && change.instance == declared.name) return change.plugin.place;
  }
  return declared.place;  // not of the file
}

}  // namespace

// "link/base/rover/rssi/rssi" as its parts.
std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '/')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::string column_elsewhere(const Blackboard& board, const Table& table, const std::string& name) {
  std::string found;
  std::size_t count = 0;
  constexpr std::size_t most = 3;
  for (const auto& [path, other] : board.tables()) {
    if (&other->set() != &table.set() || path.find('@') != path.npos || other->columns().find(name) < 0) continue;
    if (++count <= most) found += (found.empty() ? "" : ", ") + path;
  }
  const bool is_turn = name == "yaw" || name == "heading" || name == "theta" || name == "pitch" || name == "roll";
  return (found.empty() ? "" : "; " + quote(name) + " is a column of " + found) +
         (is_turn && table.columns().find("qw") >= 0 ? "; the turn here is the quaternion qw, qx, qy, qz" : "");
}

std::size_t column_of(const Blackboard& board, const Table& table, const std::string& name) {
  const int column = table.columns().find(name);
  if (column >= 0) return static_cast<std::size_t>(column);
  std::vector<std::string> valid;
  for (std::size_t c = 0; c < table.width(); ++c) valid.push_back(table.columns()[c].name);
  throw Error(Exit::invalid_input, "the table " + table.name() + " has no column " + quote(name) + "; " +
                                       suggest(name, valid) + column_elsewhere(board, table, name));
}

// The numbers that a condition looks at: of all rows that are there where its row is a star; of a pair of radios none
// while neither hears the other.
std::vector<double> Simulation::looked_at(const Condition& condition) const {
  auto parts = parts_of(condition.path);
  if (parts.size() < 3)
    throw Error(Exit::invalid_input, quote(condition.path) +
                                         " is no number of a table; expected one such as robot/leader/pose/x, or <at " +
                                         "t=\"SECONDS\"> for a time");
  const std::string column = parts.back();
  parts.pop_back();
  if (parts.size() == 4 && parts[0] == "link") return of_link(parts[1], parts[2], parts[3], column);
  if (parts.size() == 3 && parts[0] == "link" && board_.find("link/*/" + column))
    throw Error(Exit::invalid_input,
                quote(condition.path) + " names a table and no column of it; expected " +
                    quote(condition.path + '/' + board_.find("link/*/" + column)->columns()[0].name));
  const TableView view = table(condition.path.substr(0, condition.path.rfind('/')));
  const Set& set = view.table->set();
  if (!set.is_named() && view.row < 0)
    throw Error(Exit::invalid_input, quote(condition.path) + ": rows of " + set.name +
                                         " have no names; expected a set such as robot, radio or door, or "
                                         "link/FROM/TO/QUANTITY/COLUMN");
  const std::size_t c = column_of(board_, *view.table, column);
  std::vector<double> values;
  for (std::size_t r = 0; r < view.rows(); ++r) {
    const std::size_t row = view.row >= 0 ? static_cast<std::size_t>(view.row) : r;
    if (!set.is_named() || set.alive[row]) values.push_back(view.at(r, c));
  }
  return values;
}

std::vector<double> Simulation::of_link(const std::string& from, const std::string& to, const std::string& quantity,
                                        const std::string& column) const {
  const Set& radios = *board_.find_set("radio");
  for (const auto& name : {from, to}) {
    if (radios.find(name) < 0)
      throw Error(Exit::invalid_input, "no radio is called " + quote(name) + which_is(world_, name, "radio") + "; " +
                                           suggest(name, radios.names));
  }
  const TableView asked = table("link/*/" + quantity), ends = table("link/*/ends"),
                  endpoints = table("endpoint/*/radio");
  const std::size_t c = column_of(board_, *asked.table, column);
  const auto is = [&](double end, const std::string& name) {
    return endpoints.at(static_cast<std::size_t>(end), 0) == radios.find(name);
  };
  std::vector<double> values;
  for (std::size_t r = 0; r < std::min(ends.rows(), asked.rows()); ++r) {
    if (is(ends.at(r, 0), from) && is(ends.at(r, 1), to)) values.push_back(asked.at(r, c));
  }
  return values;
}

// A number that is not there meets no condition: its table may be of a plugin that comes later or went.
bool Simulation::holds_now(const Occasion& occasion) const {
  std::vector<double> values;
  try {
    values = looked_at(*occasion.when);
  } catch (const Error&) {
    return false;
  }
  return std::any_of(values.begin(), values.end(), [&](double value) { return holds(*occasion.when, value); });
}

// Which conditions hold: a function of the tables, so that a restored run goes the same way.
void Simulation::look_at_conditions() {
  held_.assign(world_.occasions.size(), 0);
  for (std::size_t i = 0; i < held_.size(); ++i) {
    if (world_.occasions[i].when) held_[i] = holds_now(world_.occasions[i]);
  }
}

// Does once what is planned for a tick: after a failed one the user may have replaced an instance before the retry.
void Simulation::do_planned() {
  if (tick_ < planned_from_) return;
  std::vector<const Occasion*> due;
  for (const auto& occasion : world_.occasions) {
    if (!occasion.when && occasion.tick == tick_) due.push_back(&occasion);
  }
  happen(due);
  planned_from_ = tick_ + 1;
}

// After a tick: what conditions bring that hold since it, or since what another brought; each at most once a tick.
void Simulation::do_conditional() {
  std::vector<char> happened(world_.occasions.size());
  while (true) {
    std::vector<const Occasion*> due;
    for (std::size_t i = 0; i < world_.occasions.size(); ++i) {
      const Occasion& occasion = world_.occasions[i];
      if (!occasion.when) continue;
      const bool holds = holds_now(occasion);
      if (holds && !held_[i] && !happened[i]) {
        note("it holds that " + occasion.when->text);
        due.push_back(&occasion);
        happened[i] = 1;
      }
      held_[i] = holds;
    }
    if (due.empty()) return;
    happen(due);
  }
}

void Simulation::happen(const std::vector<const Occasion*>& due) {
  std::vector<const PluginChange*> plugins;
  for (const Occasion* occasion : due) {
    for (const auto& planned : occasion->plugins) plugins.push_back(&planned);
  }
  if (!plugins.empty()) change(plugins);
  for (const Occasion* occasion : due) {
    for (const auto& planned : occasion->rows) at_place(planned.place, [&] { change(planned); });
  }
}

bool Simulation::has(const std::string& instance) const {
  return std::any_of(instances_.begin(), instances_.end(), [&](const auto& i) { return i->name() == instance; });
}

// An instance comes where the file has it, so that the order does not depend on when it came.
std::size_t Simulation::place_of(const InstanceDeclaration& planned) const {
  const Place& own = first_place(world_, planned);
  std::size_t at = 0;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    if (precedes(first_place(world_, instances_[i]->declared()), own)) at = i + 1;
  }
  return at;
}

// All of them at once: what one needs another may bring.
void Simulation::change(const std::vector<const PluginChange*>& planned) {
  std::vector<const Instance*> order;
  for (const auto& instance : instances_) order.push_back(instance.get());
  std::vector<std::unique_ptr<Instance>> aside;
  std::vector<Event> told;
  guarded([&] {
    try {
      for (const PluginChange* each : planned) at_place(each->place, [&] { change(*each, aside, told); });
      at_place(planned.back()->place, [&] { relink(); });
    } catch (...) {
      put_back(order, aside);
      throw;
    }
  });
  for (const auto& instance : instances_) {
    if (std::find(order.begin(), order.end(), instance.get()) == order.end()) take_events(*instance, tick_);
  }
  events_.insert(events_.end(), told.begin(), told.end());
}

// What a condition brings again and is there already is left as it is.
void Simulation::change(const PluginChange& planned, std::vector<std::unique_ptr<Instance>>& aside,
                        std::vector<Event>& told) {
  const std::string& name = planned.instance;
  const auto say = [&](const std::string& what) { told.push_back({tick_, name, what}); };
  switch (planned.kind) {
    case PluginChange::Kind::swap: {
      const auto at = find(name);
      InstanceDeclaration replacement = planned.plugin;
      replacement.name = name;
      aside.push_back(std::exchange(instances_[at], make(std::move(replacement))));
      const auto& plugin = instances_[at]->plugin();
      return say("swapped from " + aside.back()->declared().plugin + " to " + plugin.id +
                 (plugin.cannot_hold ? std::string("; it cannot hold ") + plugin.cannot_hold : ""));
    }
    case PluginChange::Kind::insert: {
      if (has(name)) return say("is there already");
      auto made = make(planned.plugin);
      say(std::string("inserted ") + made->plugin().id);
      instances_.insert(instances_.begin() + static_cast<std::ptrdiff_t>(place_of(planned.plugin)), std::move(made));
      return;
    }
    case PluginChange::Kind::remove: {
      if (!has(name)) return say("is not there, and is not removed");
      const auto at = instances_.begin() + static_cast<std::ptrdiff_t>(find(name));
      aside.push_back(std::move(*at));
      instances_.erase(at);
      say("removed");
    }
  }
}

double Simulation::value_of(const RowChange& planned, const ParameterInfo& set) const {
  if (!is_settable(*set.declared))
    throw Error(Exit::invalid_input, "parameter " + quote(planned.path) + ": it is no number; expected a swap");
  return attribute_values(*set.declared, 1, planned.value, {}, [](const Place&, const std::string&) {}).front();
}

void Simulation::change(const RowChange& planned) {
  switch (planned.kind) {
    case RowChange::Kind::set:
      set_parameter(planned.path, value_of(planned, parameter(planned.path)));
      return note("set " + planned.path + " to " + planned.value.value);
    case RowChange::Kind::join:
      for (const auto& name : planned.sets) {
        Set& set = *board_.find_set(name);
        auto& alive = set.alive[static_cast<std::size_t>(set.find(planned.row))];
        if (!alive) note(name + ' ' + quote(planned.row) + " joins");
        alive = 1;
      }
      return;
    case RowChange::Kind::leave:
      for (const auto& name : planned.sets) {
        const Set* set = board_.find_set(name);
        const int row = set ? set->find(planned.row) : -1;
        if (row >= 0 && set->alive[static_cast<std::size_t>(row)]) leave(name, planned.row);
      }
  }
}

}  // namespace muster
