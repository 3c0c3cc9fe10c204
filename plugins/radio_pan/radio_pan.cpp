// Membership of radios in a personal area network.
#include <algorithm>
#include <muster/names.hpp>
#include <muster/pan.hpp>
#include <muster/plugin.hpp>
#include <vector>

namespace {

using namespace muster;

struct RadioPan {
  static constexpr auto id = "radio.pan/1";
  static constexpr auto summary = "a personal area network (PAN) of IEEE 802.15.4, and the radios in it";
  static constexpr auto manual =
      R"(The radios named in `radios` are in the PAN `id`: stations, and robots by their names. Whom no radio.pan names is
in the PAN 0. What is sent to all goes to the sender's PAN; a message to one receiver may go to another PAN, in frames
two octets longer. All PANs share the channel: a radio hears the frames of others, waits for
them and is busy with them.
network.lrwpan and network.ns3 read it, other networks do not.)";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      integer("id", 0, 0, 0xFFFE, "macPANId").required(),
      text("radios", "", "names of radios, with spaces between them").required(),
  };

  explicit RadioPan(Setup& s) : number(s.value("id")) {
    const std::vector<std::string> names = names_in(s.host(), "radios");
    for (auto name = names.begin(); name != names.end(); ++name) {
      if (std::find(names.begin(), name, *name) != name)
        throw BadInput("attribute \"radios\": \"" + *name + "\" stands there twice");
      members.push_back(s.write<Pan>("radio/" + *name + "/pan"));
    }
    if (names.empty()) throw BadInput("attribute \"radios\": there is none; expected names of radios");
  }

  void step(const Step& k) const {
    for (const Out<Pan>& member : members)
      for (Pan& pan : k[member]) pan.id = k[number];
  }

  Value number;
  std::vector<Out<Pan>> members;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioPan)
