// A radio that emits noise.
#include <muster/emission.hpp>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct RadioJammer {
  static constexpr auto id = "radio.jammer/1";
  static constexpr auto summary = "a radio radiates noise, steadily or in pulses";
  static constexpr auto manual =
      R"(The radio `radio`, a station's or a robot's, radiates noise from where it is. The same links carry it as carry
messages: walls, shadowing and fading weaken it. `excess` is its power above that of a radio's messages (the channel's
tx_power), over all of its `bandwidth`; a receiver takes in what part of that lies in its own band.
On for the first `duty` of each `period`; periods begin at `phase`, whatever the ticks are.
Networks that share a channel feel it, in what they receive and in what they hear before they talk; network.ideal
does not. While it is on, its own radio hears nothing in its band.)";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      reference("radio", "radio", "the radio that radiates").required(),
      real("excess", 0, -200, 200, "dB", "power above that of messages"),
      real("frequency", 2.44175e9, 1, 1e12, "Hz", "at its spectrum's middle; by default that of the band at 2.4 GHz"),
      real("bandwidth", 83.5e6, 0, 1e12, "Hz", "of its spectrum, which is flat; by default all of that band"),
      real("period", 1, 1e-5, 1e6, "s", "of its pulses; only with duty below 1"),
      real("duty", 1, 0, 1, "", "share of a period in which it is on"),
      real("phase", 0, -1e6, 1e6, "s", "when a period begins; only with duty below 1"),
  };

  explicit RadioJammer(Setup& s)
      : excess(s.value("excess")),
        frequency(s.value("frequency")),
        bandwidth(s.value("bandwidth")),
        period(s.value("period")),
        duty(s.value("duty")),
        pulse_phase(s.value("phase")),
        emission(s.write<Emission>("radio/{radio}/emission")) {}

  void step(const Step& k) const {
    *k[emission] = {k[excess], k[frequency], k[bandwidth], k[period], k[duty], k[pulse_phase]};
  }

  Value excess, frequency, bandwidth, period, duty, pulse_phase;
  Out<Emission> emission;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioJammer)
