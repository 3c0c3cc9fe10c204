#include "host.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "crash_report.hpp"
#include "fault_words.hpp"
#include "instance.hpp"
#include "loader/float_guard.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster {
namespace {

constexpr std::size_t most_events = 1'000;  // of an instance in one step

}  // namespace

// Accesses Instance on behalf of its plugin. Nothing thrown here may cross into the plugin.
struct Host {
  static Instance& of(const muster_host* host) { return *static_cast<Instance*>(host->kernel); }

  // Runs a call that may be refused: the message is kept in the instance, and the plugin gets `otherwise`.
  template <class Body>
  static auto guarded(const muster_host* host, decltype(std::declval<Body>()()) otherwise, Body&& body) noexcept {
    Instance& instance = of(host);
    try {
      return body();
    } catch (const Error& e) {
      if (instance.error_.empty()) instance.error_ = e.what(), instance.fault_ = e.exit(), instance.refused_ = true;
    } catch (const std::exception& e) {
      if (instance.error_.empty()) instance.error_ = e.what();
    }
    return otherwise;
  }

  static void wrong(Instance& instance, const std::string& what) {
    if (instance.error_.empty()) instance.error_ = what;
  }

  static int claim(const muster_host* host, uint32_t kind, uint32_t flags, const char* table, const char* columns) {
    if (!of(host).in_create_) return wrong(of(host), "claims outside create()"), -1;
    return guarded(host, -1, [&] { return of(host).claim(kind, flags, table, columns); });
  }

  static int file(const muster_host* host, const char* param, const char* columns) {
    if (!of(host).in_create_) return wrong(of(host), "asks for a file outside create()"), -1;
    return guarded(host, -1, [&] { return of(host).file(param, columns); });
  }

  static const char* text(const muster_host* host, const char* path) {
    Instance& i = of(host);
    const auto own = i.texts_.find(path);
    if (own != i.texts_.end()) return own->second.c_str();
    if (const int number = i.find_param(path); number >= 0)
      return wrong(i, no_text(i.plugin_->params[number])), nullptr;
    const auto& texts = i.around_.world->texts;
    const auto found = texts.find(path);
    if (found != texts.end()) return found->second.c_str();
    return guarded(host, nullptr, [&] {
      const char* inherited = inherited_text(i, path);
      return inherited ? inherited : place_text(i, path);
    });
  }

  // "robot/leader/place", "self/place" and, of a given attribute, "self/place/ATTRIBUTE"; the world's "world/file",
  // "world/dt" and "world/until" [s]; "world/PLUGIN/place" of the first instance of a plugin in the world file. Null
  // for other paths and for rows that joined.
  static const char* place_text(Instance& i, const std::string& path) {
    const auto first = path.find('/'), last = path.rfind('/');
    const auto keep = [&](const std::string& text) { return i.texts_.emplace(path, text).first->second.c_str(); };
    // "self/claim/0": the table of a claim by its number, for the message of a fault in it.
    const std::string of_claim = "self/claim/";
    if (path.rfind(of_claim, 0) == 0) {
      const auto number = static_cast<std::size_t>(parse_integer(path.substr(of_claim.size())).value_or(-1));
      return number < i.claims_.size() ? keep(i.claims_[number].name.text()) : nullptr;
    }
    const World& world = *i.around_.world;
    if (path == "world/file") return keep(world.file.string());
    if (path == "world/dt") return keep(print_real(world.dt));
    if (path == "world/until") return keep(print_real(world.until()));
    const std::string own = "self/place/";
    if (path.rfind(own, 0) == 0) {
      const auto given = i.places_.find(path.substr(own.size()));
      return given == i.places_.end() ? nullptr : keep(given->second.text());
    }
    if (first == path.npos || path.substr(last) != "/place") return nullptr;
    if (path == "self/place") return keep(i.place().text());
    if (first == last) return nullptr;
    const std::string set = path.substr(0, first), name = path.substr(first + 1, last - first - 1);
    for (const auto& instance : world.instances)
      if (set == "world" && instance.plugin == name) return keep(instance.place.text());
    for (const auto& row : world.rows) {
      if (row.name == name && std::find(row.sets.begin(), row.sets.end(), set) != row.sets.end())
        return keep(row.place.text());
    }
    return nullptr;
  }

  // Text of a row that joined as a copy of another: that one's.
  static const char* inherited_text(const Instance& i, const std::string& path) {
    const auto first = path.find('/'), last = path.rfind('/');
    const Set* set = first < last ? i.around_.board->find_set(path.substr(0, first)) : nullptr;
    const int row = set ? set->find(path.substr(first + 1, last - first - 1)) : -1;
    if (row < 0) return nullptr;
    const std::string& like = set->names[set->like[static_cast<std::size_t>(row)]];
    const auto found = i.around_.world->texts.find(set->name + '/' + like + path.substr(last));
    return found == i.around_.world->texts.end() ? nullptr : found->second.c_str();
  }

  static const char* search_path(const muster_host* host, uint32_t index) {
    const auto& path = of(host).around_.search_path;
    return index < path.size() ? path[index].c_str() : nullptr;
  }

  static uint64_t stream(const muster_host* host, const char* name) {
    return combined(mixed(of(host).around_.seed), key_of(name));
  }

  static double param(const muster_host* host, const char* name) {
    Instance& i = of(host);
    const int found = i.find_param(name);
    if (found >= 0 && i.texts_.count(name))
      return wrong(i, std::string("asks for the number \"") + name + "\", which is a text; expected s.text(\"" + name +
                          "\"), or host->text()"),
             0;
    if (found >= 0) return i.params_[static_cast<std::size_t>(found)];
    std::vector<std::string> declared;
    for (uint32_t p = 0; p < i.plugin_->param_count; ++p) declared.emplace_back(i.plugin_->params[p].name);
    wrong(i, std::string("asks for the parameter \"") + name + "\", which it does not declare" +
                 (declared.empty() ? "; it declares none" : "; declared are " + listed(declared)));
    return 0;
  }

  // The set by name, cached: most plugins query one set row by row, and no set is removed while a step runs.
  static const Set* set_of(const muster_host* host, const char* set) {
    Instance& i = of(host);
    if (i.in_step_ && i.asked_ && i.asked_->name == set) return i.asked_;
    return i.asked_ = i.around_.board->find_set(set);
  }

  static uint32_t rows(const muster_host* host, const char* set) {
    const Set* found = set_of(host, set);
    return found ? static_cast<uint32_t>(found->rows()) : 0;
  }
  static const char* row_name(const muster_host* host, const char* set, uint32_t row) {
    const Set* found = set_of(host, set);
    return found && row < found->names.size() ? found->names[row].c_str() : nullptr;
  }
  static uint64_t row_key(const muster_host* host, const char* set, uint32_t row) {
    const Set* found = set_of(host, set);
    return found && row < found->keys.size() ? found->keys[row] : 0;
  }
  static int row_alive(const muster_host* host, const char* set, uint32_t row) {
    const Set* found = set_of(host, set);
    return found && row < found->alive.size() && found->alive[row];
  }

  // The claim, or null with the fault noted.
  static Claim* claim_of(const muster_host* host, int claim, const char* doing) {
    Instance& i = of(host);
    if (i.in_step_ && claim >= 0 && static_cast<std::size_t>(claim) < i.claims_.size())
      return &i.claims_[static_cast<std::size_t>(claim)];
    wrong(i, std::string(doing) + (i.in_step_ ? " on a claim that it does not have" : " outside step()"));
    return nullptr;
  }

  static double* append(const muster_host* host, int index, uint32_t count) {
    Instance& i = of(host);
    Claim* claim = claim_of(host, index, "append()");
    if (!claim || !claim->out || !(claim->lists || claim->out->set().kind == SetKind::queue)) {
      wrong(i,
            "append() on a table whose rows it does not list; expected a queue, or a set of which it writes the first "
            "quantity");
      static thread_local std::vector<double> nowhere;  // scratch memory for the plugin, until its step is refused
      nowhere.resize(count * std::max<std::size_t>(claim ? claim->columns.size() : 0, 64));
      return nowhere.data();
    }
    const auto width = claim->columns.size();
    claim->aside.resize((claim->appended + count) * width, poison());
    double* first = claim->aside.data() + claim->appended * width;
    if (claim->row >= 0) {
      for (uint32_t r = 0; r < count; ++r) first[r * width] = claim->row;  // it appends for its own row only
    }
    claim->appended += count;
    return first;
  }

  static const uint8_t* get_bytes(const muster_host* host, int index, uint32_t row, uint32_t column, uint64_t* count) {
    *count = 0;
    Instance& i = of(host);
    const Claim* claim = claim_of(host, index, "get_bytes()");
    if (!claim || !claim->in) return nullptr;
    const muster_in& view = i.in_[static_cast<std::size_t>(index)];
    if (row >= view.rows || column >= view.cols || !claim->columns[column].bytes) {
      wrong(i, "get_bytes() of a cell that is not there or holds no bytes");
      return nullptr;
    }
    const auto blob = static_cast<std::size_t>(view.data[std::size_t{row} * view.cols + column]);
    if (blob == 0) return nullptr;
    const auto& bytes = *claim->in->now().blobs[blob - 1];
    *count = bytes.size();
    return bytes.data();
  }

  static void put_bytes(const muster_host* host, int index, uint32_t row, uint32_t column, const uint8_t* data,
                        uint64_t count) {
    Instance& i = of(host);
    Claim* claim = claim_of(host, index, "put_bytes()");
    if (!claim || !claim->out) return;
    const std::size_t rows = claim->appended ? claim->appended : i.out_[static_cast<std::size_t>(index)].rows;
    if (row >= rows || column >= claim->columns.size() || !claim->columns[column].bytes)
      return wrong(i, "put_bytes() into a cell that is not there or holds no bytes");
    guarded(host, 0, [&] {
      claim->puts.push_back({row, column, std::make_shared<const std::vector<uint8_t>>(data, data + count)});
      return 0;
    });
  }

  static int join(const muster_host* host, int index, const char* name, int like) {
    Instance& i = of(host);
    Claim* claim = claim_of(host, index, "join()");
    if (!claim || !(claim->flags & MUSTER_JOINS)) return wrong(i, "join() needs a claim with MUSTER_JOINS"), -1;
    Set& set = *i.around_.board->find_set(claim->name.set);
    if (!is_name(name))
      return wrong(i, "join(): " + quote(name) + " is not a name; expected letters, digits, _, - and ."), -1;
    if (like >= static_cast<int>(set.rows())) return wrong(i, "join() like a row that is not there"), -1;
    int number = static_cast<int>(set.rows());
    for (const auto& join : i.joins) {
      if (join.set == &set) ++number;
      if (join.set == &set && join.name == name) return wrong(i, "join(): " + quote(name) + " joins twice"), -1;
    }
    if (set.find(name) >= 0) return wrong(i, "join(): a " + set.name + " is called " + quote(name) + " already"), -1;
    i.joins.push_back({&set, name, like, {}});
    return number;
  }

  static int leave(const muster_host* host, int index, uint32_t row) {
    Instance& i = of(host);
    Claim* claim = claim_of(host, index, "leave()");
    if (!claim || !(claim->flags & MUSTER_JOINS))
      return wrong(i, "leave() needs a claim with MUSTER_JOINS"), MUSTER_FAILED;
    Set& set = *i.around_.board->find_set(claim->name.set);
    if (row >= set.alive.size() || !set.alive[row])
      return wrong(i, "leave() of a row that is not there"), MUSTER_FAILED;
    i.leaves.push_back({&set, row});
    return MUSTER_OK;
  }

  static int place(const muster_host* host, int index, uint32_t row, const char* quantity, uint32_t column,
                   double value) {
    Instance& i = of(host);
    Claim* claim = claim_of(host, index, "place()");
    if (!claim) return MUSTER_FAILED;
    const Table* table = i.around_.board->find(claim->name.set + "/*/" + quantity);
    if (!table)
      return wrong(i, "place() of " + claim->name.set + "/*/" + quantity + ", which is no table here"), MUSTER_FAILED;
    if (column >= table->width())
      return wrong(i, "place() into column " + std::to_string(column) + " of " + table->name() + ", which has " +
                          std::to_string(table->width())),
             MUSTER_FAILED;
    if (!std::isfinite(value))
      return wrong(i, "place() of " + table->name() + ": " + table->columns()[column].title() + " is not finite"),
             MUSTER_FAILED;
    auto number = static_cast<uint32_t>(i.around_.board->find_set(claim->name.set)->rows());
    for (auto& join : i.joins) {
      if (join.set->name != claim->name.set) continue;
      if (number++ == row) return join.values.push_back({quantity, column, value}), MUSTER_OK;
    }
    return wrong(i, "place() of a row that did not join in this step"), MUSTER_FAILED;
  }

  static void error(const muster_host* host, const char* message) { wrong(of(host), message); }

  static void refuse(const muster_host* host, const char* message) {
    if (of(host).error_.empty()) of(host).fault_ = Exit::invalid_input;
    wrong(of(host), message);
  }

  static void event(const muster_host* host, const char* message) {
    Instance& i = of(host);
    guarded(host, 0, [&] {
      if (i.events.size() == most_events) i.events.push_back("tells more in this step than is kept");
      if (i.events.size() > most_events) return 0;
      const std::string text = in_one_line(message), begin = "warning: ";
      const bool is_warning = text.starts_with(begin);
      return i.events.push_back(
                 is_warning ? begin + as_given(text.substr(begin.size()), *i.around_.world, i.around_.search_path)
                            : text),
             0;
    });
  }

  static void each(const muster_host* host, uint32_t count, void (*one)(void*, uint32_t), void* work) {
    Instance& i = of(host);
    if (!i.in_step_) return wrong(i, "each() outside step()");
    std::string changed;
    std::mutex changing;
    const auto call = [&](std::size_t k) {
      const FloatGuard guard;
      const RunningCallback running(i.title_.c_str(), "step", i.tick_, i.time_, i.may_wait_);
      one(work, static_cast<uint32_t>(k));
      if (!guard.changed()) return;
      const std::lock_guard lock(changing);
      changed = guard.what();
    };
    if (i.around_.workers && count > 1)
      i.around_.workers->each(count, call);
    else
      for (uint32_t k = 0; k < count; ++k) call(k);
    if (!changed.empty()) wrong(i, changed + " for a thread; expected it to leave the arithmetic as it was");
  }
};

muster_host make_host(Instance& instance) {
  return {sizeof(muster_host), MUSTER_ABI,   &instance,       Host::claim,     Host::file,     Host::text,
          Host::search_path,   Host::stream, Host::param,     Host::rows,      Host::row_name, Host::row_key,
          Host::row_alive,     Host::append, Host::get_bytes, Host::put_bytes, Host::join,     Host::leave,
          Host::place,         Host::error,  Host::refuse,    Host::event,     Host::each};
}

}  // namespace muster
