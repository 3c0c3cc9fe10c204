// Goes through what the world file plans before the first tick, so that its faults are told then.
#include <algorithm>
#include <set>
#include <utility>

#include "claim.hpp"
#include "link.hpp"
#include "occasions.hpp"
#include "parameter_words.hpp"
#include "simulation.hpp"
#include "text/doubts.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/kinds.hpp"

namespace muster {
namespace {

// The unit of the column that a condition looks at, which is there.
std::string unit_of(const Simulation& run, const Condition& condition) {
  const auto parts = parts_of(condition.path);
  const bool is_link = parts.size() == 5 && parts[0] == "link";
  const auto view = run.table(is_link ? "link/*/" + parts[3] : condition.path.substr(0, condition.path.rfind('/')));
  return view.table->columns()[column_of(run.board(), *view.table, parts.back())].unit;
}

}  // namespace

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
          throw Error(e.exit(), events_[before].message.substr(warning.size()));
        }
      });
    for (std::size_t i = from; i < to; ++i) rehearse(*all[i], there, gone);
  }
  made.clear();
  board_.back_to(mark);
}

void Simulation::rehearse(const Occasion& occasion, const std::vector<Instance*>& there, std::set<std::string>& gone) {
  if (!occasion.when) {
    warn_of_idle(occasion, gone);
    warn_of_steered_nobody(occasion, there, gone);
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
    note("warning: " + occasion.place.text() + ": " + occasion.title + " comes at " +
         print_real(static_cast<double>(occasion.tick) * world_.dt) + " s, and the run ends at " +
         print_real(world_.until()) + " s, so that it never does; expected a time below " + print_real(world_.until()) +
         " s, or a longer run (until)");
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

// A parameter that is set at a time at which its robot has left.
void Simulation::warn_of_steered_nobody(const Occasion& occasion, const std::vector<Instance*>& there,
                                        const std::set<std::string>& gone) {
  for (const auto& planned : occasion.rows) {
    if (planned.kind != RowChange::Kind::set) continue;
    const std::string owner = planned.path.substr(0, planned.path.rfind('/'));
    const auto steers =
        std::find_if(there.begin(), there.end(), [&](const Instance* each) { return each->name() == owner; });
    if (steers == there.end() || (*steers)->bound_row() < 0) continue;
    const std::string& robot = board_.find_set("robot")->names[static_cast<std::size_t>((*steers)->bound_row())];
    if (gone.count(robot))
      note("warning: " + planned.place.text() + ": robot " + quote(robot) + " is not there then, so that " +
           quote(planned.path) + " moves nobody");
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
  const auto meant = std::find_if(there.begin(), there.end(), [&](const Instance* each) {
    return each->phase() == next.phase() && next.phase() != now.phase();
  });
  if (next.phase() != now.phase())
    events_.push_back({0, "",
                       "warning: " + (planned.place.file.empty() ? "" : planned.place.text() + ": ") +
                           "the swap puts " + next.plugin().id + ", of the phase " + phase_name(next.phase()) +
                           ", in the place of " + now.plugin().id + ", of " + phase_name(now.phase()) +
                           ", whose work nobody does then; expected a plugin of " + phase_name(now.phase()) +
                           (meant == there.end() ? ""
                                                 : ", or instance " + quote((*meant)->name()) + " to be swapped, " +
                                                       (*meant)->plugin().id + " of " + phase_name(next.phase()))});
  *found = made.back().get();
}

void Simulation::rehearse(const RowChange& planned, const std::vector<Instance*>& there) const {
  if (planned.kind == RowChange::Kind::join) return;
  if (planned.kind == RowChange::Kind::leave) {
    const Set *set = board_.find_set(planned.sets.front()), *robots = board_.find_set("robot");
    if (planned.sets.size() == 1 && robots->find(planned.row) >= 0)
      throw Error(Exit::invalid_input, quote(planned.row) + " is a robot; expected robot=\"" + planned.row + '"');
    if (planned.sets.size() > 1 && kind_of_name(world_, planned.row, "robot") == "station")
      throw Error(Exit::invalid_input,
                  quote(planned.row) + " is a station; expected <leave station=\"" + planned.row + "\"/>");
    if (!set || set->find(planned.row) < 0) living(planned.sets.front(), planned.row);  // throws with the nearest name
    return;
  }
  for (const Instance* each : there) {  // one that comes later, too
    if (const std::string fault = fixed_attribute(*each, planned.path); !fault.empty())
      throw Error(Exit::invalid_input, fault + ", or here " +
                                           swap_with(each->declared(), planned.path.substr(planned.path.rfind('/') + 1),
                                                     planned.value.value));
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
  value_of(planned, parameter(planned.path));
}

}  // namespace muster
