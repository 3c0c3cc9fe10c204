// What the world file plans: at a tick, or each time that a condition begins to hold.
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "claim.hpp"
#include "simulation.hpp"
#include "text/doubts.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/params.hpp"

namespace muster {
namespace {

// Throws the error of `act` as one of this place in the world file, where it names none itself.
template <class Act>
void at_place(const Place& place, const Act& act) {
  try {
    act();
  } catch (const Error& e) {
    const bool is_placed = e.place().line > 0 || std::string(e.what()).starts_with(place.file + ':');
    throw is_placed ? e : Error(e.exit(), place, e.what());
  }
}

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

std::size_t column_of(const Table& table, const std::string& name) {
  const int column = table.columns().find(name);
  if (column >= 0) return static_cast<std::size_t>(column);
  std::vector<std::string> valid;
  for (std::size_t c = 0; c < table.width(); ++c) valid.push_back(table.columns()[c].name);
  throw Error(Exit::invalid_input,
              "the table " + table.name() + " has no column " + quote(name) + "; " + suggest(name, valid));
}

// The unit of the column that a condition looks at, which is there.
std::string unit_of(const Simulation& run, const Condition& condition) {
  const auto parts = parts_of(condition.path);
  const bool is_link = parts.size() == 5 && parts[0] == "link";
  const auto view = run.table(is_link ? "link/*/" + parts[3] : condition.path.substr(0, condition.path.rfind('/')));
  return view.table->columns()[column_of(*view.table, parts.back())].unit;
}

// What is to be said of a path that is no parameter, but a number that plugins write; "" where it is none.
std::string state_fault(const Simulation& run, const std::string& path) {
  const auto view = run.find_table(path.substr(0, path.rfind('/')));
  if (!view || view->table->columns().find(path.substr(path.rfind('/') + 1)) < 0) return "";
  return quote(path) + " is a state, which plugins write, and no parameter; expected a parameter, such as steer/speed" +
         (path.rfind("robot/", 0) == 0 ? ", or <leave> and a <robot> that joins at another place" : "");
}

}  // namespace

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
  const TableView view = table(condition.path.substr(0, condition.path.rfind('/')));
  const Set& set = view.table->set();
  if (!set.is_named() && view.row < 0)
    throw Error(Exit::invalid_input, quote(condition.path) + ": rows of " + set.name +
                                         " have no names; expected a set such as robot, radio or door, or "
                                         "link/FROM/TO/QUANTITY/COLUMN");
  const std::size_t c = column_of(*view.table, column);
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
      throw Error(Exit::invalid_input, "no radio is called " + quote(name) + "; " + suggest(name, radios.names));
  }
  const TableView asked = table("link/*/" + quantity), ends = table("link/*/ends"),
                  endpoints = table("endpoint/*/radio");
  const std::size_t c = column_of(*asked.table, column);
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
  std::size_t at = 0;
  for (std::size_t i = 0; i < instances_.size(); ++i) {
    if (precedes(instances_[i]->declared().place, planned.place)) at = i + 1;
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
  if (set.declared->kind == MUSTER_REFERENCE)
    throw Error(Exit::invalid_input,
                "parameter " + quote(planned.path) + ": a reference is claimed for good; expected a swap");
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

// Goes through all that is planned in its order, conditions last, without a tick: faults are told before the first one.
void Simulation::rehearse() {
  std::vector<const Occasion*> all;
  for (const auto& occasion : world_.occasions) all.push_back(&occasion);
  std::stable_sort(all.begin(), all.end(), [](const Occasion* a, const Occasion* b) {
    return std::make_pair(a->when.has_value(), a->tick) < std::make_pair(b->when.has_value(), b->tick);
  });
  std::vector<Instance*> there;
  for (const auto& instance : instances_) there.push_back(instance.get());
  std::vector<std::unique_ptr<Instance>> made;
  const auto mark = board_.mark();
  std::set<std::string> gone;  // rows that are not there then, as far as times go
  for (const auto& row : world_.rows) {
    if (row.joins_later) gone.insert(row.name);
  }
  for (std::size_t from = 0, to; from < all.size(); from = to) {
    to = from + 1;  // of one time they happen together
    while (to < all.size() && !all[from]->when && !all[to]->when && all[to]->tick == all[from]->tick) ++to;
    const PluginChange* last = nullptr;
    const auto before = events_.size();
    for (std::size_t i = from; i < to; ++i) {
      for (const auto& planned : all[i]->plugins) {
        at_place(planned.place, [&] { rehearse(planned, there, made); });
        last = &planned;
      }
    }
    if (last)
      at_place(last->place, [&] {
        Linker linker(there, standard_, world_, board_);
        linker.promise(promised_);
        try {
          linker.check();
        } catch (const Error& e) {  // the cause, where a swap has put one in the place of another kind
          if (events_.size() == before) throw;
          const std::string warning = "warning: ";
          throw Error(e.exit(), events_[before].message.substr(warning.size()) + "; " + e.what());
        }
      });
    for (std::size_t i = from; i < to; ++i) rehearse(*all[i], there, gone);
  }
  made.clear();
  board_.back_to(mark);
}

void Simulation::rehearse(const Occasion& occasion, const std::vector<Instance*>& there, std::set<std::string>& gone) {
  if (!occasion.when) warn_of_idle(occasion, gone);
  for (const auto& planned : occasion.rows) {
    if (occasion.when || planned.kind != RowChange::Kind::set) continue;
    const std::string owner = planned.path.substr(0, planned.path.rfind('/'));
    const auto steers =
        std::find_if(there.begin(), there.end(), [&](const Instance* each) { return each->name() == owner; });
    if (steers == there.end() || (*steers)->bound_row() < 0) continue;
    const std::string& robot = board_.find_set("robot")->names[static_cast<std::size_t>((*steers)->bound_row())];
    if (gone.count(robot))
      note("warning: " + planned.place.text() + ": robot " + quote(robot) + " is not there then, so that " +
           quote(planned.path) + " moves nobody");
  }
  for (const auto& planned : occasion.rows) at_place(planned.place, [&] { rehearse(planned, there); });
  if (occasion.when && !promised_.count(table_of(*occasion.when).logical()))
    at_place(occasion.when->place, [&] {
      const Condition& when = *occasion.when;
      looked_at(when);
      const std::string doubt = level_doubt(unit_of(*this, when), static_cast<Compared>(when.relation), when.value);
      if (!doubt.empty()) note("warning: " + when.place.text() + ": attribute \"when\": " + doubt);
    });
  if (!occasion.when && occasion.tick >= world_.ticks)
    note("warning: " + occasion.place.text() + ": " + occasion.title + " comes at the end of the run or after it");
}

// A robot that leaves before it joins, or twice.
void Simulation::warn_of_idle(const Occasion& occasion, std::set<std::string>& gone) {
  for (const auto& planned : occasion.rows) {
    if (planned.kind == RowChange::Kind::join) gone.erase(planned.row);
    if (planned.kind == RowChange::Kind::leave && !gone.insert(planned.row).second)
      note("warning: " + planned.place.text() + ": " + quote(planned.row) +
           " is not there then, and <leave> does nothing");
  }
}

void Simulation::rehearse(const PluginChange& planned, std::vector<Instance*>& there,
                          std::vector<std::unique_ptr<Instance>>& made) {
  const auto found =
      std::find_if(there.begin(), there.end(), [&](const Instance* each) { return each->name() == planned.instance; });
  if (planned.kind == PluginChange::Kind::insert) {
    if (found != there.end()) throw(*found)->refused("is there already");
    made.push_back(make(planned.plugin));
    there.push_back(made.back().get());
    return;
  }
  if (found == there.end())
    throw Error(Exit::invalid_input,
                "no instance is called " + quote(planned.instance) + " then; it has been removed, or comes later");
  if (planned.kind == PluginChange::Kind::remove) {
    there.erase(found);
    return;
  }
  InstanceDeclaration replacement = planned.plugin;
  replacement.name = planned.instance;
  made.push_back(make(std::move(replacement)));
  const Instance &now = **found, &next = *made.back();
  if (next.phase() != now.phase())
    events_.push_back({0, "",
                       "warning: " + planned.place.text() + ": the swap puts " + next.plugin().id + ", of the phase " +
                           phase_name(next.phase()) + ", in the place of " + now.plugin().id + ", of " +
                           phase_name(now.phase()) + ", whose work nobody does then"});
  *found = made.back().get();
}

void Simulation::rehearse(const RowChange& planned, const std::vector<Instance*>& there) const {
  if (planned.kind == RowChange::Kind::join) return;
  if (planned.kind == RowChange::Kind::leave) {
    const Set *set = board_.find_set(planned.sets.front()), *robots = board_.find_set("robot");
    if (planned.sets.size() == 1 && robots->find(planned.row) >= 0)
      throw Error(Exit::invalid_input, quote(planned.row) + " is a robot; expected robot=\"" + planned.row + '"');
    if (!set || set->find(planned.row) < 0) living(planned.sets.front(), planned.row);  // throws with the nearest name
    return;
  }
  for (const Instance* each : there) {  // one that comes later, too
    const auto slash = planned.path.rfind('/');
    const int number = planned.path.substr(0, slash) == each->name() && slash != std::string::npos
                           ? each->find_param(planned.path.substr(slash + 1))
                           : -1;
    if (number < 0) continue;
    value_of(planned, {planned.path, &each->plugin().params[number], 0});
    return;
  }
  const std::string owner = planned.path.substr(0, planned.path.rfind('/'));
  const bool is_there =
      std::any_of(there.begin(), there.end(), [&](const Instance* each) { return each->name() == owner; });
  if (has(owner) && !is_there)
    throw Error(Exit::invalid_input, quote(owner) + " is removed by then, and has no parameters");
  const auto all = parameters();
  const bool is_known =
      std::any_of(all.begin(), all.end(), [&](const ParameterInfo& each) { return each.path == planned.path; });
  const std::string state = is_known ? "" : state_fault(*this, planned.path);
  if (!state.empty()) throw Error(Exit::invalid_input, state);
  value_of(planned, parameter(planned.path));
}

}  // namespace muster
