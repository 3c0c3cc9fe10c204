#include "level_terms.hpp"

#include <algorithm>
#include <functional>
#include <set>

namespace muster::cli {
namespace {

bool adds_to_level(const Instance& instance) {
  return std::any_of(instance.claims().begin(), instance.claims().end(), [](const Claim& claim) {
    return claim.kind == MUSTER_ADD && claim.name.logical() == "link/*/level";
  });
}

// The loss by distance and walls, whose model may be none at all.
bool is_path_loss(const Instance& instance) {
  const int at = instance.find_param("model");
  if (at < 0) return false;
  const muster_param& model = instance.plugin().params[at];
  return model.kind == MUSTER_CHOICE && ('|' + std::string(model.text) + '|').find("|perfect|") != std::string::npos;
}

bool shadows(const Instance& instance) {
  const int at = instance.find_param("shadowing");
  return at >= 0 && instance.params()[static_cast<std::size_t>(at)] > 0;
}

// One plugin with the same words: those that are about one radio, material or mesh each differ in a word.
bool is_same(const Instance& a, const Instance& b) {
  const muster_plugin& plugin = a.plugin();
  if (std::string(plugin.id) != b.plugin().id) return false;
  for (uint32_t i = 0; i < plugin.param_count; ++i) {
    const muster_param& param = plugin.params[i];
    if (param.kind == MUSTER_REAL || param.kind == MUSTER_INTEGER || param.kind == MUSTER_FLAG) continue;
    const auto word = [&](const Instance& each) -> std::string {
      for (const XmlAttribute& given : each.declared().attributes)
        if (given.name == param.name) return given.value;
      return "";
    };
    if (word(a) != word(b)) return false;
  }
  return true;
}

std::string title(const Instance& instance) {
  const std::string id = instance.plugin().id;
  return instance.name() + " (" + id.substr(0, id.find('/')) + ")";
}

// True for what is added to a path loss and is none: draws, causes of misfits, antennas and what stands in the way. A
// plugin of somebody's own may be anything.
bool is_beside(const Instance& instance) {
  static const std::set<std::string> beside = {"radio.antenna", "radio.bodies", "radio.meshes"};
  const std::string id = instance.plugin().id;
  const muster_cause* cause = instance.plugin().cause;  // one that replaces a part may be a path loss itself
  return instance.plugin().draw || (cause && !cause->replaces) || beside.count(id.substr(0, id.find('/')));
}

std::string titles(const std::vector<const Instance*>& terms) {
  std::string result;
  for (const Instance* term : terms) result += (result.empty() ? "" : ", ") + title(*term);
  return result;
}

// radio.fading also has fading: who takes it out loses that.
std::string remedy(const Instance& one, const Instance& other) {
  for (const auto& [fading, beside] : {std::pair(&one, &other), {&other, &one}}) {
    const bool is_alone = beside->declared().plugin != "radio.fading";
    if (fading->declared().plugin == "radio.fading" && is_alone && shadows(*beside))
      return "shadowing=\"0\" of " + fading->name() + ", or no " + beside->name();
  }
  return "one of the two";
}

}  // namespace

std::vector<std::string> level_doubts(const Simulation& run) {
  std::vector<const Instance*> terms;
  for (const auto& instance : run.instances())
    if (adds_to_level(*instance)) terms.push_back(instance.get());
  std::vector<std::string> result;
  for (std::size_t b = 0; b < terms.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const Instance &one = *terms[a], &other = *terms[b];
      const char* what = is_path_loss(one) && is_path_loss(other) ? "the loss by distance and walls"
                         : shadows(one) && shadows(other)         ? "shadowing"
                         : is_same(one, other)                    ? "the same"
                                                                  : nullptr;
      if (what)
        result.push_back(other.place().text() + ": " + title(other) + " and " + one.place().text() + ": " + title(one) +
                         " both add " + what + " to link/*/level, which then counts twice; expected " +
                         remedy(one, other));
    }
  }
  if (!terms.empty() && std::all_of(terms.begin(), terms.end(), [](const Instance* t) { return is_beside(*t); }))
    result.push_back(terms[0]->place().text() + ": nothing adds a path loss to link/*/level: there is only " +
                     titles(terms) +
                     ", so that a level does not fall with distance; expected <radio.multiwall/> beside " +
                     (terms.size() == 1 ? "it" : "them"));
  return result;
}

}  // namespace muster::cli
