// Does one thing wrong in one step, in the last phase, after all others have published.
#include <limits>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Odd {
  static constexpr const char* columns = "x[m] rssi[dBm]? range[m]~ friend:robot mate:robot?";
  double x, rssi, range, friend_, mate;
};

struct Fault {
  static constexpr auto id = "toy.fault/1", summary = "does something wrong";
  static constexpr auto phase = MUSTER_OBSERVE;
  static constexpr Param params[] = {
      choice("fault",
             "none|nan|infinite|nan_for_null|minus_infinite|no_row|half_row|null_row|throws|throws_int|fails|refuses|"
             "says_and_returns|appends|puts|claims|rounds",
             "what"),
      integer("tick", 3, 0, 1000, "the tick"),
  };

  explicit Fault(Setup& s) : fault(s.value("fault")), at(s.value("tick")), out(s.write<Odd>("robot/*/odd")) {}

  void step(const Step& k) const {
    const auto rows = k[out];
    for (auto& row : rows)
      row = {1.0 + static_cast<double>(k.tick()), null(), std::numeric_limits<double>::infinity(), 0, null()};
    if (k.tick() != static_cast<uint64_t>(k[at])) return;
    Odd& odd = rows[rows.size() - 1];
    static const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    switch (static_cast<int>(k[fault])) {
      case 1:
        odd.x = nan;
        break;
      case 2:
        odd.x = inf;
        break;
      case 3:
        odd.rssi = -nan;
        break;
      case 4:
        odd.rssi = -inf;
        break;
      case 5:
        odd.friend_ = static_cast<double>(rows.size());
        break;
      case 6:
        odd.mate = 0.5;
        break;
      case 7:
        odd.friend_ = null();
        break;
      case 8:
        throw std::runtime_error("the wheel came off");
      case 9:
        throw 7;
      case 10:
        throw std::runtime_error("");
      case 11:
        throw BadInput("the wheel in the file is square");
      case 12:
        k.host()->error(k.host(), "said something and went on");
        break;
      case 13:
        k.append(out, 100000)[99999].x = 1;
        break;
      case 14:
        k.put_bytes(out, 0, 0, "abc");
        break;
      case 15:
        k.host()->claim(k.host(), MUSTER_READ, 0, "robot/*/pose", Pose::columns);
        break;
      case 16:
        round_up();
        break;
      default:
        break;
    }
  }

  static void round_up() {
    unsigned word;
    asm volatile("stmxcsr %0" : "=m"(word));
    word = (word & ~0x6000u) | 0x4000u;
    asm volatile("ldmxcsr %0" : : "m"(word));
  }

  Value fault, at;
  Out<Odd> out;
};

}  // namespace

MUSTER_PLUGIN_IS(Fault)
