#include "instance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crash_report.hpp"
#include "fault_words.hpp"
#include "host.hpp"
#include "instance_doubts.hpp"
#include "loader/float_guard.hpp"
#include "loader/process_guard.hpp"
#include "needed_attribute.hpp"
#include "separate_process.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/params.hpp"

namespace muster {
namespace {

constexpr const char* arithmetic_as_it_was = " for the whole process; expected it to leave the arithmetic as it was";
constexpr const char* process_as_it_was = " for the whole process; expected it to leave that as it was";

// Declared so: `wait` says how long it waits for a client or a robot outside. That of a way point is a time of the
// world.
bool waits_for_others(const muster_plugin& plugin) {
  const int wait = find_param(plugin, "wait");
  return wait >= 0 && std::string_view(plugin.params[wait].help).starts_with("how long");
}

}  // namespace

template <class Body>
auto Instance::guarded(decltype(std::declval<Body>()()) otherwise, Body&& body) noexcept {
  try {
    return body();
  } catch (const std::exception& e) {
    error_ = e.what();
  } catch (...) {
    error_ = "threw something that is not a std::exception";
  }
  return otherwise;
}

Instance::Instance(InstanceDeclaration declaration, std::shared_ptr<Library> library, Surroundings& around)
    : declared_(std::move(declaration)), library_(std::move(library)), around_(around), before_(library_->steps()) {
  const auto& plugins = library_->plugins();
  plugin_ = &plugins.back();
  if (declared_.revision) {
    const auto wanted = std::string(library_->id()) + '/' + std::to_string(*declared_.revision);
    const auto found = std::find_if(plugins.begin(), plugins.end(), [&](const auto& p) { return p.id == wanted; });
    if (found == plugins.end())
      throw invalid(declared_.place,
                    "there is no " + wanted + " in " + library_->file().string() + "; the newest is " + plugin_->id);
    plugin_ = &*found;
  }
  check_attributes();
  given_params_ = params_;
  title_ = title();
  may_wait_ = waits_for_others(*plugin_);
  host_ = make_host(*this);
  isolate();
  create();
  in_.resize(claims_.size());
  out_.resize(claims_.size());
}

// A connection is kept by the process that has made it, and another process for its steps may begin at any of them.
void Instance::isolate() {
  const auto& isolated = around_.isolated;
  const auto named = isolated.find(declared_.name), how = named == isolated.end() ? isolated.find("*") : named;
  if (how == isolated.end()) return;
  if (!may_wait_) return void(isolation_ = how->second);
  const std::string why = "a connection to what it waits for would end with a process of its own";
  if (how == named) throw refused("cannot be isolated: " + why + "; expected --isolate without its name");
  events.push_back("note: steps in the process of the run: " + why);
}

namespace {

// How a process of its own ended in which the callback was tried; "" where it came back.
template <class Callback>
std::string trial(const Isolation& how, const Callback& callback) {
  return SeparateProcess(0, [&](std::byte*) { callback(); }).call(how.limit);
}

}  // namespace

void Instance::create() {
  const ProcessGuard guard;
  in_create_ = true;
  if (isolation_) {
    const std::string ended = trial(*isolation_, [&] { plugin_->create(&host_); });
    if (!ended.empty()) throw failure("create", nullptr, "its own process " + ended);
  }
  self_ = guarded(nullptr, [&] {
    const RunningCallback running(title_.c_str(), "create", -1, 0, may_wait_);
    return plugin_->create(&host_);
  });
  in_create_ = false;
  if (const std::string changed = guard.what(); !changed.empty()) error_ = changed + process_as_it_was;
  if (!self_ || !error_.empty()) {
    const Error error = failure("create", nullptr, said());
    if (self_) plugin_->destroy(self_);
    throw Error(error);
  }
  for (const std::string& doubt : library_->doubts()) events.push_back("warning: " + place().text() + ": " + doubt);
}

Instance::~Instance() {
  there_.reset();
  if (self_) destroy();
  library_->add_steps(steps_);
}

void Instance::destroy() {
  error_.clear();
  if (isolation_) {
    const std::string ended = trial(*isolation_, [&] { plugin_->destroy(self_); });
    if (!ended.empty())
      return around_.destroy_faults.push_back(failure("destroy", nullptr, "its own process " + ended).what());
  }
  FloatGuard guard;
  const bool fine = guarded(false, [&] {
    const RunningCallback running(title_.c_str(), "destroy", -1);
    return plugin_->destroy(self_), true;
  });
  if (guard.changed()) error_ = guard.what() + arithmetic_as_it_was;
  if (!fine || !error_.empty()) around_.destroy_faults.push_back(failure("destroy", nullptr, said()).what());
}

std::string Instance::title() const {
  return place().text() + ": " + declared_.name + " (" +
         (declared_.needed_by.empty() ? declared_.plugin : "needed by " + declared_.needed_by) + ')';
}

int Instance::find_param(const std::string& param) const { return muster::find_param(*plugin_, param); }

int Instance::bound_row() const {
  const int param = find_param("robot");
  const bool refers = param >= 0 && plugin_->params[param].kind == MUSTER_REFERENCE;
  return refers ? static_cast<int>(params_[static_cast<std::size_t>(param)]) : -1;
}

namespace {

// The time of a tick to a hundredth of it at least, without the digits that 3 * 0.1 has beyond 0.3.
std::string print_time(const muster_tick& tick, double dt) {
  double parts = 1;  // of a second: a power of ten
  while (parts * dt < 100 && parts < 1e12) parts *= 10;
  return print_real(std::round(tick.time * parts) / parts);
}

}  // namespace

Error Instance::failure(const std::string& callback, const muster_tick* tick, const std::string& said) {
  const Exit fault = std::exchange(fault_, Exit::plugin_fault);
  error_.clear();
  if (std::exchange(refused_, false)) return Error(fault, said);  // it includes its place
  // Of a fault of the user's in create() or in the first step it says nothing that it came then: it was wrong before.
  const bool is_early = fault == Exit::invalid_input && tick && tick->index <= 1;
  const std::string where =
      tick ? " at tick " + std::to_string(tick->index) + " (t = " + print_time(*tick, around_.world->dt) + " s)" : "";
  const std::string words = with_names(with_declared(in_one_line(said), *plugin_), *around_.board, *around_.world);
  // What is wrong in a file of the user's is told at its own place, whoever found it.
  const bool is_users = fault == Exit::invalid_input && (!tick || is_early);
  if (const XmlAttribute* named = is_users ? attribute_of(words, declared_) : nullptr) {
    const int number = find_param(named->name);
    const std::size_t row = number >= 0 && plugin_->params[number].kind == MUSTER_FILE ? row_in_file(words) : 0;
    if (row == 0) return Error(fault, named->value_place, words);
    const std::filesystem::path given = named->value, folder = around_.world->file.parent_path();
    const Place at{(given.is_absolute() ? given : folder / given).string(), static_cast<int>(row) + 1, 0};  // + header
    return Error(fault, at, words.substr(words.find("\": ") + 3));
  }
  if (is_users && has_place(words)) return Error(fault, as_given(words, *around_.world, around_.search_path));
  return Error(fault, title() + ": " + (is_users ? "" : callback + " failed" + where + ": ") + words);
}

// Collects the rows of a queue that this claim has not seen; only those of its own row where it claims one.
void Instance::gather(Claim& claim, muster_in& view, uint64_t tick) {
  const Cells& cells = claim.in->now();
  const uint64_t last = tick > claim.window ? tick - claim.window : 0;  // its last step
  const bool is_first = tick == 0 || (last == 0 && claim.from_start);
  const auto is_new = [&](uint64_t came) { return claim.late || is_first ? came >= last : came > last; };
  const auto width = claim.in->width();
  claim.gathered.clear();
  for (std::size_t r = 0; r < cells.rows; ++r) {
    const double* row = cells.data.data() + r * width;
    if (is_new(cells.appended[r]) && (claim.row < 0 || row[0] == claim.row))
      claim.gathered.insert(claim.gathered.end(), row, row + width);
  }
  view = {claim.gathered.data(), static_cast<uint32_t>(claim.gathered.size() / width), static_cast<uint32_t>(width),
          cells.tick};
}

void Instance::bind(uint64_t tick) {
  for (std::size_t i = 0; i < claims_.size(); ++i) {
    Claim& claim = claims_[i];
    const auto width = static_cast<uint32_t>(claim.columns.size());
    if (claim.direct) {
      const Cells& now = claim.in->now();
      Cells& next = claim.out->next();
      in_[i] = {now.data.data(), static_cast<uint32_t>(now.rows), width, now.tick};
      out_[i] = {next.data.data(), static_cast<uint32_t>(next.rows), width};
      continue;
    }
    const Cells* cells = claim.in ? &claim.in->now() : claim.file.get();
    const bool is_queue = claim.in && claim.in->set().kind == SetKind::queue;
    if (is_queue && claim.kind != MUSTER_WRITE) {
      gather(claim, in_[i], tick);
    } else if (!cells || is_queue) {
      in_[i] = {nullptr, 0, width, 0};
    } else if (claim.row >= 0) {
      in_[i] = {cells->data.data() + static_cast<std::size_t>(claim.row) * width, 1, width, cells->tick};
    } else {
      in_[i] = {cells->data.data(), static_cast<uint32_t>(cells->rows), width, cells->tick};
    }
    if (!claim.out) continue;
    Cells& next = claim.out->next();
    if (claim.staged) {
      out_[i] = {claim.aside.data(), static_cast<uint32_t>(next.rows), width};
    } else if (claim.lists || claim.out->set().kind == SetKind::queue) {
      out_[i] = {nullptr, 0, width};
    } else if (claim.row >= 0) {
      out_[i] = {next.data.data() + static_cast<std::size_t>(claim.row) * width, 1, width};
    } else {
      out_[i] = {next.data.data(), static_cast<uint32_t>(next.rows), width};
    }
  }
}

bool Instance::step(const muster_tick& now) noexcept {
  if (!there_) return step_here(now);
  error_.clear();
  const RunningCallback running(title_.c_str(), "step", static_cast<int64_t>(now.index), now.time, may_wait_);
  return guarded(false, [&] { return there_->run(now); });
}

namespace {

// std::has_single_bit counts all bits, by a call where the processor may be of before 2008.
constexpr bool is_power_of_two(uint64_t number) { return (number & (number - 1)) == 0; }

}  // namespace

// The first step of each instance is one, and then the second, fourth, eighth, ... since the library was loaded: who
// makes an instance anew for every few steps, as a search over causes does, has seen the same code at work before.
bool Instance::is_early() const { return steps_ == 1 || is_power_of_two(before_ + steps_); }

// Some steps take place between guards, all of the first and ever fewer later; of those whose tables are large, which
// are copied, fewer from the start. Where it steps in a process of its own, it can write into nothing of others.
bool Instance::is_looked_at() const {
  constexpr uint64_t all = 16, one_of = 4096;
  constexpr std::size_t large = 1 << 16;  // cells
  if (there_) return false;
  if (is_early()) return true;
  const uint64_t steps = before_ + steps_;
  return (steps <= all || steps % one_of == 0) && GuardedViews::cells_of(in_, out_) < large;
}

std::string Instance::words_of(const GuardedViews::Fault& fault) const {
  if (fault.words.empty()) return "";
  const TableName& name = claims_[fault.claim].name;
  const bool is_private = name.set == "instance/" + this->name();
  return fault.words + ' ' + quote(is_private ? "self/" + name.quantity : name.text()) +
         "; expected writes into the cells of its own rows alone, until step() returns";
}

bool Instance::step_here(const muster_tick& now) noexcept {
  const double dt = around_.world->dt * static_cast<double>(every());
  const muster_tick tick{sizeof(muster_tick), now.flags, now.index, now.time, dt, params_.data()};
  error_.clear();  // of a step that was taken back
  fault_ = Exit::plugin_fault;
  refused_ = false;
  static thread_local const FloatGuard guard;  // as this thread was before any plugin ran on it
  in_step_ = true;
  asked_ = nullptr;
  tick_ = static_cast<int64_t>(now.index);
  time_ = now.time;
  const RunningCallback running(title_.c_str(), "step", tick_, now.time, may_wait_);
  ++steps_;
  // The rest of the process is looked at in early steps, where no other instance steps beside it.
  std::unique_ptr<ProcessGuard> process;
  if (is_early() && !there_ && !around_.workers) process = std::make_unique<ProcessGuard>();
  if (is_looked_at()) guarded_views_.open(in_, out_);
  const bool fine =
      guarded(MUSTER_FAILED, [&] { return plugin_->step(self_, &tick, in_.data(), out_.data()); }) == MUSTER_OK;
  in_step_ = false;
  if (guarded_views_.keeps_any() || guarded_views_.is_open()) {
    std::string beside = words_of(guarded_views_.written_since());
    if (guarded_views_.is_open()) beside += words_of(guarded_views_.close());
    if (!beside.empty() && error_.empty()) error_ = beside;
  }
  if (guard.changed()) {
    error_ = guard.what() + arithmetic_as_it_was;
    guard.restore();
    return false;
  }
  if (process) {
    if (const std::string changed = process->what(); !changed.empty())
      return error_ = changed + process_as_it_was, false;
  }
  return fine && error_.empty();
}

const char* phase_name(uint32_t phase) {
  static const char* names[] = {"no phase", "CONTROL", "ACTUATE", "PHYSICS", "RADIO", "NETWORK", "SENSE", "OBSERVE"};
  return names[phase <= MUSTER_OBSERVE ? phase : 0];
}

}  // namespace muster
