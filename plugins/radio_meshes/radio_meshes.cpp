// Meshes that block radio links.
#include <cstring>
#include <muster/plugin.hpp>
#include <muster/reverse_links.hpp>
#include <optional>
#include <scene/far_links.hpp>
#include <vector>

#include "mesh_scene.hpp"
#include "world_meshes.hpp"

namespace {

using namespace muster;

struct RadioMeshes {
  static constexpr auto id = "radio.meshes/1";
  static constexpr auto summary = "meshes that stand between two radios cost their material's loss";
  static constexpr auto manual =
      R"(Adds to the level of a link minus the loss of its material for each body of a <mesh> that the straight way
between both radios passes, and for each crossing of a sheet. A solid's surface is entered and left: two
crossings are one body, and a radio inside leaves through one. Counts are exact on the lattice of walls, ties
included, and the same both ways.)";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr bool keeps_only_caches = true;

  explicit RadioMeshes(Setup& s)
      : pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        shape(s.read<MeshShape>("mesh/*/shape")),
        loss(s.read<Loss>("material/*/loss")),
        level(s.add<Level>("link/*/level")),
        meshes(s) {}

  void step(const Step& k) {
    place(k);
    count(k);
    const auto shapes = k[shape];
    for (std::size_t i = 0; i < k[ends].size(); ++i) {
      double sum = 0;
      for (std::size_t m = 0; m < shapes.size(); ++m) {
        const int crossings = counted[i * shapes.size() + m];
        const int times = shapes[m].sheet != 0 ? crossings : (crossings + 1) / 2;
        sum -= times * k[loss][static_cast<std::size_t>(shapes[m].material)].loss;
      }
      k[level][i].level = sum;
    }
  }

  // Rebuilds the scene only when a mesh has changed.
  void place(const Step& k) {
    if (scene && same(k[shape], shapes_kept)) return;
    if (shapes_kept.empty()) meshes.warn_of_sizes(k, k[shape], k[pose]);
    scene.reset();
    ends_kept.clear();
    scene.emplace(meshes.placed(k[shape]));
    shapes_kept.assign(k[shape].begin(), k[shape].end());
  }

  // Counts are cached for links whose ends are unchanged, to the bit.
  void count(const Step& k) {
    const auto links = k[ends];
    const auto at = k[pose];
    const std::size_t width = k[shape].size();
    const bool known = same(links, ends_kept) && at.size() == at_kept.size();
    std::vector<char> moved(at.size(), 1);
    for (std::size_t i = 0; i < at.size() && known; ++i) moved[i] = std::memcmp(&at[i], &at_kept[i], sizeof(Pose)) != 0;
    ends_kept.clear();  // so that nothing old is left if this throws
    counted.resize(links.size() * width);
    const auto back = earlier_reverse(links, at.size());
    for (std::size_t i = 0; i < links.size(); ++i) {
      const auto tx = static_cast<std::size_t>(links[i].tx), rx = static_cast<std::size_t>(links[i].rx);
      if (!moved[tx] && !moved[rx]) continue;
      int* const own = counted.data() + i * width;
      if (back[i] != no_link) {
        std::copy_n(counted.data() + back[i] * width, width, own);
      } else {
        std::fill_n(own, width, 0);
        const auto near = scene::near_part(point(at[tx]), point(at[rx]));
        if (near) scene->count(on_lattice(near->from), on_lattice(near->to), own);
      }
    }
    ends_kept.assign(links.begin(), links.end());
    at_kept.assign(at.begin(), at.end());
  }

  static scene::Point point(const Pose& p) { return {p.x, p.y, p.z}; }
  static Vector on_lattice(const scene::Point& p) { return {scene::snap(p.x), scene::snap(p.y), scene::snap(p.z)}; }

  template <class Row>
  static bool same(Rows<const Row> now, const std::vector<Row>& kept) {
    return now.size() == kept.size() &&
           (now.empty() || !std::memcmp(now.begin(), kept.data(), now.size() * sizeof(Row)));
  }

  In<Pose> pose;
  In<Ends> ends;
  In<MeshShape> shape;
  In<Loss> loss;
  Out<Level> level;
  WorldMeshes meshes;
  std::optional<MeshScene> scene;
  std::vector<MeshShape> shapes_kept;
  std::vector<Ends> ends_kept;
  std::vector<Pose> at_kept;
  std::vector<int> counted;  // by link and mesh
};

}  // namespace

MUSTER_PLUGIN_IS(RadioMeshes)
