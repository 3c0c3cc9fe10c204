#include "mission_doubts.hpp"

#include <cmath>

#include "mission_elements.hpp"

namespace muster::missions {
namespace {

constexpr double far_off = 100;   // m; and
constexpr double fastest = 100;   // m/s, at which no robot reaches it within the run
constexpr double weakest = -110;  // dBm; radios receive down to some -95

// What all missions and orders of the world file say and await.
struct Talk {
  std::vector<std::string> said, awaited;
  std::vector<std::string> reporters;  // radios that say where they are
  bool is_whole = true;                // false: other plugins may say and hear anything
};

template <class Visit>
void for_each(const XmlElement& root, const Visit& visit) {
  visit(root);
  for (const auto& child : root.children) for_each(child, visit);
}

std::vector<std::string> awaited_by(const XmlElement& element) {
  if (element.name == "wait" || element.name == "on" || element.name == "if") {
    if (element.attribute("message")) return {text(element, "message")};
  } else if (element.name == "follow" && element.attribute("until")) {
    return {text(element, "until")};
  }
  return {};
}

bool may_talk(const std::string& plugin) {
  static const std::vector<std::string> silent = {"physics.", "radio.",   "network.", "robots.", "sensors.",
                                                  "observe.", "routing.", "data.",    "effect.", "cause."};
  static const std::vector<std::string> known = {
      "control.beacon",     "control.connectivity", "control.goal2d",   "control.waypoint", "control.steady",
      "control.wander",     "control.car",          "control.strafe",   "control.path3d",   "control.velocity3d",
      "control.keep_clear", "control.attitude",     "control.navigate", "control.recorded", "control.track"};
  const auto begins = [&](const std::string& prefix) { return plugin.rfind(prefix, 0) == 0; };
  return std::none_of(silent.begin(), silent.end(), begins) &&
         std::find(known.begin(), known.end(), plugin) == known.end();
}

XmlElement file_beside_world(const Setup& setup, const XmlAttribute& given) {
  return read_xml(std::filesystem::path(world_folder(setup.host())) / given.value);
}

void add_mission(const Setup& setup, const XmlElement& plugin, Talk& talk) {
  if (number(plugin, "report", 0, 0, 1000) > 0) talk.reporters.push_back(text(plugin, "robot"));
  for_each(file_beside_world(setup, *plugin.attribute("mission")), [&](const XmlElement& step) {
    if (step.name == "say") {
      talk.said.push_back(text(step, "text"));
      if (talk.said.back().rfind("at ", 0) == 0) talk.reporters.push_back(text(plugin, "robot"));
    }
    for (const auto& message : awaited_by(step)) {
      talk.awaited.push_back(message);
      talk.said.push_back("ok " + message);  // the answer
    }
  });
}

Talk talk_of(const Setup& setup) {
  Talk talk;
  const std::string world = setup.text("world/file");
  try {
    for_each(read_xml(world), [&](const XmlElement& plugin) {
      const auto* swapped = plugin.attribute("plugin");
      const std::string& id = plugin.name == "swap" && swapped ? swapped->value : plugin.name;
      if (id.find('.') == id.npos) return;
      if (id == "control.mission" && plugin.attribute("mission")) return add_mission(setup, plugin, talk);
      if (id == "control.operator" && plugin.attribute("orders"))
        return for_each(file_beside_world(setup, *plugin.attribute("orders")),
                        [&](const XmlElement& order) { talk.said.push_back(text(order, "text")); });
      if (may_talk(id)) talk.is_whole = false;
    });
  } catch (const std::exception&) {  // told elsewhere, with its place
    talk.is_whole = false;
  }
  talk.said.emplace_back("beacon");
  return talk;
}

bool has(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

class Doubts {
 public:
  Doubts(const Setup& setup, const std::string& robot)
      : talk_(talk_of(setup)), until_(parse_real(setup.text("world/until")).value_or(0)) {
    find_start(setup, robot);
  }

  std::vector<std::string> of(const XmlElement& root) {
    steps(root);
    for_each(root, [&](const XmlElement& step) { look(step); });
    return std::move(doubts_);
  }

 private:
  void warn(const Place& place, const std::string& what) { doubts_.push_back(place.text() + ": " + what); }

  void find_start(const Setup& setup, const std::string& robot) {
    try {
      for_each(read_xml(setup.text("world/file")), [&](const XmlElement& element) {
        const auto* at = element.attribute("at");
        if (element.name == "robot" && text(element, "name") == robot && at) start_ = parse_reals(at->value, 3);
      });
    } catch (const std::exception&) {  // a world that is no file
    }
  }

  // What follows a step without end, or one that outlasts the run.
  void steps(const XmlElement& around) {
    const XmlElement* endless = nullptr;
    for (const auto& step : around.children) {
      if (step.name == "on") {
        steps(step);
        continue;
      }
      if (endless) {
        const XmlAttribute* seconds = endless->attribute("seconds");
        warn(step.place, "<" + step.name + "> is never come to: <" + endless->name + "> (" + endless->place.text() +
                             (seconds ? ") lasts " + seconds->value + " s, and the run " + print_real(until_) + " s"
                                      : ") has no times=\"...\" and does not end"));
        return;
      }
      const auto* seconds = step.attribute("seconds");
      const bool outlasts = seconds && until_ > 0 && parse_real(seconds->value).value_or(0) > until_;
      const bool is_loop = step.name == "repeat" || step.name == "patrol";
      if ((is_loop && !step.attribute("times")) || outlasts) endless = &step;
      if (step.name != "patrol") steps(step);
    }
  }

  void look(const XmlElement& step) {
    for (const auto& message : awaited_by(step)) {
      if (talk_.is_whole && !has(talk_.said, message))
        warn(step.place, "<" + step.name + "> waits for " + quote(message) + ", and no mission and no orders of this " +
                             "world say it" + did_you_mean(message, talk_.said) + "; expected <say text=\"" + message +
                             "\"/> or an <order>");
    }
    const auto* radio = step.attribute("radio");
    if (step.name == "follow" && radio && talk_.is_whole && !has(talk_.reporters, radio->value))
      warn(radio->value_place, "attribute \"radio\": " + quote(radio->value) +
                                   " never says where it is; expected a mission of its own with report=\"0.5\"");
    const auto* above = step.attribute("above");
    if (step.name == "keep_link" && above && parse_real(above->value).value_or(0) < weakest)
      warn(above->value_place,
           "attribute \"above\": " + above->value +
               " dBm is weaker than what radios receive, some -95 dBm, so that a link that is heard "
               "at all is strong enough");
    const auto* at = step.attribute("at");
    if (!at || !start_ || until_ <= 0) return;
    auto place = parse_reals(at->value, 3);
    if (!place) place = parse_reals(at->value, 2);
    const double away = place ? std::hypot((*place)[0] - (*start_)[0], (*place)[1] - (*start_)[1]) : 0;
    if (away > far_off && away > fastest * until_)
      warn(at->value_place, "attribute \"at\": " + print_real(std::round(away)) + " m away, where no robot comes in " +
                                "the run of " + print_real(until_) + " s; are these millimetres?");
  }

  Talk talk_;
  double until_;
  std::optional<std::vector<double>> start_;
  std::vector<std::string> doubts_;
};

}  // namespace

std::vector<std::string> doubts_of_mission(const Setup& setup, const std::string& robot, const XmlElement& root) {
  return Doubts(setup, robot).of(root);
}

std::vector<std::string> doubts_of_orders(const Setup& setup, const XmlElement& root) {
  const Talk talk = talk_of(setup);
  const double until = parse_real(setup.text("world/until")).value_or(0);
  std::vector<std::string> doubts;
  for (const auto& order : root.children) {
    const auto *words = order.attribute("text"), *at = order.attribute("at");
    if (words && talk.is_whole && !has(talk.awaited, words->value))
      doubts.push_back(words->value_place.text() + ": attribute \"text\": no mission of this world waits for " +
                       quote(words->value) + did_you_mean(words->value, talk.awaited) +
                       (talk.awaited.empty()
                            ? "; expected a <control.mission> with <wait message=" + quote(words->value) +
                                  "/> or <on message=" + quote(words->value) + ">"
                            : "; " + expected_one_of(talk.awaited)));
    if (at && until > 0 && parse_real(at->value).value_or(0) > until)
      doubts.push_back(at->value_place.text() + ": attribute \"at\": " + at->value +
                       " s is after the end of the run at " + print_real(until) + " s; expected a time below " +
                       print_real(until) + " s, or a longer run (until)");
  }
  return doubts;
}

}  // namespace muster::missions
