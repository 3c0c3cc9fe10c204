// A robot's mission: steps that drive the controllers which the world has, and messages that go by its radio.
#include <cmath>
#include <cstdio>
#include <muster/plugin.hpp>

#include "mission_doubts.hpp"
#include "mission_elements.hpp"
#include "mission_program.hpp"
#include "plugins/heading.hpp"
#include "plugins/own_radio.hpp"
#include "plugins/periods.hpp"
#include "switching.hpp"

namespace {

using namespace muster;
using namespace muster::missions;

// Messages that came and that no step has taken yet: one of each text and sender.
class Mail {
 public:
  explicit Mail(std::string_view bytes) {
    while (!bytes.empty()) {
      const auto name = bytes.find(between), end = bytes.find(after);
      if (end == bytes.npos) break;
      letters_.push_back({std::string(bytes.substr(0, name)), std::string(bytes.substr(name + 1, end - name - 1))});
      bytes.remove_prefix(end + 1);
    }
  }

  void put(double from, const std::string& text) {
    const Letter letter{print_real(from), text};
    if (std::find(letters_.begin(), letters_.end(), letter) == letters_.end()) letters_.push_back(letter);
  }

  // From -1: from anybody.
  bool take(double from, const std::string& text) {
    const auto found = std::find_if(letters_.begin(), letters_.end(), [&](const Letter& letter) {
      return letter.text == text && (from < 0 || letter.from == print_real(from));
    });
    if (found == letters_.end()) return false;
    letters_.erase(found);
    return true;
  }

  std::string bytes() const {
    std::string result;
    for (const Letter& letter : letters_) result += letter.from + between + letter.text + after;
    return result;
  }

 private:
  static constexpr char between = '\x1f', after = '\x1e';  // ASCII's separators of units and of records
  struct Letter {
    std::string from, text;
    bool operator==(const Letter&) const = default;
  };
  std::vector<Letter> letters_;
};

struct Spot {
  double x, y, z, yaw;
  double to(double px, double py, double pz) const { return std::hypot(px - x, py - y, is_null(pz) ? 0 : pz - z); }
};

struct ControlMission {
  static constexpr auto id = "control.mission/2";
  static constexpr auto summary = "does a mission: places, patrols, messages, links to keep, choices";
  static constexpr auto manual =
      "`mission` is an XML file in the world's folder: <go_to>, <patrol>, <follow>, <wait>, <say>, <keep_link>,\n"
      "<repeat>, <choose>, and <on message=> for what ends it at once (docs/reference/mission_file.md). On the ground\n"
      "the mission asks for places in robot/*/goal2d, to which control.goal2d drives; in the air it asks for a\n"
      "velocity (velocity3d) towards the place. It knows its own odometry, or position3d, and the messages that its\n"
      "radio receives. A message that it awaits is answered by \"ok\" and its text. The table self/state has the line\n"
      "of the file that it is at.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr bool keeps_only_caches = true;  // sent_ is counted anew in each step
  static constexpr Param params[] = {
      reference("robot", "robot", "the robot that does it, heard through the radio of the same name").required(),
      text("mission", "", "an XML file").required(),
      choice("moves", "ground|air", "by goal2d, or by velocity3d"),
      real("report", 0, 0, 1000, "s", "it says \"at X Y Z\" to all so often; 0: never"),
      flag("answers", true, "it answers the messages that it awaits"),
      real("smoothing", 2, 0, 1000, "s", "time constant of the filter of rssi"),
      real("speed", 1, 1e-3, 100, "m/s", "in the air; only with moves=\"air\""),
      real("gain", 1, 1e-3, 100, "1/s", "velocity for each metre of distance; only with moves=\"air\""),
      real("heading_gain", 1, 0, 100, "1/s", "turn rate for each radian off the heading; only with moves=\"air\"")};

  struct State {
    static constexpr const char* columns =
        "line mission at begun began[s] x[m]? y[m]? z[m]? yaw[rad]? leader_x[m]? leader_y[m]? leader_z[m]? held "
        "good_x[m]? "
        "good_y[m]? good_z[m]? next_x[m]? next_y[m]? next_z[m]? next_since[s] handled count0 count1 count2 count3 "
        "rssi0[dBm]? rssi1[dBm]? rssi2[dBm]? rssi3[dBm]? "
        "heard0[s] heard1[s] heard2[s] heard3[s] kept0? kept1? kept2? kept3? mail{}";
    double line, mission, at;  // in the file; the mission's mark; number of the instruction
    double begun, began;       // 1 while an instruction goes on, and since when
    double x, y, z, yaw;       // where it is to be
    double leader_x, leader_y, leader_z;
    double held, good_x, good_y, good_z;        // 1 while a link that is kept is too weak; where all were strong
    double next_x, next_y, next_z, next_since;  // the next such place once the filter has followed, null where weak
    double handled;                             // 1: a message has ended the mission
    double count[most_loops];
    double rssi[most_links], heard[most_links], kept[most_links];  // the number of the <keep_link>
    double mail;
  };
  static constexpr unsigned mail_column = 37;
  static_assert(sizeof(State) == (mail_column + 1) * sizeof(double) && most_loops == 4 && most_links == 4);

  explicit ControlMission(Setup& s)
      : report(s.value("report")),
        answers(s.value("answers")),
        smoothing(s.value("smoothing")),
        speed(s.value("speed")),
        gain(s.value("gain")),
        heading_gain(s.value("heading_gain")),
        flies(s.param("moves") == 1),
        radio(own_radio(s)),
        program(compile(
            read_file(s, "mission"),
            [&](const std::string& name, const Place& place) { return radio_row(s, name, place); }, radio, flies)),
        inbox(s.read<Incoming>("inbox/{robot}/message")),
        outbox(s.write<Outgoing>("outbox/{robot}/message")),
        state(s.write<State>("self/state")) {
    for (const std::string& doubt : program.doubts) s.host()->event(s.host(), ("warning: " + doubt).c_str());
    const char* robot = s.host()->row_name(s.host(), "robot", static_cast<uint32_t>(s.param("robot")));
    for (const std::string& doubt : doubts_of_mission(s, robot, read_file(s, "mission")))
      s.host()->event(s.host(), ("warning: " + doubt).c_str());
    if (flies) {
      position = s.read<Position3d>("robot/{robot}/position3d");
      velocity = s.write<Velocity3d>("robot/{robot}/velocity3d");
    } else {
      odometry = s.read<Odometry>("robot/{robot}/odometry");
      goal = s.write<Goal2d>("robot/{robot}/goal2d");
    }
  }

  void step(const Step& k) const {
    State now = *k.last(state);
    Mail mail(k.last_bytes(state, 0, mail_column));
    const Spot here = where(k);
    if (now.mission != program.mark) begin_anew(now), mail = Mail("");
    if (is_null(now.x)) now.x = here.x, now.y = here.y, now.z = here.z, now.yaw = null();
    listen(k, now, mail);
    handle(k, now, mail);
    look_at_links(k, now, here);
    // Steps that take no time follow one another; a mission of such alone goes round once a tick.
    for (std::size_t i = 0; i <= program.code.size() && advance(k, now, mail, here); ++i) continue;
    now.line = program.code[static_cast<std::size_t>(now.at)].line;
    drive(k, now, here);
    if (k[report] > 0 && is_due(k.time(), k.dt(), k[report])) send(k, -1, place_text(here));
    k.put_bytes(state, 0, mail_column, mail.bytes());
    now.mail = k[state]->mail;
    *k[state] = now;
  }

  // Another mission stood here before: the robot's first, or that of a plugin which was swapped.
  void begin_anew(State& now) const {
    now = {};
    now.mission = program.mark;
    now.x = now.leader_x = now.good_x = now.next_x = null();
    std::fill(now.rssi, now.rssi + most_links, null());
    std::fill(now.kept, now.kept + most_links, null());
  }

  Spot where(const Step& k) const {
    if (flies) return {k[*position]->x, k[*position]->y, k[*position]->z, k[*position]->yaw};
    return {k[*odometry]->x, k[*odometry]->y, 0, k[*odometry]->yaw};
  }

  void send(const Step& k, double to, const std::string& words) const {
    k.send(outbox, sent_++, words) = {radio, to < 0 ? null() : to, 0};
  }

  static std::string place_text(const Spot& at) {
    return "at " + print_real(at.x) + ' ' + print_real(at.y) + ' ' + print_real(at.z);
  }

  void listen(const Step& k, State& now, Mail& mail) const {
    sent_ = 0;
    const auto& awaited = program.awaited;
    const Instruction& doing = program.code[static_cast<std::size_t>(now.at)];
    for (std::size_t i = 0; i < k[inbox].size(); ++i) {
      const Incoming& message = k[inbox][i];
      const std::string words(k.bytes(inbox, i, Incoming::payload_column));
      for (std::size_t link = 0; link < program.links.size(); ++link) {
        if (message.from != program.links[link]) continue;
        double& rssi = now.rssi[link];
        rssi = is_null(rssi) ? message.rssi
                             : smoothed(rssi, message.rssi, message.t_received - now.heard[link], k[smoothing]);
        now.heard[link] = message.t_received;
      }
      if (doing.act == Act::follow && message.from == doing.peer) hear_place(words, now);
      if (std::find(awaited.begin(), awaited.end(), words) == awaited.end()) continue;
      mail.put(message.from, words);
      if (k[answers] != 0) send(k, message.from, "ok " + words);
    }
  }

  static constexpr double farthest = 1e6;  // [m] a place further off is nonsense

  static void hear_place(const std::string& words, State& now) {
    if (words.rfind("at ", 0) != 0) return;
    const auto place = parse_reals(std::string_view(words).substr(3), 3);
    const auto is_near = [](double at) { return std::abs(at) <= farthest; };
    if (place && std::all_of(place->begin(), place->end(), is_near))
      now.leader_x = (*place)[0], now.leader_y = (*place)[1], now.leader_z = (*place)[2];
  }

  void handle(const Step& k, State& now, Mail& mail) const {
    for (const Handler& handler : program.handlers) {
      if (now.handled != 0 || !mail.take(handler.peer, handler.text)) continue;
      now.handled = 1, now.begun = 0, now.at = static_cast<double>(handler.to);
      std::fill(now.kept, now.kept + most_links, null());
      k.event("the mission is ended by \"" + handler.text + '"');
    }
  }

  // A link is too weak below its level, and again strong enough above that and its margin.
  void look_at_links(const Step& k, State& now, const Spot& here) const {
    bool weak = false, strong = true, any = false;
    double longest = 0;  // [s] silence that is borne
    for (std::size_t link = 0; link < program.links.size(); ++link) {
      if (is_null(now.kept[link])) continue;
      const Instruction& keep = program.code[static_cast<std::size_t>(now.kept[link])];
      const bool heard = !is_null(now.rssi[link]) && k.time() - now.heard[link] <= keep.lost;
      any = true;
      longest = std::max(longest, keep.lost);
      weak = weak || !heard || now.rssi[link] < keep.number;
      strong = strong && heard && now.rssi[link] >= keep.number + keep.margin;
    }
    const bool was_held = now.held != 0;
    now.held = any && (was_held ? !strong : weak);
    constexpr double followed = 3;  // time constants, after which the filter has 95 % of a step
    remember(k, now, here, strong, any ? followed * k[smoothing] + longest : 0);
  }

  // Filtered levels are those of places further back. So where they are strong becomes a place to go back to only when
  // they are still strong after the filter's `lag`: at the last strong one the link itself is weaker.
  static void remember(const Step& k, State& now, const Spot& here, bool strong, double lag) {
    if (is_null(now.good_x)) now.good_x = here.x, now.good_y = here.y, now.good_z = here.z;
    if (!strong) now.next_x = null();
    if (!strong || (!is_null(now.next_x) && k.time() - now.next_since < lag)) return;
    if (!is_null(now.next_x)) now.good_x = now.next_x, now.good_y = now.next_y, now.good_z = now.next_z;
    now.next_x = here.x, now.next_y = here.y, now.next_z = here.z, now.next_since = k.time();
  }

  bool is_over(const Step& k, const State& now, const Instruction& doing, const char* what) const {
    if (doing.patience == 0 || k.time() - now.began < doing.patience) return false;
    k.event("line " + std::to_string(doing.line) + ": gives up " + what + " after " + print_real(doing.patience) +
            " s");
    return true;
  }

  // Begins or goes on with an instruction; true where it is done, and the next is at hand.
  bool advance(const Step& k, State& now, Mail& mail, const Spot& here) const {
    const Instruction& doing = program.code[static_cast<std::size_t>(now.at)];
    if (now.begun == 0) {
      now.begun = 1, now.began = k.time();
      begin(now, doing);
      if (doing.act == Act::end) k.event("the mission is done");
    }
    const auto next = [&] { return now.begun = 0, ++now.at, true; };
    const auto jump = [&](std::size_t to) { return now.begun = 0, now.at = static_cast<double>(to), true; };
    switch (doing.act) {
      case Act::go_to:
        if (now.held == 0 && is_there(doing, here)) return next();
        return is_over(k, now, doing, "going there") && (stay(now, here), next());
      case Act::follow:
        if (!doing.text.empty() && mail.take(doing.peer, doing.text)) return next();
        if (!is_null(now.leader_x)) aim_behind(now, doing, here);
        return is_over(k, now, doing, "following") && (stay(now, here), next());
      case Act::wait:
        return k.time() - now.began >= doing.number && next();
      case Act::hear:
        if (mail.take(doing.peer, doing.text)) return next();
        return is_over(k, now, doing, "waiting") && next();
      case Act::say:
        return send(k, doing.peer, doing.text), next();
      case Act::keep:
        return now.kept[doing.slot] = now.at, next();
      case Act::release:
        return now.kept[doing.slot] = null(), next();
      case Act::repeat:
        return now.count[doing.slot] = 0, next();
      case Act::again:
        ++now.count[doing.slot];
        return doing.number == 0 || now.count[doing.slot] < doing.number ? jump(doing.to) : next();
      case Act::test_message:
        return mail.take(doing.peer, doing.text) ? next() : jump(doing.to);
      case Act::test_link: {
        const double rssi = now.rssi[doing.slot];
        const bool holds = doing.below ? is_null(rssi) || rssi < doing.number : rssi > doing.number;
        return holds ? next() : jump(doing.to);
      }
      case Act::jump:
        return jump(doing.to);
      case Act::end:
        return false;
    }
    return false;
  }

  static void begin(State& now, const Instruction& doing) {
    if (doing.act == Act::follow) now.leader_x = null();
    if (doing.act != Act::go_to) return;
    now.x = doing.x, now.y = doing.y, now.yaw = doing.heading;
    if (!is_null(doing.z)) now.z = doing.z;
  }

  static void stay(State& now, const Spot& here) { now.x = here.x, now.y = here.y, now.z = here.z, now.yaw = null(); }

  bool is_there(const Instruction& to, const Spot& here) const {
    constexpr double turned = 0.05;  // [rad]
    if (here.to(to.x, to.y, flies ? to.z : null()) > to.number) return false;
    return is_null(to.heading) || std::abs(turn_to(to.heading, here.yaw)) <= turned;
  }

  // The point at a distance from the leader, on the way to it.
  static void aim_behind(State& now, const Instruction& doing, const Spot& here) {
    const double away = std::hypot(now.leader_x - here.x, now.leader_y - here.y);
    const double part = away > doing.number ? 1 - doing.number / away : 0;
    now.x = here.x + part * (now.leader_x - here.x);
    now.y = here.y + part * (now.leader_y - here.y);
    now.yaw = null();
  }

  void drive(const Step& k, const State& now, const Spot& here) const {
    const bool held = now.held != 0;
    const Spot to{held ? now.good_x : now.x, held ? now.good_y : now.y, held ? now.good_z : now.z,
                  held ? null() : now.yaw};
    if (!flies) {
      *k[*goal] = {to.x, to.y, to.yaw};
      return;
    }
    const double away = here.to(to.x, to.y, to.z), pull = std::min(k[gain], away > 0 ? k[speed] / away : k[gain]);
    const double turn = is_null(to.yaw) ? 0 : turn_to(to.yaw, here.yaw);
    *k[*velocity] = {
        pull * (to.x - here.x), pull * (to.y - here.y), pull * (to.z - here.z), k[heading_gain] * turn, 0, 0, 0};
  }

  Value report, answers, smoothing, speed, gain, heading_gain;
  bool flies;
  double radio;
  Program program;
  In<Incoming> inbox;
  Out<Outgoing> outbox;
  Out<State> state;
  std::optional<In<Position3d>> position;
  std::optional<Out<Velocity3d>> velocity;
  std::optional<In<Odometry>> odometry;
  std::optional<Out<Goal2d>> goal;
  mutable std::size_t sent_ = 0;  // in this step
};

}  // namespace

MUSTER_PLUGIN_IS(ControlMission)
