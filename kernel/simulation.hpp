// A running world: instances of plugins around a blackboard, stepped tick by tick, each tick whole or not at all.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "instance.hpp"
#include "link.hpp"
#include "snapshot.hpp"
#include "thread_pool.hpp"
#include "world_file/world.hpp"

namespace muster {

struct Options {
  Library::SearchPath search_path;
  int workers = 1;                        // threads; the results do not depend on their number
  std::vector<InstanceDeclaration> more;  // instances beyond those of the world file, before its own
  std::shared_ptr<TableCache> tables{};   // files that were read already; none: the simulation reads its own
  std::vector<std::shared_ptr<Library>> libraries{};  // shared from the start on, as by share()
  bool costs = false;                                 // measures Instance::cost; takes some 0.3 us a step
  Isolations isolated{};                              // instances that step in processes of their own
};

struct Event {
  uint64_t tick = 0;
  std::string instance;  // "" for the kernel's
  std::string message;
};

// A published table, or one row of it. Valid until the next tick.
struct TableView {
  const Table* table = nullptr;
  int row = -1;  // -1: all rows

  std::size_t rows() const { return row >= 0 ? 1 : table->now().rows; }
  std::size_t cols() const { return table->width(); }
  double at(std::size_t r, std::size_t c) const {
    return table->now().data[(row >= 0 ? static_cast<std::size_t>(row) : r) * cols() + c];
  }
};

// A number that can be set by its path: "radio.multiwall/n", "material/drywall/loss".
struct ParameterInfo {
  std::string path;
  const muster_param* declared = nullptr;
  double value = 0;
};

// Key by which instances share libraries.
std::string library_key(const InstanceDeclaration& declaration);

class Simulation {
 public:
  // Throws Error for the first fault of the world or of a plugin.
  Simulation(World world, const Standard& standard, Options options);
  ~Simulation();

  const World& world() const { return world_; }
  uint64_t tick() const { return tick_; }
  double time() const { return static_cast<double>(tick_) * world_.dt; }
  bool done() const { return tick_ >= world_.ticks; }

  // Runs one tick, after what the world file plans for it, and does what conditions bring that hold since. If a plugin
  // fails it throws Error and restores the state of the tick before.
  void step();
  // Destroys all instances; any of them may fail. Call it last; throws Error.
  void close();
  // Evaluates one phase at the present time, for instance the channel for a fit; time does not pass. If only parameters
  // changed since, it steps only the instances that depend on them, directly or through their inputs.
  void evaluate(uint32_t phase, bool expected);

  // By name: "robot/*/pose", "robot/leader/pose", "link/*/level@radio.multiwall.walls". Throws Error.
  TableView table(const std::string& name) const;
  // None where it is not there, or not any more.
  std::optional<TableView> find_table(const std::string& name) const;
  const Blackboard& board() const { return board_; }

  std::vector<ParameterInfo> parameters() const;
  // Throws Error with the nearest path.
  ParameterInfo parameter(const std::string& path) const;
  void set_parameter(const std::string& path, double value);

  // From outside, between two ticks; the next tick goes on from it. Throws Error, with the run as before.
  // The cells of a named row: "robot/rover/pose".
  void set_row(const std::string& name, const std::vector<double>& values);
  // A row joins a live set as a copy of another; a row leaves. Both are events.
  void join(const std::string& set, const std::string& name, const std::string& like);
  void leave(const std::string& set, const std::string& name);
  // An event of the kernel's.
  void note(std::string message) { events_.push_back({tick_, "", std::move(message)}); }

  // Exchanges an instance's plugin; state carries over by the names of tables, attributes are the new plugin's. Dropped
  // state is listed in the events. If it throws, the run is as before.
  void swap(const std::string& instance, InstanceDeclaration replacement);
  // Inserts an instance before another, or at the end where `before` is empty.
  void insert(InstanceDeclaration declaration, const std::string& before = "");
  void remove(const std::string& instance);
  // Inserts all of them at the end, or none; linked once.
  void insert_all(std::vector<InstanceDeclaration> declarations);
  // Instances of the plugin that name no library of their own run from this one, as long as a reference to it exists.
  void share(const std::shared_ptr<Library>& library) { libraries_[std::string(library->id())] = library; }
  void remove_all(const std::vector<std::string>& instances);
  // Destroys the instance and makes it again; reload also loads its library again from its file.
  void remake(const std::string& instance);
  void reload(const std::string& instance);

  Snapshot snapshot() const;
  void restore(const Snapshot& snapshot);
  uint64_t digest() const { return snapshot().digest(); }

  const std::vector<std::unique_ptr<Instance>>& instances() const { return instances_; }
  const std::vector<Batch>& batches() const { return batches_; }
  const std::vector<Event>& events() const { return events_; }

 private:
  std::unique_ptr<Instance> make(InstanceDeclaration declaration);
  std::unique_ptr<Instance> make(InstanceDeclaration declaration, std::shared_ptr<Library> library);
  std::shared_ptr<Library> library_of(const InstanceDeclaration& declaration);
  std::shared_ptr<Library> load_library(const InstanceDeclaration& declaration);
  void add_providers();
  void check_isolated() const;
  std::string suggest_table(const std::string& name) const;
  std::string of_named_row(const std::string& path, const std::set<std::string>& tables) const;
  void relink();
  std::size_t find(const std::string& instance) const;
  void insert_at(std::size_t at, std::vector<InstanceDeclaration> declarations);
  void replace(std::size_t at, std::unique_ptr<Instance> instance);
  void do_planned();
  void do_conditional();
  void happen(const std::vector<const Occasion*>& due);
  void change(const std::vector<const PluginChange*>& planned);
  void change(const PluginChange& planned, std::vector<std::unique_ptr<Instance>>& aside, std::vector<Event>& told);
  void change(const RowChange& planned);
  double value_of(const RowChange& planned, const ParameterInfo& set) const;
  bool has(const std::string& instance) const;
  std::size_t place_of(const InstanceDeclaration& planned) const;
  std::vector<double> looked_at(const Condition& condition) const;
  std::vector<double> of_link(const std::string& from, const std::string& to, const std::string& quantity,
                              const std::string& column) const;
  bool holds_now(const Occasion& occasion) const;
  void look_at_conditions();
  void rehearse();
  void rehearse(const Occasion& occasion, const std::vector<Instance*>& there, std::set<std::string>& gone);
  void warn_of_idle(const Occasion& occasion, std::set<std::string>& gone);
  void warn_of_steered_nobody(const Occasion& occasion, const std::vector<Instance*>& there,
                              const std::set<std::string>& gone);
  void rehearse(const PluginChange& planned, std::vector<Instance*>& there,
                std::vector<std::unique_ptr<Instance>>& made);
  void rehearse(const RowChange& planned, const std::vector<Instance*>& there) const;
  void living(const std::string& set, const std::string& name) const;  // throws if it is not there
  bool is_claimed(const std::string& set) const;
  bool may_join(const std::string& set) const;  // an instance lets rows of it join
  void drop_private_sets();
  template <class Change>
  void guarded(Change&& change);
  bool put_instances(const Snapshot& snapshot, std::vector<std::unique_ptr<Instance>>& aside);
  void put_back(const std::vector<const Instance*>& order, std::vector<std::unique_ptr<Instance>>& aside);
  std::vector<std::unique_ptr<Instance>> make_planned();
  bool is_to_be_removed(const std::string& instance) const;
  void relink_anew();
  void check_fits(const Snapshot& snapshot) const;
  void put(const Snapshot& snapshot);
  void throw_destroy_fault();

  void run(uint64_t tick, uint32_t first, uint32_t last, uint32_t flags);
  void run_batch(Batch& batch, const muster_tick& tick);
  bool is_up_to_date(Instance& instance);
  void step_all(const muster_tick& tick);
  void check_sum(const Sum& sum, const muster_tick& tick) const;
  void take_back();
  void finish(uint64_t tick);
  void take_events(Instance& instance, uint64_t tick);

  World world_;
  const Standard& standard_;
  Options options_;
  Blackboard board_;
  Surroundings around_;
  std::map<std::string, std::weak_ptr<Library>> libraries_;
  std::unique_ptr<LibraryLoader> loader_;  // while the world is loaded: its libraries share one trial
  std::vector<std::unique_ptr<Instance>> instances_;
  std::vector<Batch> batches_;
  std::vector<Event> events_;
  std::unique_ptr<ThreadPool> workers_;
  uint64_t tick_ = 0;
  uint64_t planned_from_ = 0;  // what is planned for ticks before this one is done
  std::vector<char> held_;     // of each occasion: its condition held after the last tick
  bool all_due_ = false;       // while one phase is evaluated
  // Of each instance in the last evaluation: its parameters, and the sum of its inputs' versions. Empty after anything
  // else has happened.
  struct CachedInputs {
    std::vector<double> params;
    uint64_t read = 0;
  };
  std::map<const Instance*, CachedInputs> stood_;
  uint32_t stood_flags_ = 0;
  std::vector<Instance*> due_;                        // of the batch that steps
  std::map<std::size_t, std::string> faults_;         // of those among them that failed; the first ends the tick
  std::mutex faulty_;                                 // guards faults_
  std::vector<std::pair<Set*, std::size_t>> listed_;  // rows of the listed sets before this tick
  std::vector<std::shared_ptr<Library>> planned_;     // libraries of plugins to come
  std::set<std::string> promised_;                    // tables that they write, or that what is removed wrote
  std::vector<std::string> unread_;                   // warnings of the last link
};

// Runs a change; if it is refused, its rows and sets are removed.
template <class Change>
void Simulation::guarded(Change&& change) {
  const auto mark = board_.mark();
  try {
    change();
  } catch (...) {
    board_.back_to(mark);
    throw;
  }
  drop_private_sets();
}

}  // namespace muster
