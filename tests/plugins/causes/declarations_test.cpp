// Declarations of causes: complete, consistent, and equal to the README.
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "loader/library.hpp"
#include "survey.hpp"
#include "text/names.hpp"

namespace muster {
namespace {

std::set<std::string> words(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

class Declarations : public testing::Test {
 protected:
  Declarations() : listed(list_plugins({MUSTER_PLUGINS_DIR})) {
    for (const auto& plugin : listed) {
      const std::string id = plugin.library ? std::string(plugin.library->id()) : "";
      if (id.rfind("effect.", 0) == 0) causes[id] = &plugin.library->plugins().back();
    }
  }

  static const muster_param* find(const muster_plugin& plugin, const std::string& name) {
    const auto* end = plugin.params + plugin.param_count;
    const auto* found = std::find_if(plugin.params, end, [&](const muster_param& p) { return name == p.name; });
    return found == end ? nullptr : found;
  }

  std::vector<ListedPlugin> listed;
  std::map<std::string, const muster_plugin*> causes;
};

TEST_F(Declarations, AllCausesThatTheProjectPromisesAreThere) {
  for (const char* name : {"tx_offset",
                           "rx_offset",
                           "feeder_loss",
                           "antenna_tx",
                           "antenna_rx",
                           "sector_antenna",
                           "tx_drift",
                           "tx_step",
                           "tx_periodic",
                           "body_shadow",
                           "wall_material",
                           "wall_absent",
                           "unmapped_wall",
                           "obstacle",
                           "dual_slope",
                           "two_ray",
                           "corridor",
                           "incidence",
                           "height",
                           "room_clutter",
                           "drift",
                           "step",
                           "periodic",
                           "people",
                           "rssi_saturation",
                           "rssi_floor",
                           "rssi_compression",
                           "power_steps",
                           "channel_mixture",
                           "fading_law",
                           "outliers",
                           "tx_misplaced",
                           "label_swap",
                           "labels_shifted",
                           "plan_turned",
                           "plan_shifted",
                           "column_shifted",
                           "asymmetry",
                           "noise_floor_rssi",
                           "shadowing_correlation",
                           "multiwall_saturation"})
    EXPECT_TRUE(causes.count(std::string("effect.") + name)) << name;
}

TEST_F(Declarations, EveryCauseIsFilledIn) {
  for (const auto& [id, plugin] : causes) {
    SCOPED_TRACE(id);
    ASSERT_NE(plugin->cause, nullptr);
    const muster_cause& cause = *plugin->cause;
    EXPECT_EQ(cause.size, sizeof(muster_cause));
    EXPECT_GE(cause.kind, static_cast<uint32_t>(MUSTER_TERM));
    EXPECT_LE(cause.kind, static_cast<uint32_t>(MUSTER_INSTRUMENT));
    ASSERT_NE(plugin->manual, nullptr);
    for (const char* text : {plugin->summary, plugin->manual, cause.title, cause.imitators, cause.tell_apart})
      EXPECT_GT(std::strlen(text), 10u);
    for (const auto& imitator : words(cause.imitators)) {
      EXPECT_TRUE(causes.count(imitator)) << imitator;
      EXPECT_NE(imitator, id);
    }
    for (const auto& row : words(cause.ranges_over)) {
      const auto* over = find(*plugin, row);
      ASSERT_NE(over, nullptr) << row;
      EXPECT_EQ(over->kind, static_cast<uint32_t>(MUSTER_REFERENCE));
    }
    const auto known = words("t tx_x tx_y tx_z tx_yaw rx_x rx_y rx_z rx_yaw power noise walls");
    for (const auto& covariate : words(cause.covariates)) EXPECT_TRUE(known.count(covariate)) << covariate;
  }
}

TEST_F(Declarations, TitlesNameTheParameters) {
  for (const auto& [id, plugin] : causes) {
    const std::string title = plugin->cause->title;
    for (auto at = title.find('{'); at != std::string::npos; at = title.find('{', at + 1)) {
      const std::string slot = title.substr(at + 1, title.find('}', at) - at - 1),
                        name = slot.substr(0, slot.find('|'));
      EXPECT_TRUE(name == slot || std::count(slot.begin(), slot.end(), '|') == 2) << id << ": {" << slot << '}';
      EXPECT_NE(find(*plugin, name), nullptr) << id << ": {" << slot << '}';
    }
    EXPECT_NE(title.find('{'), std::string::npos) << id;
  }
}

// Requirements of a search: bounds, zero as "no effect", a place as a pair.
TEST_F(Declarations, ParametersCanBeSearched) {
  for (const auto& [id, plugin] : causes) {
    int free = 0, places = 0, each = 0;
    for (uint32_t i = 0; i < plugin->param_count; ++i) {
      const muster_param& p = plugin->params[i];
      SCOPED_TRACE(id + '/' + p.name);
      EXPECT_GT(std::strlen(p.help), 0u);
      each += (p.flags & MUSTER_EACH) != 0;
      if (p.kind != MUSTER_REAL) continue;
      EXPECT_LT(p.min, p.max);
      free += (p.flags & MUSTER_FREE) != 0;
      places += ((p.flags & MUSTER_EAST) != 0) - ((p.flags & MUSTER_NORTH) != 0);
      if (p.flags & MUSTER_LINEAR) {
        EXPECT_TRUE(p.flags & MUSTER_FREE);
        EXPECT_EQ(p.value, 0);
        EXPECT_LE(p.min, 0);
        EXPECT_GT(p.max, 0);
      }
      if (p.flags & MUSTER_LOG) {
        EXPECT_GT(p.min, 0);
      }
      if (p.flags & MUSTER_CYCLIC) {
        EXPECT_NEAR(p.max - p.min, 6.283185307179586, 1e-12);
      }
    }
    EXPECT_EQ(places, 0) << id;
    EXPECT_TRUE(free + each > 0 || *plugin->cause->ranges_over) << id;
  }
}

std::string parameters_text(const muster_plugin& plugin) {
  std::string out;
  for (uint32_t i = 0; i < plugin.param_count; ++i) {
    const muster_param& p = plugin.params[i];
    out += std::string(out.empty() ? "" : ", ") + p.name + (*p.unit ? std::string(" [") + p.unit + ']' : "");
  }
  return out;
}

TEST_F(Declarations, TheReadmeHasThem) {
  std::ifstream in(std::string(MUSTER_SOURCE_DIR) + "/plugins/causes/README.md");
  const std::string readme{std::istreambuf_iterator<char>(in), {}};
  static const char* kinds[] = {"", "term", "stage", "world edit", "law", "instrument"};
  for (const auto& [id, plugin] : causes) {
    std::string imitators;
    for (const auto& word : words(plugin->cause->imitators))
      imitators += (imitators.empty() ? "" : ", ") + word.substr(std::strlen("effect."));
    const std::string needs = plugin->cause->covariates;
    const std::string row = "| `" + id.substr(std::strlen("effect.")) + "` | " + kinds[plugin->cause->kind] + " | " +
                            plugin->summary + " | " + parameters_text(*plugin) + " | " + (needs.empty() ? "-" : needs) +
                            " | " + imitators + " |\n";
    EXPECT_NE(readme.find(row), std::string::npos) << row;
  }
  std::size_t rows = 0;
  for (auto at = readme.find("\n| `"); at != std::string::npos; at = readme.find("\n| `", at + 1)) ++rows;
  EXPECT_EQ(rows, causes.size());
}

}  // namespace
}  // namespace muster
