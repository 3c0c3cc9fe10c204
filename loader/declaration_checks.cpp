#include "declaration_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "elf.hpp"
#include "text/names.hpp"

namespace muster {
namespace {

// Sizes of the structs in the first kernel that knew them.
constexpr std::size_t first_cause = offsetof(muster_cause, replaces);
constexpr std::size_t first_law = offsetof(muster_law, apart) + sizeof(muster_law::apart);
constexpr std::size_t first_clip = offsetof(muster_clip, choice) + sizeof(muster_clip::choice);
constexpr std::size_t first_burst = offsetof(muster_burst, duration) + sizeof(muster_burst::duration);

class Declaration {
 public:
  // `what`: "law". `size`: as declared.
  Declaration(const muster_plugin& plugin, const char* what, std::size_t size, std::size_t first)
      : plugin_(plugin), what_(what) {
    if (size < first)
      refuse(fmt::format("has {} bytes; expected at least {}; rebuild it against plugin_api", size, first));
  }

  [[noreturn]] void refuse(const std::string& how) const {
    throw Refusal(fmt::format("registers \"{}\" whose {} {}", plugin_.id, what_, how));
  }

  // `part`: what the parameter is of, "strength". `kinds`: those that it may have.
  void expect_parameter(const char* part, const char* name, const std::vector<uint32_t>& kinds,
                        const char* kind_words) const {
    if (!name) refuse(fmt::format("names no parameter as its {}", part));
    std::vector<std::string> names;
    for (uint32_t k = 0; k < plugin_.param_count; ++k) {
      const muster_param& p = plugin_.params[k];
      for (const uint32_t kind : kinds) {
        if (p.kind != kind) continue;
        if (std::string_view(p.name) == name) return;
        names.emplace_back(p.name);
      }
    }
    refuse(fmt::format("names {} as its {}, which is not {} of the plugin; {}", quote(name), part, kind_words,
                       names.empty() ? "it has none" : suggest(name, names)));
  }
  void expect_real(const char* part, const char* name) const {
    expect_parameter(part, name, {MUSTER_REAL}, "a real parameter");
  }

  // A list of values that grow.
  void expect_growing(const char* part, const double* values, uint32_t count) const {
    if (!values || count == 0) refuse(fmt::format("has no values of its {}", part));
    for (uint32_t k = 0; k < count; ++k) {
      if (!std::isfinite(values[k]) || values[k] <= (k ? values[k - 1] : 0))
        refuse(fmt::format("has {} as value {} of its {}; expected positive values that grow", values[k], k + 1, part));
    }
  }

 private:
  const muster_plugin& plugin_;
  const char* what_;
};

void check_law(const muster_plugin& plugin, const muster_law& law) {
  const Declaration declared(plugin, "law", law.size, first_law);
  if (law.flags & ~uint32_t{MUSTER_REPLACES})
    declared.refuse(fmt::format("has unknown flags {:#x}", law.flags & ~uint32_t{MUSTER_REPLACES}));
  declared.expect_real("strength", law.strength);
  if (!law.log_density) declared.refuse("has no density");
  if (law.most_draws == 0) declared.refuse("has a density of no draws; expected most_draws of at least 1");
  if (law.grid || !(law.flags & MUSTER_REPLACES)) declared.expect_growing("strength", law.grid, law.grid_count);
  if (!law.form) return;
  declared.expect_parameter("form", law.form, {MUSTER_REAL, MUSTER_INTEGER}, "a number");
  declared.expect_growing("form", law.forms, law.form_count);
}

void check_clip(const muster_plugin& plugin, const muster_clip& clip) {
  const Declaration declared(plugin, "clip", clip.size, first_clip);
  if (clip.side != MUSTER_ABOVE && clip.side != MUSTER_BELOW)
    declared.refuse(fmt::format("has the side {}; expected MUSTER_ABOVE or MUSTER_BELOW", clip.side));
  declared.expect_real("level", clip.level);
  if (clip.choice) declared.expect_parameter("choice", clip.choice, {MUSTER_FLAG}, "a flag");
}

void check_burst(const muster_plugin& plugin, const muster_burst& burst) {
  const Declaration declared(plugin, "burst", burst.size, first_burst);
  for (const char* end : {burst.one, burst.other})
    declared.expect_parameter("radio", end, {MUSTER_REFERENCE}, "a reference");
  declared.expect_real("loss", burst.loss);
  declared.expect_real("share", burst.share);
  declared.expect_real("duration", burst.duration);
}

// Each {slot} of a cause's sentence names a parameter; "{offset|too high|too low}" says its sign in words.
void check_title(const muster_plugin& plugin, std::string_view title) {
  std::vector<std::string> names;
  for (uint32_t k = 0; k < plugin.param_count; ++k) names.emplace_back(plugin.params[k].name);
  const auto refuse = [&](const std::string& how) {
    throw Refusal(fmt::format("registers \"{}\" whose cause has the title \"{}\", {}", plugin.id, title, how));
  };
  for (auto open = title.find('{'); open != title.npos; open = title.find('{', open + 1)) {
    const auto close = title.find('}', open);
    if (close == title.npos) refuse("with a { that no } ends");
    const std::string slot(title.substr(open + 1, close - open - 1)), name = slot.substr(0, slot.find('|'));
    if (std::ranges::count(names, name) == 0)
      refuse(fmt::format("in which {{{}}} is no parameter; {}", name,
                         names.empty() ? "the plugin has none" : suggest(name, names)));
    if (const auto bars = std::ranges::count(slot, '|'); bars != 0 && bars != 2)
      refuse(fmt::format("in which {{{}}} has {} words for the sign; expected {{{}|if positive|if negative}}", slot,
                         bars, name));
  }
}

void check_cause(const muster_plugin& plugin, const muster_cause& cause) {
  if (cause.title) check_title(plugin, cause.title);
  if (!cause.ranges_over) return;
  const Declaration declared(plugin, "cause", cause.size, first_cause);
  std::istringstream names(cause.ranges_over);  // one, or two with a blank between: "a b"
  for (std::string name; names >> name;)
    declared.expect_parameter("ranges_over", name.c_str(), {MUSTER_REFERENCE}, "a reference");
}

}  // namespace

void check_declarations(const muster_plugin& plugin) {
  if (plugin.cause) check_cause(plugin, *plugin.cause);
  if (plugin.law) check_law(plugin, *plugin.law);
  if (plugin.clip) check_clip(plugin, *plugin.clip);
  if (plugin.burst) check_burst(plugin, *plugin.burst);
}

}  // namespace muster
