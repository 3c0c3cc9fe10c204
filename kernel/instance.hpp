// An instance of a plugin: its parameters, its claims, and the host through which it calls the kernel.
#pragma once

#include <muster/plugin.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "blackboard.hpp"
#include "callback_watch.hpp"
#include "guarded_views.hpp"
#include "isolation.hpp"
#include "loader/library.hpp"
#include "text/table_cache.hpp"
#include "thread_pool.hpp"
#include "world_file/world.hpp"

namespace muster {

class Instance;

// set/row/quantity@part, taken apart. Private tables have the set "instance/NAME".
struct TableName {
  std::string set, row, quantity, part;
  // "robot/*/pose", without row and part.
  std::string logical() const { return set + "/*/" + quantity; }
  // "robot/leader/pose@stage", as it was claimed.
  std::string text() const { return set + '/' + row + '/' + quantity + (part.empty() ? "" : '@' + part); }
};

struct Claim {
  uint32_t kind = 0, flags = 0;
  TableName name;
  Columns columns;
  int row = -1;                 // the claimed row's number; -1: all rows
  std::unique_ptr<Cells> file;  // a claim on a file's table: its cells

  // Filled by the linker.
  Table* in = nullptr;      // read from: the table, the stage before, or the last publication
  Table* out = nullptr;     // written to
  bool lists = false;       // write: its instance lists the rows of the set anew, by append()
  bool staged = false;      // written aside and copied afterwards: a rest of rows, beside rows of others
  bool direct = false;      // written whole, in place, numbers only: nothing to do after a step
  std::vector<int> others;  // staged: the rows that other instances write
  uint64_t window = 0;      // queue, read or modified: rows that came at a tick > now - window ...
  bool late = false;        // ... or, where its writers come later in a tick, >= now - window
  bool from_start = true;   // queue: it does not step in the SENSE pass before the first tick

  // Of this step.
  std::vector<double> aside;     // staged or appended rows
  std::vector<double> gathered;  // rows of a queue that it has not seen
  std::size_t appended = 0;      // rows appended to `aside`
  struct Put {
    std::size_t row, column;
    Blob blob;
  };
  std::vector<Put> puts;
};

// State outside an instance that the host's calls need.
struct Surroundings {
  const Standard* standard = nullptr;
  const World* world = nullptr;
  Blackboard* board = nullptr;
  Library::SearchPath search_path;
  uint64_t seed = 0;
  std::vector<std::string> destroy_faults;  // failures while instances were destroyed; a destructor cannot throw them
  ThreadPool* workers = nullptr;            // null: one thread
  std::shared_ptr<TableCache> tables{};     // of instances' files
  Isolations isolated{};
};

struct Join {
  Set* set;
  std::string name;
  int like;
  struct Value {
    std::string quantity;
    std::size_t column;
    double value;
  };
  std::vector<Value> values;
};

struct Leave {
  Set* set;
  uint32_t row;
};

// Where the steps of an instance run, if not where it was made.
class Elsewhere {
 public:
  virtual ~Elsewhere() = default;
  // As Instance::step(), after bind(). May throw.
  virtual bool run(const muster_tick& now) = 0;
  // The links between instances have changed, or the names of rows.
  virtual void start_anew() = 0;
  // The run goes on without the instance.
  virtual bool is_given_up() const = 0;
  virtual void give_up(bool given_up) = 0;
};

class Instance {
 public:
  // Checks the attributes against the plugin's declaration and calls create(). Throws Error.
  Instance(InstanceDeclaration declaration, std::shared_ptr<Library> library, Surroundings& around);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  const std::string& name() const { return declared_.name; }
  const InstanceDeclaration& declared() const { return declared_; }
  InstanceDeclaration& declared() { return declared_; }
  const muster_plugin& plugin() const { return *plugin_; }
  const std::shared_ptr<Library>& library() const { return library_; }
  uint32_t phase() const { return plugin_->phase; }
  uint64_t every() const { return declared_.every; }
  // Its element's place, or that of the element that needs it.
  const Place& place() const { return declared_.needed_by.empty() ? declared_.place : declared_.needed_at; }
  // "world.xml:8:3: physics (physics.simbody)"; "world.xml:9:3: radio.links (needed by network)" where it joined.
  std::string title() const;
  // A claim or parameter of the instance does not fit the world: "TITLE: what".
  Error refused(const std::string& what) const { return {Exit::invalid_input, title() + ": " + what}; }

  std::vector<Claim>& claims() { return claims_; }
  const std::vector<Claim>& claims() const { return claims_; }
  std::vector<double>& params() { return params_; }
  const std::vector<double>& params() const { return params_; }
  // As its attributes and the defaults have them, whatever was set since.
  const std::vector<double>& given_params() const { return given_params_; }
  // The parameter's number, or -1.
  int find_param(const std::string& param) const;
  // The row of the set "robot" that the parameter `robot` names, or -1.
  int bound_row() const;

  // Points the views at the tables. Call before step(), after the last change of its inputs.
  void bind(uint64_t tick);
  // One call of step(); its error is kept in failure(). Never throws.
  bool step(const muster_tick& now) noexcept;
  // Whether it is to step in a process of its own; null if not.
  const Isolation* isolation() const { return isolation_ ? &*isolation_ : nullptr; }
  void step_elsewhere(std::unique_ptr<Elsewhere> there) { there_ = std::move(there); }
  void start_anew_elsewhere() {
    if (there_) there_->start_anew();
  }
  bool is_given_up() const { return there_ && there_->is_given_up(); }
  void give_up(bool given_up) {
    if (there_) there_->give_up(given_up);
  }
  // CPU time of its steps, where the run asks for costs.
  struct Cost {
    uint64_t nanoseconds = 0, steps = 0;
  } cost{};
  // Message of the last failed callback, from the plugin or from the kernel on its behalf.
  std::string said() const { return error_.empty() ? "gave no reason" : error_; }
  // The error of a failed callback, whole, and ready for the next call.
  Error failure(const std::string& callback, const muster_tick* tick, const std::string& said);

  // True where all its written claims are direct; set by the linker.
  bool is_direct() const { return direct_; }
  void set_direct(bool direct) { direct_ = direct; }

  std::vector<Join> joins;
  std::vector<Leave> leaves;
  std::vector<std::string> events;  // since the kernel last took them

 private:
  friend struct Host;
  friend class IsolatedStep;
  // Calls a plugin written without plugin.hpp, whose exceptions nothing else catches.
  template <class Body>
  auto guarded(decltype(std::declval<Body>()()) otherwise, Body&& body) noexcept;
  void check_attributes();
  void isolate();
  void create();
  void destroy();
  bool step_here(const muster_tick& now) noexcept;
  bool is_early() const;
  bool is_looked_at() const;
  std::string words_of(const GuardedViews::Fault& fault) const;
  // Implementations of the host's claim() and file(); they throw Error where the host returns -1.
  int claim(uint32_t kind, uint32_t flags, const std::string& table, const std::string& columns);
  int file(const std::string& param, const std::string& columns);
  void gather(Claim& claim, muster_in& view, uint64_t tick);

  InstanceDeclaration declared_;
  std::shared_ptr<Library> library_;
  const muster_plugin* plugin_ = nullptr;
  Surroundings& around_;
  muster_host host_{};
  void* self_ = nullptr;
  std::vector<double> params_, given_params_;
  std::map<std::string, std::string> texts_;  // text and file parameters
  std::map<std::string, Place> places_;       // of given attributes
  std::vector<Claim> claims_;
  std::vector<muster_in> in_;
  std::vector<muster_out> out_;
  std::string title_;  // as it was made, for messages about a callback that crashes or hangs
  // Goes before the title, which the watch of callbacks may be reading.
  struct Settled {
    ~Settled() { settle_callback_watch(); }
  } settled_;
  std::string error_;  // the plugin's message for its failure
  Exit fault_ = Exit::plugin_fault;
  bool refused_ = false;             // the message is the kernel's own refusal
  int64_t tick_ = -1;                // of its last step
  double time_ = 0;                  // [s] of the same
  uint64_t steps_ = 0, before_ = 0;  // of its own; of instances that its library had before
  GuardedViews guarded_views_;
  bool may_wait_ = false;
  bool in_create_ = false, in_step_ = false, direct_ = false;
  const Set* asked_ = nullptr;  // the set of its last query in this step
  std::optional<Isolation> isolation_;
  std::unique_ptr<Elsewhere> there_;  // null: it steps here
};

const char* phase_name(uint32_t phase);

}  // namespace muster
