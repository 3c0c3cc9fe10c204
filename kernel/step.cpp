// One tick: phases in order, batches inside them, and everything taken back if anything fails.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cell_checks.hpp"
#include "simulation.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/kinds.hpp"

namespace muster {
namespace {

uint64_t thread_nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<uint64_t>(now.tv_sec) * 1'000'000'000u + static_cast<uint64_t>(now.tv_nsec);
}

}  // namespace

void Simulation::step() {
  do_planned();
  throw_destroy_fault();
  if (!stood_.empty()) stood_.clear();
  run(tick_ + 1, MUSTER_CONTROL, MUSTER_OBSERVE, 0);
  ++tick_;
  do_conditional();
}

void Simulation::evaluate(uint32_t phase, bool expected) {
  const uint32_t flags = expected ? MUSTER_EXPECTED : 0;
  if (flags != std::exchange(stood_flags_, flags)) stood_.clear();
  all_due_ = true;
  try {
    run(tick_, phase, phase, flags);
  } catch (...) {
    all_due_ = false;
    stood_.clear();
    throw;
  }
  all_due_ = false;
}

void Simulation::run(uint64_t index, uint32_t first, uint32_t last, uint32_t flags) {
  for (auto& [set, rows] : listed_) rows = set->listed;
  muster_tick tick{sizeof(muster_tick), flags, index, static_cast<double>(index) * world_.dt, world_.dt, nullptr};
  try {
    for (auto& batch : batches_) {
      if (batch.phase >= first && batch.phase <= last) run_batch(batch, tick);
    }
  } catch (...) {
    take_back();
    throw;
  }
  finish(index);
}

// True if the instance would write the same as in the last evaluation; if not, it is due, and its inputs are noted.
bool Simulation::is_up_to_date(Instance& instance) {
  uint64_t read = 0;
  for (const Claim& claim : instance.claims()) {
    if (claim.in && claim.in != claim.out) read += claim.in->version();
  }
  const auto [found, first] = stood_.try_emplace(&instance);
  CachedInputs& stood = found->second;
  if (!first && stood.read == read && stood.params == instance.params()) return true;
  stood = {instance.params(), read};
  return false;
}

// Opens the tables with several writers, before any of them steps; step_all() opens the others.
void Simulation::run_batch(Batch& batch, const muster_tick& tick) {
  due_.clear();
  for (Instance* instance : batch.instances) {
    if (all_due_ && is_up_to_date(*instance)) continue;
    if (!all_due_ && instance->every() != 1 && tick.index % instance->every() != 0) continue;
    due_.push_back(instance);
    if (batch.any_shared && !instance->is_direct()) prepare_cells(*instance, tick.index);
  }
  faults_.clear();  // of a tick that was taken back
  step_all(tick);
  if (!faults_.empty()) throw due_[faults_.begin()->first]->failure("step", &tick, faults_.begin()->second);
  for (std::size_t i = 0; batch.any_shared && i < due_.size(); ++i) {
    if (due_[i]->is_direct()) continue;
    const std::string fault = commit_cells(*due_[i], tick.index);
    if (!fault.empty()) throw due_[i]->failure("step", &tick, fault);
  }
  for (const auto& sum : batch.sums) {
    add_up(sum, tick.index);
    check_sum(sum, tick);
  }
  for (Table* table : batch.publish) {
    if (table->begun() && !table->published()) table->publish(tick.index);
  }
}

// Checks a sum for overflow: finite parts may have an infinite sum, if there are two of them.
void Simulation::check_sum(const Sum& sum, const muster_tick& tick) const {
  if (!sum.total->begun() || sum.parts.size() < 2) return;
  const auto& data = sum.total->next().data;
  if (all_finite(data.data(), data.size())) return;
  const auto wrong = std::find_if(data.begin(), data.end(), [](double value) { return !std::isfinite(value); });
  throw Error(Exit::plugin_fault, Place{world_.file.string()},
              "the sum " + quote(sum.total->name()) + " is infinite at tick " + std::to_string(tick.index) +
                  " (t = " + print_real(tick.time) + " s), in row " +
                  std::to_string(static_cast<std::size_t>(wrong - data.begin()) / sum.total->width()));
}

// Threads take instances in any order; none writes another's data, so the results do not depend on it.
void Simulation::step_all(const muster_tick& tick) {
  const auto one = [&](std::size_t i) {
    Instance& instance = *due_[i];
    if (instance.is_direct()) prepare_cells(instance, tick.index);
    instance.bind(tick.index);
    const uint64_t began = options_.costs ? thread_nanoseconds() : 0;
    const bool is_done = instance.step(tick);
    if (options_.costs) instance.cost.nanoseconds += thread_nanoseconds() - began, ++instance.cost.steps;
    std::string fault = is_done ? check_cells(instance, board_) : instance.said();
    if (fault.empty()) return;
    const std::lock_guard lock(faulty_);
    faults_.emplace(i, std::move(fault));
  };
  if (workers_ && due_.size() > 1)
    workers_->each(due_.size(), one);
  else
    for (std::size_t i = 0; i < due_.size(); ++i) one(i);
}

void add_up(const Sum& sum, uint64_t tick) {
  bool fresh = false;
  for (const Table* part : sum.parts) fresh |= part->begun();
  if (!fresh) return;
  sum.total->begin(false, tick);
  auto& total = sum.total->next().data;
  for (std::size_t k = 0; k < sum.parts.size(); ++k) {
    const auto& data = sum.parts[k]->newest().data;
    // From +0 on, which a part of -0 does not change.
    if (k == 0) std::transform(data.begin(), data.end(), total.begin(), [](double value) { return 0.0 + value; });
    for (std::size_t i = 0; k > 0 && i < total.size(); ++i) total[i] += data[i];
  }
}

void Simulation::take_back() {
  for (auto& batch : batches_) {
    for (Table* table : batch.publish) table->take_back();
  }
  for (const auto& [set, rows] : listed_) set->listed = rows;
  for (auto& instance : instances_) {
    instance->joins.clear();
    instance->leaves.clear();
    instance->events.clear();
  }
}

namespace {

void place(Blackboard& board, const Join& join) {
  const auto number = static_cast<std::size_t>(join.set->find(join.name));
  for (const auto& [name, table] : board.tables()) {
    if (&table->set() != join.set) continue;
    table->grow();
    auto& data = table->stored().data;
    const auto width = static_cast<std::ptrdiff_t>(table->width());
    const auto to = data.begin() + static_cast<std::ptrdiff_t>(number) * width;
    if (join.like >= 0) std::copy_n(data.begin() + join.like * width, width, to);
    const std::string quantity = name.substr(name.rfind('/') + 1);
    for (const auto& value : join.values) {
      if (quantity.substr(0, quantity.find('@')) == value.quantity && value.column < table->width())
        to[static_cast<std::ptrdiff_t>(value.column)] = value.value;
    }
  }
}

}  // namespace

// Rows join and leave between two ticks.
void Simulation::finish(uint64_t tick) {
  for (auto& batch : batches_) {
    for (Table* table : batch.publish) table->end_tick();
  }
  for (auto& instance : instances_) {
    if (instance->joins.empty() && instance->leaves.empty() && instance->events.empty()) continue;
    for (const auto& join : instance->joins) {
      join.set->add(join.name, join.like);
      place(board_, join);
      events_.push_back({tick, instance->name(), join.set->name + ' ' + quote(join.name) + " joins"});
    }
    for (const auto& leave : instance->leaves) {
      leave.set->alive[leave.row] = 0;
      events_.push_back(
          {tick, instance->name(), leave.set->name + ' ' + quote(leave.set->names[leave.row]) + " leaves"});
    }
    instance->joins.clear();
    instance->leaves.clear();
    take_events(*instance, tick);
  }
}

namespace {

Set& live_set(const Blackboard& board, const std::string& name) {
  Set* set = board.find_set(name);
  if (set && set->kind == SetKind::live) return *set;
  throw Error(Exit::invalid_input,
              "rows neither join nor leave " + quote(name) + "; expected a live set, such as \"robot\"");
}

std::size_t living_row(const World& world, const Set& set, const std::string& name) {
  const int row = set.find(name);
  if (row >= 0 && set.alive[static_cast<std::size_t>(row)]) return static_cast<std::size_t>(row);
  std::vector<std::string> there;
  for (std::size_t r = 0; r < set.names.size(); ++r) {
    if (set.alive[r]) there.push_back(set.names[r]);
  }
  throw Error(Exit::invalid_input, "no " + set.name + " is called " + quote(name) + which_is(world, name, set.name) +
                                       "; " + suggest(name, there));
}

}  // namespace

void Simulation::join(const std::string& set, const std::string& name, const std::string& like) {
  Set& to = live_set(board_, set);
  const auto row = static_cast<int>(living_row(world_, to, like));
  if (!is_name(name))
    throw Error(Exit::invalid_input, quote(name) + " is not a name; expected letters, digits, _, - and .");
  if (!to.add(name, row))
    throw Error(Exit::invalid_input, "a " + set + " is called " + quote(name) + " already; names are never reused");
  place(board_, {&to, name, row, {}});
  note(set + ' ' + quote(name) + " joins, a copy of " + quote(like));
}

void Simulation::living(const std::string& set, const std::string& name) const {
  living_row(world_, live_set(board_, set), name);
}

void Simulation::leave(const std::string& set, const std::string& name) {
  Set& from = live_set(board_, set);
  from.alive[living_row(world_, from, name)] = 0;
  note(set + ' ' + quote(name) + " leaves");
}

// A chain's stages, too: each of them is what some reader has until its writer steps again.
void Simulation::set_row(const std::string& name, const std::vector<double>& values) {
  const TableView view = table(name);
  const auto refuse = [&](const std::string& what) { throw Error(Exit::invalid_input, quote(name) + ": " + what); };
  if (view.row < 0) refuse("expected one row, such as \"robot/rover/pose\"");
  if (values.size() != view.cols())
    refuse(std::to_string(values.size()) + " values; expected " + std::to_string(view.cols()) + ": " +
           view.table->columns().text());
  for (std::size_t c = 0; c < values.size(); ++c) {
    const Column& column = view.table->columns()[c];
    if (column.bytes) refuse("bytes cannot be set");
    const bool may_be = std::isfinite(values[c]) || (column.nullable && std::isnan(values[c])) ||
                        (column.infinite && std::isinf(values[c]));
    if (!may_be) refuse("the value of " + column.name + " is not finite");
  }
  std::string whole = view.table->name();
  whole = whole.substr(0, whole.find('@'));
  const std::string columns = view.table->columns().text();
  for (const auto& [known, one] : board_.tables()) {
    if (known != whole && !known.starts_with(whole + '@')) continue;
    if (&one->set() != &view.table->set() || one->columns().text() != columns) continue;
    std::copy(
        values.begin(), values.end(),
        one->stored().data.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(view.row) * values.size()));
  }
}

void Simulation::take_events(Instance& instance, uint64_t tick) {
  for (auto& message : instance.events) events_.push_back({tick, instance.name(), std::move(message)});
  instance.events.clear();
}

}  // namespace muster
