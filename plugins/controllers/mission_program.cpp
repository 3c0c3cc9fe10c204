#include "mission_program.hpp"

#include <algorithm>

#include "mission_elements.hpp"
#include "text/doubts.hpp"

namespace muster::missions {
namespace {

// Of "4,0": `; numbers stand between blanks: at="4 0"`.
std::string without_commas(std::string text) {
  if (text.find(',') == text.npos) return "";
  std::replace(text.begin(), text.end(), ',', ' ');
  if (!parse_reals(text, 2) && !parse_reals(text, 3)) return "";
  return "; numbers stand between blanks: at=" + quote(text);
}

constexpr double far = 1e6, long_time = 1e9;
const std::vector<std::string> steps = {"go_to", "wait", "say", "follow", "keep_link", "repeat", "patrol", "choose"};

class Compiler {
 public:
  Compiler(const FindRadio& find, double own, bool flies) : find_(find), own_(own), flies_(flies) {}

  Program compile(const XmlElement& root) {
    if (root.name != "mission") refuse(root.place, "the root element is <" + root.name + ">; expected <mission>");
    expect_attributes(root, {});
    for (const auto& child : root.children) {
      if (child.name != "on") step(child);
    }
    if (program_.code.empty()) refuse(root.place, "<mission> is empty; " + suggest("", steps));
    add(Act::end, root);
    for (const auto& child : root.children) {
      if (child.name == "on") handler(child);
    }
    return std::move(program_);
  }

 private:
  Instruction& add(Act act, const XmlElement& element) {
    program_.code.push_back({});
    program_.code.back().act = act;
    program_.code.back().line = element.place.line;
    return program_.code.back();
  }

  void block(const XmlElement& element) {
    if (element.children.empty()) refuse(element.place, "<" + element.name + "> is empty; " + suggest("", steps));
    for (const auto& child : element.children) step(child);
  }

  void step(const XmlElement& element) {
    const std::string& name = element.name;
    if (name == "go_to") return go_to(element, {"at", "heading", "within", "patience"});
    if (name == "wait") return wait(element);
    if (name == "say") return say(element);
    if (name == "follow") return follow(element);
    if (name == "keep_link") return keep_link(element);
    if (name == "repeat") return repeat(element, [&] { block(element); });
    if (name == "patrol") return patrol(element);
    if (name == "choose") return choose(element);
    refuse(element.place, "<" + name + "> is no step of a mission; " + suggest(name, steps));
  }

  static void expect_nothing_inside(const XmlElement& element) {
    if (!element.children.empty())
      refuse(element.children[0].place,
             "<" + element.children[0].name + "> stands inside <" + element.name + ">, which takes attributes only");
  }

  void go_to(const XmlElement& element, const std::vector<std::string>& valid) {
    expect_attributes(element, valid);
    expect_nothing_inside(element);
    const XmlAttribute& at = needed(element, "at", "a place: x y, or x y z for a robot that flies");
    auto place = parse_reals(at.value, 3);
    if (!place) place = parse_reals(at.value, 2);
    if (place && place->size() == 3 && !flies_)
      refuse(at.value_place, "attribute \"at\": a robot on the ground has no height to go to; expected x y");
    if (!place)
      refuse(at.value_place,
             "attribute \"at\": " + quote(at.value) + " is no place; expected x y or x y z" + without_commas(at.value));
    for (const double value : *place) {
      if (!(std::abs(value) <= far))
        refuse(at.value_place, "attribute \"at\": " + print_real(value) + " is out of bounds; expected metres within " +
                                   print_real(far));
    }
    Instruction& made = add(Act::go_to, element);
    made.x = (*place)[0], made.y = (*place)[1], made.z = place->size() > 2 ? (*place)[2] : null();
    made.heading = null();
    if (const XmlAttribute* heading = element.attribute("heading")) {
      made.heading = number(*heading, -1000, 1000, "rad");
      if (const std::string doubt = angle_doubt(made.heading); !doubt.empty())
        program_.doubts.push_back(heading->value_place.text() + ": attribute \"heading\": " + doubt);
    }
    made.number = number(element, "within", 0.1, 1e-3, far);
    made.patience = number(element, "patience", 0, 1e-3, long_time);
  }

  void wait(const XmlElement& element) {
    expect_attributes(element, {"seconds", "message", "from", "patience"});
    expect_nothing_inside(element);
    const auto* seconds = element.attribute("seconds");
    if (seconds && (element.attribute("message") || element.attribute("from") || element.attribute("patience")))
      refuse(element.place, "<wait> has seconds=\"...\" and more; expected seconds=\"...\" alone, or message=\"...\"");
    if (seconds) {
      add(Act::wait, element).number = number(*seconds, 0, long_time, "s");
      return;
    }
    const std::string message = needed(element, "message", "seconds=\"...\", or the text of a message").value;
    Instruction& made = add(Act::hear, element);
    made.text = await(message);
    made.peer = radio(element, "from");
    made.patience = number(element, "patience", 0, 1e-3, long_time);
  }

  void say(const XmlElement& element) {
    expect_attributes(element, {"text", "to"});
    expect_nothing_inside(element);
    Instruction& made = add(Act::say, element);
    made.text = needed(element, "text", "what it says").value;
    made.peer = radio(element, "to");
  }

  void follow(const XmlElement& element) {
    expect_attributes(element, {"radio", "distance", "until", "patience"});
    expect_nothing_inside(element);
    needed(element, "radio", "the radio of the robot that it follows");
    Instruction& made = add(Act::follow, element);
    made.peer = radio(element, "radio");
    made.number = number(element, "distance", 1, 0, far);
    made.text = element.attribute("until") ? await(text(element, "until")) : "";
    made.patience = number(element, "patience", 0, 1e-3, long_time);
    if (made.text.empty() && made.patience == 0)
      refuse(element.place, "<follow> has no end; expected until=\"MESSAGE\" or patience=\"SECONDS\"");
  }

  void keep_link(const XmlElement& element) {
    expect_attributes(element, {"to", "above", "margin", "lost"});
    const XmlAttribute& to = needed(element, "to", "a radio");
    const std::size_t slot = link(other(to), to);
    if (std::find(kept_.begin(), kept_.end(), slot) != kept_.end())
      refuse(element.place, "the link to " + quote(to.value) + " is kept already, by an element around this one");
    Instruction& made = add(Act::keep, element);
    made.slot = slot;
    made.number = number(needed(element, "above", "a level in dBm, such as -60"), -200, 50, "dBm");
    made.margin = number(element, "margin", 3, 0, 100);
    made.lost = number(element, "lost", 5, 1e-3, long_time);
    kept_.push_back(slot);
    block(element);
    kept_.pop_back();
    add(Act::release, element).slot = slot;
  }

  template <class Body>
  void repeat(const XmlElement& element, const Body& body) {
    if (element.name == "repeat") expect_attributes(element, {"times"});
    if (loops_ == most_loops)
      refuse(element.place, "<" + element.name + "> stands inside " + std::to_string(most_loops) +
                                " others; expected at most " + std::to_string(most_loops) + " in one another");
    const double times = number(element, "times", 0, 1, 1e9);
    if (times != std::floor(times))
      refuse(element.attribute("times")->value_place, "attribute \"times\": expected a whole number");
    const std::size_t begin = program_.code.size(), slot = loops_++;
    add(Act::repeat, element).slot = slot;
    body();
    --loops_;
    Instruction& made = add(Act::again, element);
    made.slot = slot, made.number = times, made.to = begin + 1;
  }

  void patrol(const XmlElement& element) {
    expect_attributes(element, {"times", "within", "patience"});
    if (element.children.empty()) refuse(element.place, "<patrol> is empty; expected <place at=\"x y\"/> in it");
    repeat(element, [&] {
      for (const auto& place : element.children) {
        if (place.name != "place")
          refuse(place.place, "<" + place.name + "> is no element of <patrol>; expected <place at=\"x y\"/>" +
                                  (place.name == "on" ? ", and <on> beside <patrol>, in <mission>" : ""));
        go_to(place, {"at", "heading"});
        program_.code.back().number = number(element, "within", 0.1, 1e-3, far);
        program_.code.back().patience = number(element, "patience", 0, 1e-3, long_time);
      }
    });
  }

  void choose(const XmlElement& element) {
    expect_attributes(element, {});
    std::vector<std::size_t> ends;
    bool has_other = false;
    for (const auto& way : element.children) {
      if (has_other) refuse(way.place, "<" + way.name + "> stands after <otherwise>, which is the last way");
      if (way.name != "if" && way.name != "otherwise")
        refuse(way.place, "<" + way.name + "> is no element of <choose>; " + suggest(way.name, {"if", "otherwise"}));
      has_other = way.name == "otherwise";
      const std::size_t test = program_.code.size();
      if (has_other)
        expect_attributes(way, {});
      else
        condition(way);
      block(way);
      ends.push_back(program_.code.size());
      add(Act::jump, way);
      if (!has_other) program_.code[test].to = program_.code.size();
    }
    if (ends.empty()) refuse(element.place, "<choose> is empty; expected <if> and <otherwise> in it");
    for (const std::size_t end : ends) program_.code[end].to = program_.code.size();
  }

  void condition(const XmlElement& element) {
    if (element.attribute("message")) {
      expect_attributes(element, {"message", "from"});
      Instruction& made = add(Act::test_message, element);
      made.text = await(text(element, "message"));
      made.peer = radio(element, "from");
      return;
    }
    expect_attributes(element, {"message", "from", "link", "below", "above"});
    const XmlAttribute& to = needed(element, "link", "link=\"RADIO\" with below or above, or message=\"...\"");
    if (const auto* from = element.attribute("from"))
      refuse(from->place,
             "<if link=\"...\"> has \"from\", which is of a message; expected link=\"...\" with below or "
             "above, or message=\"...\" with from");
    const auto *below = element.attribute("below"), *above = element.attribute("above");
    if (!below == !above) refuse(element.place, "<if link=\"...\"> needs one of below=\"dBm\" and above=\"dBm\"");
    Instruction& made = add(Act::test_link, element);
    made.slot = link(other(to), to);
    made.below = below;
    made.number = number(below ? *below : *above, -200, 50, "dBm");
  }

  void handler(const XmlElement& element) {
    expect_attributes(element, {"message", "from"});
    const XmlAttribute& given = needed(element, "message", "the text of a message");
    const std::string message = given.value;
    for (const Handler& earlier : program_.handlers) {
      if (earlier.text == message && (earlier.peer < 0 || earlier.peer == radio(element, "from")))
        refuse(given.value_place, "an earlier <on> takes " + quote(message) + " already");
    }
    program_.handlers.push_back({await(message), radio(element, "from"), program_.code.size()});
    block(element);
    add(Act::end, element);
  }

  double radio(const XmlElement& element, const char* name) const {
    const auto* given = element.attribute(name);
    return given ? other(*given) : -1;
  }

  double other(const XmlAttribute& given) const {
    const double row = find_(given.value, given.value_place);
    if (row == own_)
      refuse(given.value_place, "attribute " + quote(given.name) + ": " + quote(given.value) +
                                    " is the robot's own radio; expected another");
    return row;
  }

  std::string await(const std::string& message) {
    auto& all = program_.awaited;
    if (std::find(all.begin(), all.end(), message) == all.end()) all.push_back(message);
    return message;
  }

  std::size_t link(double row, const XmlAttribute& given) {
    auto& all = program_.links;
    const auto found = std::find(all.begin(), all.end(), row);
    if (found != all.end()) return static_cast<std::size_t>(found - all.begin());
    if (all.size() == most_links)
      refuse(given.place, "a mission looks at the links of at most " + std::to_string(most_links) + " radios");
    all.push_back(row);
    return all.size() - 1;
  }

  const FindRadio& find_;
  double own_;
  bool flies_;
  Program program_;
  std::size_t loops_ = 0;
  std::vector<std::size_t> kept_;
};

}  // namespace

Program compile(const XmlElement& root, const FindRadio& find, double own, bool flies) {
  Program program = Compiler(find, own, flies).compile(root);
  program.mark = mark_of(root);
  return program;
}

}  // namespace muster::missions
