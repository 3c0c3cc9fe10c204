#include "instance_code.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <map>
#include <muster/plugin.hpp>
#include <mutex>

#include "kernel/claim.hpp"
#include "text/names.hpp"

namespace muster::python {
namespace {

const std::vector<std::string> phases = {"control", "actuate", "physics", "radio", "network", "sense", "observe"};
const std::vector<std::string> kinds = {"read", "write", "add", "modify"};

uint32_t number_of(const std::string& word, const std::vector<std::string>& words, const std::string& what) {
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end())
    throw Error(Exit::invalid_input, what + " cannot be " + quote(word) + "; " + suggest(word, words));
  return static_cast<uint32_t>(found - words.begin()) + 1;
}

// ---- Code by its number ----

std::mutex guard;
std::map<uint64_t, InstanceCode*>& all_codes() {
  static std::map<uint64_t, InstanceCode*> codes;
  return codes;
}

std::shared_ptr<InstanceCode> code_of(const char* number) {
  const std::lock_guard lock(guard);
  uint64_t key = 0;
  if (number) std::from_chars(number, number + std::strlen(number), key);
  const auto found = all_codes().find(key);
  return found == all_codes().end() ? nullptr : found->second->weak_from_this().lock();
}

// ---- The plugins ----

struct Held {
  const muster_host* host;
  std::shared_ptr<InstanceCode> code;
  uint64_t seed;
};

void* create(const muster_host* host) {
  Held* held = nullptr;
  detail::guarded(host, [&] {
    auto code = code_of(host->text(host, "code"));
    if (!code) throw BadInput("runs code of Python, which lives in the process that made it; expected a function");
    for (const Port& port : code->ports()) {
      if (host->claim(host, port.kind, 0, port.table.c_str(), port.columns.c_str()) < 0) throw std::runtime_error("");
    }
    const uint64_t seed = host->stream(host, code->stream().c_str());
    held = new Held{host, std::move(code), seed};
  });
  return held;
}

void destroy(void* self) { delete static_cast<Held*>(self); }

int step(void* self, const muster_tick* tick, const muster_in* in, const muster_out* out) {
  const Held& held = *static_cast<Held*>(self);
  const bool fine = detail::guarded(held.host, [&] { held.code->step({held.host, tick, in, out, held.seed}); });
  return fine ? MUSTER_OK : MUSTER_FAILED;
}

constexpr Param params[] = {reference("robot", "robot", "the robot that it is bound to"),
                            text("code", "", "number of its code, which only the program that holds it can give")};

template <uint32_t phase>
int register_phase(uint32_t abi, void* registry, muster_add add) {
  static const std::string id = "python." + phases[phase - 1] + "/1";
  static const muster_plugin plugin{sizeof(muster_plugin),
                                    phase,
                                    id.c_str(),
                                    "code of the Python program that holds the simulation",
                                    nullptr,
                                    params,
                                    std::size(params),
                                    nullptr,
                                    create,
                                    destroy,
                                    step,
                                    nullptr,
                                    nullptr,
                                    nullptr,
                                    nullptr,
                                    nullptr};
  return abi == MUSTER_ABI ? add(registry, &plugin) : MUSTER_FAILED;
}

// "set/row/quantity@part" taken apart; "self/quantity" has no row.
TableName name_of(const std::string& table) {
  const std::string path = table.substr(0, table.find('@'));
  const auto first = path.find('/'), last = path.rfind('/');
  if (first == path.npos || (first == last && !path.starts_with("self/")))
    throw Error(Exit::invalid_input, "claims " + quote(table) + "; expected set/row/quantity, such as robot/*/pose");
  return {path.substr(0, first), first == last ? "" : path.substr(first + 1, last - first - 1), path.substr(last + 1),
          ""};
}

uint32_t phase_that_may_write(const std::string& table) {
  const Quantity* quantity = standard_quantity(standard(), name_of(table));
  return quantity && !quantity->sensed ? MUSTER_ACTUATE : MUSTER_CONTROL;  // controllers write no truth
}

}  // namespace

uint32_t phase_of(const std::string& word) { return number_of(word, phases, "a phase"); }

const std::vector<std::shared_ptr<Library>>& own_libraries() {
  static const std::vector<std::shared_ptr<Library>> libraries = {
      Library::of_program(register_phase<MUSTER_CONTROL>), Library::of_program(register_phase<MUSTER_ACTUATE>),
      Library::of_program(register_phase<MUSTER_PHYSICS>), Library::of_program(register_phase<MUSTER_RADIO>),
      Library::of_program(register_phase<MUSTER_NETWORK>), Library::of_program(register_phase<MUSTER_SENSE>),
      Library::of_program(register_phase<MUSTER_OBSERVE>)};
  return libraries;
}

Port::Port(const std::string& kind_word, std::string table_name, std::string given_columns)
    : kind(number_of(kind_word, kinds, "a claim")), table(std::move(table_name)), columns(std::move(given_columns)) {
  const TableName name = name_of(table);
  const SetDeclaration* set = standard_set(standard(), name.set);
  const Quantity* quantity = standard_quantity(standard(), name);
  if (columns.empty()) {
    if (!quantity)
      throw Error(Exit::invalid_input, "claims " + quote(table) +
                                           ", which is no standard table; expected its columns beside it, such as (\"" +
                                           table + "\", \"x[m] y[m]\")");
    columns = quantity->columns;
  }
  is_queue = set && set->kind == SetKind::queue;
  if (is_queue && kind == MUSTER_MODIFY)
    throw Error(Exit::invalid_input, "modifies " + quote(table) + ", which holds messages; expected read and write");
  one_row = !is_queue && name.row != "*";
  one_owner = is_queue && name.row != "*";
  try {
    const Columns parsed(columns);
    for (std::size_t c = 0; c < parsed.size() && bytes < 0; ++c) {
      if (parsed[c].bytes) bytes = static_cast<int>(c);
    }
  } catch (const std::invalid_argument& e) {
    throw Error(Exit::invalid_input, "claims " + quote(table) + ": " + e.what());
  }
}

InstanceCode::InstanceCode(uint32_t phase, std::vector<Port> ports, std::string stream)
    : phase_(phase), ports_(std::move(ports)), stream_(std::move(stream)) {
  const std::lock_guard lock(guard);
  static uint64_t last = 0;
  number_ = ++last;
  all_codes()[number_] = this;
}

InstanceCode::~InstanceCode() {
  const std::lock_guard lock(guard);
  all_codes().erase(number_);
}

InstanceDeclaration InstanceCode::declared(const std::string& name, const std::string& robot, uint64_t every,
                                           const Place& place) const {
  if (!is_name(name))
    throw Error(Exit::invalid_input, quote(name) + " is no name of an instance; expected letters, digits, _ - and .");
  InstanceDeclaration result;
  result.plugin = "python." + phases[phase_ - 1];
  result.name = name;
  result.every = every;
  result.place = place;
  result.attributes.push_back({"code", std::to_string(number_), place, place});
  if (!robot.empty()) result.attributes.push_back({"robot", robot, place, place});
  return result;
}

SetRows::SetRows(const std::string& table) : InstanceCode(phase_that_may_write(table), {Port("write", table, "")}, "") {
  if (ports()[0].is_queue || ports()[0].bytes >= 0)
    throw Error(Exit::invalid_input, quote(table) + " holds messages; expected a function that sends them");
}

void SetRows::set(const double* values, std::size_t count) { values_.assign(values, values + count); }

void SetRows::step(const Call& call) {
  const muster_out& to = call.out[0];
  const std::size_t count = std::size_t{to.rows} * to.cols;
  if (!values_.empty() && values_.size() != count)
    throw BadInput("has " + std::to_string(values_.size()) + " values for " + ports()[0].table + "; expected " +
                   std::to_string(to.rows) + " x " + std::to_string(to.cols));
  std::copy_n(values_.empty() ? call.in[0].data : values_.data(), count, to.data);
}

}  // namespace muster::python
