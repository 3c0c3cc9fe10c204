// Lets a robot join at one tick and leave at another.
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Join {
  static constexpr auto id = "toy.join/1", summary = "lets rows join and leave";
  static constexpr auto phase = MUSTER_PHYSICS;
  static constexpr Param params[] = {
      text("who", "late", "name of the row that joins"),
      text("table", "robot/*/pose", "by this claim"),
      integer("at", 2, 0, 1000, "tick at which it joins"),
      integer("leave", 5, 0, 1000, "tick at which it leaves"),
      integer("leaver", -1, -1, 100, "row that leaves; -1: the one that joined"),
      integer("like", -1, -1, 100, "row like which it begins"),
      text("quantity", "pose", "quantity of which column 1 is set to 7"),
      integer("column", 1, 0, 100, "that column"),
      real("value", 7, -1e6, 1e6, "m", "its value"),
      flag("twice", false, "join twice in a step"),
  };

  explicit Join(Setup& s)
      : at(s.value("at")),
        leave(s.value("leave")),
        leaver(s.value("leaver")),
        like(s.value("like")),
        column(s.value("column")),
        value(s.value("value")),
        twice(s.value("twice")),
        who(s.text("who")),
        quantity(s.text("quantity")),
        host(s.host()) {
    claim = host->claim(host, MUSTER_WRITE, MUSTER_JOINS, s.text("table").c_str(), Pose::columns);
    if (claim < 0) throw std::runtime_error("");
  }

  void step(const Step& k) const {
    if (k.tick() == static_cast<uint64_t>(k[at])) {
      const int row = host->join(host, claim, who.c_str(), static_cast<int>(k[like]));
      if (k[twice] != 0) host->join(host, claim, who.c_str(), -1);
      if (row >= 0)
        host->place(host, claim, static_cast<uint32_t>(row), quantity.c_str(), static_cast<uint32_t>(k[column]),
                    k[value]);
    }
    if (k.tick() == static_cast<uint64_t>(k[leave])) {
      host->leave(host, claim, k[leaver] >= 0 ? static_cast<uint32_t>(k[leaver]) : k.rows("robot") - 1);
    }
  }

  Value at, leave, leaver, like, column, value, twice;
  std::string who, quantity;
  const muster_host* host;
  int claim;
};

}  // namespace

MUSTER_PLUGIN_IS(Join)
