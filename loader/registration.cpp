#include "registration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <exception>
#include <set>

#include "declaration_checks.hpp"
#include "elf.hpp"

namespace muster {
namespace {

// The descriptor's size in the first MUSTER_ABI 1: a library may have more fields than this kernel, or fewer of the
// later ones.
constexpr std::size_t first_size = offsetof(muster_plugin, step) + sizeof(muster_plugin::step);

constexpr std::string_view reserved[] = {"name", "every", "library", "revision"};
constexpr std::uint32_t known_flags = MUSTER_FREE | MUSTER_REQUIRED | MUSTER_LINEAR | MUSTER_LOG | MUSTER_CYCLIC |
                                      MUSTER_EAST | MUSTER_NORTH | MUSTER_EACH;

template <class... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> format, Args&&... args) {
  throw Refusal(fmt::format(format, std::forward<Args>(args)...));
}

bool is_word(std::string_view text) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !text.empty() && text[0] >= 'a' && text[0] <= 'z' && std::ranges::all_of(text, fits);
}

// Words of a list such as "a|b|c", empty ones included.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> result;
  for (std::size_t end; (end = text.find(separator)) != text.npos; text.remove_prefix(end + 1))
    result.push_back(text.substr(0, end));
  result.push_back(text);
  return result;
}

void check_number(const std::string& of, const muster_param& p) {
  const std::string_view order = p.kind == MUSTER_REAL ? "real(name, default, least, most, unit, help)"
                                                       : "integer(name, default, least, most, help)";
  if (std::isnan(p.min) || std::isnan(p.max) || p.min > p.max)
    refuse("{} has the default {} and bounds from {} to {}; expected the least first, in the order {}", of, p.value,
           p.min, p.max, order);
  if ((p.flags & MUSTER_FREE) && !(std::isfinite(p.min) && std::isfinite(p.max)))
    refuse("{} is free for a fit, which needs finite bounds; it has {} to {}", of, p.min, p.max);
  if (p.flags & MUSTER_REQUIRED) return;  // its default is never used
  if (!std::isfinite(p.value) || p.value < p.min || p.value > p.max)
    refuse("{} has the default {}, which is not in {} to {}; expected the order {}", of, p.value, p.min, p.max, order);
  if (p.kind == MUSTER_INTEGER && p.value != std::floor(p.value))
    refuse("{} is an integer with default {}", of, p.value);
  if (p.kind == MUSTER_FLAG && p.value != 0 && p.value != 1) refuse("{} is a flag with default {}", of, p.value);
}

void check_choice(const std::string& of, const muster_param& p) {
  if (!p.text) refuse("{} has no choices", of);
  const std::vector<std::string_view> choices = split(p.text, '|');
  if (choices.size() == 1 && choices[0].find_first_of(",; /") != choices[0].npos)
    refuse("{} has one choice, \"{}\"; expected them with | between, such as \"slow|fast\"", of, p.text);
  if (std::ranges::count(choices, std::string_view()) > 0) refuse("{} has an empty choice in \"{}\"", of, p.text);
  if (std::set(choices.begin(), choices.end()).size() < choices.size())
    refuse("{} has a choice twice in \"{}\"", of, p.text);
  if (!(p.value >= 0 && p.value < static_cast<double>(choices.size()) && p.value == std::floor(p.value)))
    refuse("{} has the default {}, which is no place in \"{}\"", of, p.value, p.text);
}

void check_param(const muster_plugin& plugin, const muster_param& p) {
  if (!p.name || !is_word(p.name))
    refuse("registers \"{}\" with a parameter \"{}\"; expected a name of a-z, 0-9 and _", plugin.id,
           p.name ? p.name : "");
  const std::string of = fmt::format("registers \"{}\" whose parameter \"{}\"", plugin.id, p.name);
  if (std::ranges::count(reserved, std::string_view(p.name)) > 0)
    refuse("{} bears a reserved name; reserved are {}", of, fmt::join(reserved, ", "));
  if (p.flags & ~known_flags) refuse("{} has unknown flags {:#x}", of, p.flags & ~known_flags);
  if ((p.flags & MUSTER_EACH) && p.kind != MUSTER_CHOICE && p.kind != MUSTER_INTEGER)
    refuse("{} is to be tried at each of its values; expected a choice or an integer", of);
  if (!p.unit) refuse("{} has no unit; expected \"\" where there is none", of);
  if (!p.help || !*p.help) refuse("{} has no help", of);
  switch (p.kind) {
    case MUSTER_REAL:
    case MUSTER_INTEGER:
    case MUSTER_FLAG:
      return check_number(of, p);
    case MUSTER_CHOICE:
      return check_choice(of, p);
    case MUSTER_REFERENCE:
      if (!p.text || !*p.text) refuse("{} refers to a row of no set", of);
      return;
    case MUSTER_TEXT:
    case MUSTER_FILE:
      return;
    default:
      refuse("{} has the unknown kind {}", of, p.kind);
  }
}

void check(const muster_plugin& plugin) {
  if (plugin.id && *plugin.id && parse_plugin_id(std::string(plugin.id) + "/1").revision == 1)
    refuse("registers the id \"{}\", without a revision; expected \"{}/1\"", plugin.id, plugin.id);
  if (!plugin.id || parse_plugin_id(plugin.id).revision == 0)
    refuse("registers the id \"{}\"; expected one like \"radio.multiwall/1\"", plugin.id ? plugin.id : "");
  if (plugin.phase < MUSTER_CONTROL || plugin.phase > MUSTER_OBSERVE)
    refuse("registers \"{}\" in phase {}; expected {} to {}", plugin.id, plugin.phase, +MUSTER_CONTROL,
           +MUSTER_OBSERVE);
  if (!plugin.summary || !*plugin.summary) refuse("registers \"{}\" without a summary", plugin.id);
  if (!plugin.create || !plugin.destroy || !plugin.step)
    refuse("registers \"{}\" without {}", plugin.id, !plugin.create ? "create" : !plugin.destroy ? "destroy" : "step");
  if (plugin.param_count > 0 && !plugin.params) refuse("registers \"{}\" without its parameters", plugin.id);
  std::set<std::string_view> names;
  for (std::uint32_t i = 0; i < plugin.param_count; ++i) {
    check_param(plugin, plugin.params[i]);
    if (!names.insert(plugin.params[i].name).second)
      refuse("registers \"{}\" with the parameter \"{}\" twice; expected another name for the one of \"{}\"", plugin.id,
             plugin.params[i].name, plugin.params[i].help ? plugin.params[i].help : "");
  }
  check_declarations(plugin);
}

struct Registry {
  std::vector<muster_plugin> plugins;
  std::exception_ptr fault;  // no exception crosses the border
};

void add(Registry& registry, const muster_plugin* given) {
  if (!given) refuse("registers nothing");
  if (given->size < first_size)
    refuse("registers a descriptor of {} bytes; expected at least {}; rebuild it against plugin_api", given->size,
           first_size);
  muster_plugin plugin{};
  std::memcpy(&plugin, given, std::min<std::size_t>(given->size, sizeof plugin));
  plugin.size = sizeof plugin;
  check(plugin);
  for (const muster_plugin& other : registry.plugins) {
    if (std::string_view(other.id) == plugin.id) refuse("registers \"{}\" twice", plugin.id);
    if (parse_plugin_id(other.id).id != parse_plugin_id(plugin.id).id)
      refuse("registers \"{}\" and \"{}\"; expected one id a library", other.id, plugin.id);
  }
  registry.plugins.push_back(plugin);
}

extern "C" int add_callback(void* registry, const muster_plugin* plugin) {
  Registry& to = *static_cast<Registry*>(registry);
  try {
    if (!to.fault) add(to, plugin);
  } catch (...) {
    to.fault = std::current_exception();
  }
  return to.fault ? MUSTER_FAILED : MUSTER_OK;
}

}  // namespace

PluginId parse_plugin_id(std::string_view text) {
  const std::size_t slash = text.find('/');
  if (slash == text.npos || !std::ranges::all_of(split(text.substr(0, slash), '.'), is_word)) return {};
  PluginId result{text.substr(0, slash), 0};
  const std::string_view number = text.substr(slash + 1);
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), result.revision);
  if (error != std::errc() || end != number.data() + number.size() || number.starts_with('0')) return {};
  return result;
}

std::vector<muster_plugin> registered_plugins(decltype(&muster_register) call) {
  Registry registry;
  const int result = call(MUSTER_ABI, &registry, add_callback);
  if (registry.fault) std::rethrow_exception(registry.fault);
  if (result != MUSTER_OK) refuse("refuses to register: muster_register returned {}", result);
  if (registry.plugins.empty()) refuse("registers no plugin");
  std::ranges::sort(registry.plugins, {}, [](const muster_plugin& p) { return parse_plugin_id(p.id).revision; });
  return registry.plugins;
}

}  // namespace muster
