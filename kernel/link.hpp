// Links claims to tables, and orders the steps by the dependencies between tables: writers, stages, and readers that
// follow their writers inside a phase.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "instance.hpp"

namespace muster {

// The total of the parts that instances add, in world-file order.
struct Sum {
  Table* total = nullptr;
  std::vector<Table*> parts;
};

// Instances that may step at the same time, and the sums that are complete after them.
struct Batch {
  uint32_t phase = 0;
  std::vector<Instance*> instances;
  bool any_shared = false;  // some write tables beside others, or aside
  std::vector<Sum> sums;
  std::vector<Table*> publish;
};

// Computes the total of what was added in this tick.
void add_up(const Sum& sum, uint64_t tick);

// One quantity, "set/*/quantity", with all its claims.
struct Claimed {
  struct By {
    Instance* instance;
    std::size_t claim;
    Claim& get() const { return instance->claims()[claim]; }
  };
  std::vector<By> writers, adders, modifiers, readers;
  bool is_written() const { return !writers.empty() || !adders.empty() || !modifiers.empty(); }
};

class Linker {
 public:
  // Instances in the order of the world file.
  Linker(const std::vector<Instance*>& instances, const Standard& standard, const World& world, Blackboard& board);

  // Tables that a plugin which joins later will write: they may be read before.
  void promise(const std::set<std::string>& tables) { promised_ = tables; }

  // A plugin that a read, a stage or a record of the world needs and no instance provides: the id of a table's declared
  // provider, and what needs it.
  struct Missing {
    std::string plugin;
    Place needed_at;
    std::string needed_by;
  };
  std::vector<Missing> missing_providers() const;

  // Warns of commands, messages and similar tables written but never read or read before, and of world elements that no
  // plugin reads.
  std::vector<std::string> unread() const;

  // Checks all claims against each other, before anything changes. Throws Error with the names of both sides.
  void check();

  // Makes the tables, with the contents of old tables of the same names, points the claims at them, and orders the
  // steps.
  std::vector<Batch> build();

  // After build(): old tables that no longer have a writer.
  const std::vector<std::string>& dropped() const { return dropped_; }
  const std::map<std::string, Claimed>& claimed() const { return claimed_; }
  // True where elements of the world file give the table its values.
  bool is_given(const std::string& logical) const;

 private:
  void gather();
  bool is_of_the_world(const std::string& logical) const;
  bool is_minded(const std::string& set) const;
  bool is_for_others(const Claimed::By& writer) const;
  bool is_heard(const std::string& logical) const;
  bool is_unheard(const Instance& instance, const Claim& claim) const;
  std::string meant_table(const Instance& instance, const Claim& claim) const;
  void tell_unheard(std::vector<std::string>& told) const;
  void tell_late(std::vector<std::string>& told) const;
  std::vector<std::string> readable() const;
  std::string expected_writer(const TableName& name, const std::string& table) const;
  void check_reads(const std::string& logical, const Claimed& c) const;
  std::string one_of_a_kind(const Claimed::By& one, const Claimed::By& other) const;
  std::string which_of_two(const Claimed::By& one, const Claimed::By& other) const;
  void check_writers(const std::string& logical, const Claimed& c) const;
  void check_columns(const std::string& logical, const Claimed& c) const;
  void check_stages(const std::string& logical, const Claimed& c) const;
  void check_listed(const std::string& logical, const Claimed& c) const;
  void check_carried() const;
  void check_queue_stages(const std::string& logical, const Claimed& c) const;
  void check_joins() const;
  void check_names() const;
  void order();
  [[noreturn]] void report_cycle(const std::vector<Instance*>& stuck) const;

  // The tables that one quantity needs, each with the claim that defines its columns, and its writer or null.
  struct Needed {
    std::string name;
    const Claim* claim;
    const Instance* owner;
  };
  std::vector<Needed> tables_of(const std::string& logical, const Claimed& c) const;
  // The old table whose values a place of tables_of() inherits, or null.
  Table* before(const std::string& logical, const Claimed& c, std::size_t place) const;
  Table& make(const std::string& name, const Claim& claim, Table* before);
  void fill_from_world(Table& table, const TableName& name) const;
  void make_tables(const std::string& logical, const Claimed& c, const std::vector<Table*>& held);
  void point_readers(const std::string& logical, const Claimed& c);
  void see_each_once(const Claimed::By& by) const;
  std::vector<Batch> make_batches();

  const std::vector<Instance*>& instances_;
  const Standard& standard_;
  const World& world_;
  Blackboard& board_;
  std::map<std::string, Claimed> claimed_;
  std::map<std::string, std::vector<Instance*>> listers_;        // of a listed set
  std::map<Instance*, std::map<Instance*, std::string>> waits_;  // predecessors inside the phase, with reasons
  std::map<Instance*, std::size_t> depth_;                       // place inside the phase
  std::vector<std::pair<Sum, std::vector<Instance*>>> sums_;
  std::map<Table*, std::vector<Instance*>> writers_of_;
  std::map<const Table*, int> held_by_;  // of the old tables: the number of new ones that inherit from each
  std::vector<std::string> dropped_;
  std::set<std::string> promised_;
};

}  // namespace muster
