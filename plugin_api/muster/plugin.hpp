// C++ wrapper of plugin.h: header-only and C++17, so nothing here is part of the ABI.
#pragma once

#include <muster/plugin.h>

#include <cstring>
#include <exception>
#include <initializer_list>
#include <iterator>
#include <muster/first_bytes.hpp>
#include <muster/plugin_traits.hpp>
#include <muster/random.hpp>
#include <muster/rows.hpp>
#include <muster/tables.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace muster {

// ---- Values -------------------------------------------------------------------------------------------------------

inline double null() {
  const uint64_t bits = MUSTER_NULL_BITS;
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}
inline bool is_null(double value) { return value != value; }

// Claimed tables: the row type travels with the index, so step() cannot read one as another.
template <class Row>
struct In {
  int index = -1;  // until a constructor sets it
};
template <class Row>
struct Out {
  int index = -1;  // until a constructor sets it
};
template <class Row>
struct Stage {
  int index = -1;  // until a constructor sets it
};

// A declared number: its place among the declarations. `k[n]` is its value in this step.
struct Value {
  int index = -1;  // until a constructor sets it
};

// Thrown where the user's input is wrong rather than the plugin: a parameter, a file.
struct BadInput : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// ---- Callbacks ----------------------------------------------------------------------------------------------------

// Calls available to a constructor. Each throws when the kernel refuses it; the kernel already has the message.
class Setup {
 public:
  Setup(const muster_host* host, const muster_param* params, uint32_t count)
      : host_(host), params_(params), count_(count), used_(count, false) {}

  template <class Row>
  In<Row> read(const std::string& table, uint32_t flags = 0) {
    return {claim<Row>(MUSTER_READ, flags, table)};
  }
  template <class Row>
  In<Row> read_if_any(const std::string& table) {
    return read<Row>(table, MUSTER_OPTIONAL);
  }
  template <class Row>
  Out<Row> write(const std::string& table, uint32_t flags = 0) {
    return {claim<Row>(MUSTER_WRITE, flags, table)};
  }
  template <class Row>
  Out<Row> add(const std::string& table) {
    return {claim<Row>(MUSTER_ADD, 0, table)};
  }
  template <class Row>
  Stage<Row> modify(const std::string& table) {
    return {claim<Row>(MUSTER_MODIFY, 0, table)};
  }
  // The CSV file that a parameter names; Row::columns are its columns.
  template <class Row>
  In<Row> file(const char* param) {
    use(param);
    detail::check_row_type<Row>();
    return {claimed(host_->file(host_, param, detail::column_names<Row>()))};
  }

  // A number that step() reads as k[value], so that changing it needs no new instance.
  Value value(const char* name) const {
    const Value found = declared(name);
    const uint32_t kind = params_[found.index].kind;
    if (kind == MUSTER_TEXT || kind == MUSTER_FILE)
      throw std::runtime_error(std::string("parameter \"") + name + "\" is " +
                               (kind == MUSTER_TEXT ? "a text" : "a file") + ", and no number; expected s.text(\"" +
                               name + "\"), in the constructor");
    return found;
  }
  double param(const char* name) const {
    use(name);
    return host_->param(host_, name);
  }
  // A text or file parameter by its name, or a text of the world by its path; "" where there is none.
  std::string text(const std::string& path) const {
    if (path.find('/') == path.npos) declared(path.c_str());  // throws where it is not
    const char* found = host_->text(host_, path.c_str());
    return found ? found : "";
  }
  // Reports "warning: FILE:LINE:COLUMN: message", with the place of a row ("robot/leader") or of the instance ("self").
  void warn(const std::string& row, const std::string& message) const { detail::warn(host_, row, message); }
  Stream stream(const char* name) const { return Stream(host_->stream(host_, name)); }
  // Whose calls may look at any parameter.
  const muster_host* host() const {
    used_.assign(count_, true);
    return host_;
  }

  // A number or text that the world file gives and no call has looked at, by its name; null if there is none.
  const char* unused() const {
    for (uint32_t i = 0; i < count_; ++i) {
      const std::string place = std::string("self/place/") + params_[i].name;
      if (!used_[i] && params_[i].kind != MUSTER_REFERENCE && host_->text(host_, place.c_str())) return params_[i].name;
    }
    return nullptr;
  }

 private:
  void use(const char* name) const {
    for (uint32_t i = 0; i < count_; ++i) {
      if (!std::strcmp(params_[i].name, name)) used_[i] = true;
    }
  }
  Value declared(const char* name) const {
    use(name);
    for (uint32_t i = 0; i < count_; ++i) {
      if (!std::strcmp(params_[i].name, name)) return {static_cast<int>(i)};
    }
    throw std::logic_error(std::string("parameter \"") + name + "\" is used but not declared");
  }
  template <class Row>
  int claim(uint32_t kind, uint32_t flags, const std::string& table) {
    detail::check_row_type<Row>();
    return claimed(host_->claim(host_, kind, flags, table.c_str(), detail::column_names<Row>()));
  }
  static int claimed(int index) {
    if (index < 0) throw std::runtime_error("");
    return index;
  }
  const muster_host* host_;
  const muster_param* params_;
  uint32_t count_;
  mutable std::vector<bool> used_;  // of params_
};

namespace detail {

[[noreturn]] inline void refuse_unset(const char* kind, const char* call) {
  throw std::runtime_error(std::string("step() uses ") + kind + " that the constructor never set; expected MEMBER(" +
                           call + ") among its initialisers");
}
inline int set_index(int index, const char* kind, const char* call) {
  if (index < 0) refuse_unset(kind, call);
  return index;
}

}  // namespace detail

// Calls available to step().
class Step {
 public:
  Step(const muster_host* host, const muster_tick* tick, const muster_in* in, const muster_out* out)
      : host_(host), tick_(tick), in_(in), out_(out) {}

  template <class Row>
  Rows<const Row> operator[](In<Row> t) const {
    const int index = detail::set_index(t.index, "an In", "s.read<Row>(\"SET/ROW/QUANTITY\")");
    return {in_[index].data, in_[index].rows, index};
  }
  template <class Row>
  Rows<Row> operator[](Out<Row> t) const {
    const int index = detail::set_index(t.index, "an Out", "s.write<Row>(\"SET/ROW/QUANTITY\")");
    return {out_[index].data, out_[index].rows, index};
  }
  template <class Row>
  Rows<Row> operator[](Stage<Row> t) const {
    const int index = detail::set_index(t.index, "a Stage", "s.modify<Row>(\"SET/ROW/QUANTITY\")");
    return {out_[index].data, out_[index].rows, index};
  }
  // Rows that an Out claim last published, or that precede a Stage.
  template <class Row>
  Rows<const Row> last(Out<Row> t) const {
    return {in_[t.index].data, in_[t.index].rows, t.index};
  }
  template <class Row>
  Rows<const Row> before(Stage<Row> t) const {
    return {in_[t.index].data, in_[t.index].rows, t.index};
  }
  double operator[](Value v) const { return tick_->params[detail::set_index(v.index, "a Value", "s.value(\"NAME\")")]; }

  double time() const { return tick_->time; }
  double dt() const { return tick_->dt; }
  uint64_t tick() const { return tick_->index; }
  bool expected() const { return tick_->flags & MUSTER_EXPECTED; }

  // Queues and listed sets: appends `rows` more rows, to be filled.
  template <class Row>
  Rows<Row> append(Out<Row> t, std::size_t rows) const {
    return {host_->append(host_, t.index, static_cast<uint32_t>(rows)), rows, t.index};
  }
  template <class Row>
  std::string_view bytes(In<Row> t, std::size_t row, unsigned column) const {
    return bytes_at(t.index, row, column);
  }
  // Bytes of a cell that an Out claim last published.
  template <class Row>
  std::string_view last_bytes(Out<Row> t, std::size_t row, unsigned column) const {
    return bytes_at(t.index, row, column);
  }
  template <class Row>
  void put_bytes(Out<Row> t, std::size_t row, unsigned column, std::string_view data) const {
    host_->put_bytes(host_, t.index, static_cast<uint32_t>(row), column, reinterpret_cast<const uint8_t*>(data.data()),
                     data.size());
  }
  // Appends a message to a queue whose row type names its payload_column, with the payload; the other cells are to be
  // filled.
  template <class Row>
  Row& send(Out<Row> t, std::size_t row, std::string_view payload) const {
    Row* made = append(t, 1).begin();
    put_bytes(t, row, Row::payload_column, payload);
    return *made;
  }
  // A stage of a queue: reads the bytes of the stage before, writes those that go on.
  template <class Row>
  std::string_view bytes(Stage<Row> t, std::size_t row, unsigned column) const {
    return bytes_at(t.index, row, column);
  }
  template <class Row>
  Row& send(Stage<Row> t, std::size_t row, std::string_view payload) const {
    return send(Out<Row>{t.index}, row, payload);
  }

  uint32_t rows(const char* set) const { return host_->rows(host_, set); }
  std::string_view name(const char* set, std::size_t row) const {
    const char* found = host_->row_name(host_, set, static_cast<uint32_t>(row));
    return found ? found : "";
  }
  uint64_t key(const char* set, std::size_t row) const {
    return host_->row_key(host_, set, static_cast<uint32_t>(row));
  }
  bool alive(const char* set, std::size_t row) const {
    return host_->row_alive(host_, set, static_cast<uint32_t>(row));
  }
  void event(const std::string& message) const { host_->event(host_, message.c_str()); }
  // Reports "warning: FILE:LINE:COLUMN: message", with the place of a row ("robot/leader") or of the instance ("self").
  void warn(const std::string& row, const std::string& message) const { detail::warn(host_, row, message); }
  const muster_host* host() const { return host_; }

 private:
  std::string_view bytes_at(int claim, std::size_t row, unsigned column) const {
    uint64_t count = 0;
    const uint8_t* data = host_->get_bytes(host_, claim, static_cast<uint32_t>(row), column, &count);
    return {reinterpret_cast<const char*>(data), count};
  }

  const muster_host* host_;
  const muster_tick* tick_;
  const muster_in* in_;
  const muster_out* out_;
};

// ---- Descriptors --------------------------------------------------------------------------------------------------

namespace detail {

// Turns every exception into an error code: none crosses the ABI.
template <class Body>
bool guarded(const muster_host* host, Body&& body) noexcept {
  try {
    body();
    return true;
  } catch (const BadInput& e) {
    host->refuse(host, e.what());
  } catch (const NoRow& e) {
    const char* table = host->text(host, ("self/claim/" + std::to_string(e.claim)).c_str());  // null: an older kernel
    host->error(host, in_words(e, table).c_str());
  } catch (const std::runtime_error& e) {
    if (*e.what()) host->error(host, e.what());
  } catch (const std::exception& e) {
    if (*e.what()) host->error(host, unexpected(e).c_str());
  } catch (...) {
    host->error(host, "threw something that is not a std::exception");
  }
  return false;
}

template <class Plugin, class = void>
constexpr bool calls_them_parameters = false;
template <class Plugin>
constexpr bool calls_them_parameters<Plugin, std::void_t<decltype(Plugin::parameters)>> = true;

template <class Plugin, class = void>
struct Params {
  static_assert(!calls_them_parameters<Plugin>,
                "a plugin's declarations are called params: static constexpr muster::Param params[] = {...};");
  static constexpr const Param* data = nullptr;
  static constexpr uint32_t count = 0;
};
template <class Plugin>
struct Params<Plugin, std::void_t<decltype(Plugin::params)>> {
  static constexpr const Param* data = std::data(Plugin::params);
  static constexpr uint32_t count = static_cast<uint32_t>(std::size(Plugin::params));
};
static_assert(sizeof(Param) == sizeof(muster_param), "an array of one is an array of the other");

template <class Plugin>
struct Held {
  Held(const muster_host* its_host, Setup& setup) : host(its_host), plugin(setup), first(plugin) {}
  const muster_host* host;
  Plugin plugin;
  FirstBytes<Plugin, has_const_step<Plugin> && !keeps_only_caches_of<Plugin>> first;
};

template <class Plugin>
void* create(const muster_host* host) {
  Held<Plugin>* made = nullptr;
  guarded(host, [&] {
    Setup setup(host, Params<Plugin>::data, Params<Plugin>::count);
    made = new Held<Plugin>(host, setup);
    if (!has_const_step<Plugin> && !keeps_only_caches_of<Plugin>)
      warn_of_state(host, "is not const", "void step(const Step& k) const");
    const auto has_any = [](std::initializer_list<const void*> parts) {
      for (const void* part : parts)
        if (part) return true;
      return false;
    };
    // A law, a draw and the like have functions of their own that take the parameters.
    const bool is_plain =
        !has_any({cause_of<Plugin>, draw_of<Plugin>, law_of<Plugin>, clip_of<Plugin>, burst_of<Plugin>});
    if (const char* name = is_plain ? setup.unused() : nullptr) warn_of_unused(host, name);
  });
  return made;
}

template <class Plugin>
void destroy(void* self) {
  auto* held = static_cast<Held<Plugin>*>(self);
  guarded(held->host, [&] { delete held; });
}

template <class Plugin>
int step(void* self, const muster_tick* tick, const muster_in* in, const muster_out* out) {
  auto* held = static_cast<Held<Plugin>*>(self);
  const auto body = [&] {
    if constexpr (has_step<Plugin>) held->plugin.step(Step(held->host, tick, in, out));  // else one error says it
    if (held->first.are_changed(held->plugin))
      warn_of_state(held->host, "changes a member, though it is const", "no member that is mutable");
  };
  return guarded(held->host, body) ? MUSTER_OK : MUSTER_FAILED;
}

template <class Plugin>
const muster_plugin* descriptor() {
  static_assert(has_id<Plugin>, "a plugin needs a public: static constexpr auto id = \"radio.mine/1\";");
  static_assert(has_summary<Plugin>, "a plugin needs a public: static constexpr auto summary = \"what it does\";");
  static_assert(has_phase<Plugin>, "a plugin needs a public: static constexpr auto phase = MUSTER_RADIO;");
  static_assert(std::is_constructible_v<Plugin, Setup&>, "a plugin needs a public: explicit NAME(muster::Setup& s)");
  static_assert(has_step<Plugin>, "a plugin needs a public: void step(const muster::Step& k) const");
  static const muster_plugin result{sizeof(muster_plugin), Plugin::phase,          Plugin::id,
                                    Plugin::summary,       manual_of<Plugin>,      Params<Plugin>::data,
                                    Params<Plugin>::count, cannot_hold_of<Plugin>, create<Plugin>,
                                    destroy<Plugin>,       step<Plugin>,           cause_of<Plugin>,
                                    draw_of<Plugin>,       law_of<Plugin>,         clip_of<Plugin>,
                                    burst_of<Plugin>};
  return &result;
}

}  // namespace detail
}  // namespace muster

// Ends a plugin's file. One struct, one shared object:
//   static constexpr auto id = "radio.mine/1", summary = "...";  static constexpr auto phase = MUSTER_RADIO;
//   static constexpr muster::Param params[] = {...};  optional, as are `manual`, `cannot_hold`, `cause`, `draw`, `law`,
//   `clip`, `burst`
//   explicit Plugin(muster::Setup&);                  claims
//   void step(const muster::Step&) const;             a step that changes a member is warned of, unless it has
//   static constexpr bool keeps_only_caches = true;   members hold only what can be computed again from tables and
//   files
#define MUSTER_PLUGIN_IS(Plugin)                                                                    \
  MUSTER_DECLARE_ABI                                                                                \
  extern "C" int muster_register(uint32_t abi, void* registry, muster_add add) {                    \
    return abi == MUSTER_ABI ? add(registry, muster::detail::descriptor<Plugin>()) : MUSTER_FAILED; \
  }
