// Reflections from walls: their change of the direct wave's level.
#include <algorithm>
#include <cmath>
#include <complex>
#include <muster/plugin.hpp>
#include <muster/reverse_links.hpp>
#include <tuple>

#include "image_paths.hpp"
#include "plugins/scene_rows.hpp"

namespace {

using namespace muster;

struct RadioImages {
  static constexpr auto id = "radio.images/1";
  static constexpr auto summary = "waves that walls reflect once or twice, by the image method";
  static constexpr auto manual =
      R"(level@paths = 20 log10 |1 + sum of R (d/e) 10^((W0 - W)/20) exp(-i 2 pi (e - d) / wavelength)|, over the ways by
one wall or, with `bounces` 2, by two: e is the way's length and d the direct one's, W and W0 what the walls that stand
in either take in dB, and R Fresnel's reflection of an upright field by a wall of `permittivity`, times `reflection`. It
is what reflections add to the terms of distance and walls. Without `coherent` powers are added in place of amplitudes:
the mean over places a few wavelengths apart.
Open doors reflect nothing. McKown and Hamilton, Ray tracing as a design tool for radio networks, IEEE Network 5(6), 1991.)";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      integer("bounces", 1, 1, 2, "most walls that reflect a wave on its way"),
      real("reflection", 1, 0, 1, "", "share of amplitude that the walls' roughness leaves, at each"),
      real("permittivity", 5, 1, 1e9, "", "of walls against that of air: 2 to 3 for plasterboard, 4 to 7 for concrete"),
      real("frequency", 2.44e9, 1e6, 1e12, "Hz", "carrier"),
      flag("coherent", true, "waves interfere; without, their powers add up"),
  };

  explicit RadioImages(Setup& s)
      : bounces(s.value("bounces")),
        reflection(s.value("reflection")),
        permittivity(s.value("permittivity")),
        frequency(s.value("frequency")),
        coherent(s.value("coherent")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        wall(s.read<Wall>("wall/*/shape")),
        door(s.read<Door>("door/*/shape")),
        state(s.read<DoorState>("door/*/state")),
        floor(s.read<FloorShape>("floor/*/shape")),
        loss(s.read<Loss>("material/*/loss")),
        level(s.add<Level>("link/*/level@paths")) {}

  void step(const Step& k) const {
    const auto links = k[ends];
    const auto at = k[pose];
    const auto out = k[level];
    std::vector<double> losses;
    for (const Loss& each : k[loss]) losses.push_back(each.loss);
    const auto back = earlier_reverse(links, at.size());
    try {
      ImagePaths paths(scene_walls(k[wall]), scene_doors(k[door], k[state], k[wall]), scene_floors(k[floor]), losses);
      for (std::size_t i = 0; i < links.size(); ++i) {
        const Pose &a = at[static_cast<std::size_t>(links[i].tx)], &b = at[static_cast<std::size_t>(links[i].rx)];
        // Ordered by their places, so that both directions agree to the last bit.
        const bool turned = std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z);
        const Pose &p = turned ? b : a, &q = turned ? a : b;
        out[i].level = back[i] != no_link ? out[back[i]].level : added(k, paths, {p.x, p.y, p.z}, {q.x, q.y, q.z});
      }
    } catch (const std::runtime_error& e) {  // throws for walls, doors, floors and places, which are the user's input
      throw BadInput(e.what());
    }
  }

  // In dB, relative to the direct wave's level.
  double added(const Step& k, ImagePaths& paths, const scene::Point& p, const scene::Point& q) const {
    const double x = p.x - q.x, y = p.y - q.y, z = p.z - q.z, direct = std::max(std::sqrt(x * x + y * y + z * z), 0.01);
    const double turns = k[frequency] / 299792458, walls = paths.loss(p, q);
    std::complex<double> field = 1;
    double power = 1;
    paths.visit(p, q, static_cast<int>(k[bounces]), k[permittivity], [&](const ImagePath& way) {
      const double rough = way.mirrors == 2 ? k[reflection] * k[reflection] : k[reflection];
      const double share = rough * way.reflection * direct / way.length * std::pow(10, (walls - way.walls) / 20);
      field += std::polar(1.0, -6.283185307179586 * turns * (way.length - direct)) * share;
      power += share * share;
    });
    return 10 * std::log10(std::max(k[coherent] != 0 ? std::norm(field) : power, 1e-12));
  }

  Value bounces, reflection, permittivity, frequency, coherent;
  In<Pose> pose;
  In<Ends> ends;
  In<Wall> wall;
  In<Door> door;
  In<DoorState> state;
  In<FloorShape> floor;
  In<Loss> loss;
  Out<Level> level;
};

}  // namespace

MUSTER_PLUGIN_IS(RadioImages)
