// The table of storeys, lowest first. Each row: a room, and the rooms below it that its files may include.
#include "storeys.hpp"

namespace muster::test {

const Storeys& storeys() {
  static const Storeys table{
      {"plugin_api", {}},
      {"text", {}},
      {"loader", {"plugin_api", "text"}},
      {"world_file", {"plugin_api", "text"}},
      {"kernel", {"plugin_api", "text", "loader", "world_file"}},

      {"scene", {}},
      {"description", {"plugin_api"}},
      {"medium", {"plugin_api"}},
      {"ports", {"plugin_api"}},
      {"plotting", {"text"}},

      // A plugin includes its own folder and the headers beside all folders of plugins; never kernel/ or loader/.
      {"plugins", {"plugin_api", "scene", "description"}},
      // Ways through the free space of a plan.
      {"roadmap", {"plugin_api", "scene", "plugins"}},
      {"plugins/*", {"plugin_api", "scene", "roadmap", "description", "medium", "plugins"}},
      {"plugins/causes", {"plugin_api", "scene", "plugins", "plugins/radio_fading"}},
      // Programs outside, and logs.
      {"plugins/bridge_socket", {"plugin_api", "ports"}},

      // Domain-free: columns, sites, groups and blocks.
      {"diagnosis/inference/thresholds", {}},
      {"diagnosis/inference/noise", {"plugin_api", "text", "diagnosis/inference/thresholds"}},
      {"diagnosis/inference/state",
       {"plugin_api", "text", "diagnosis/inference/thresholds", "diagnosis/inference/noise"}},
      {"diagnosis/inference/score",
       {"plugin_api", "text", "diagnosis/inference/thresholds", "diagnosis/inference/noise",
        "diagnosis/inference/state"}},
      {"diagnosis/inference/select",
       {"plugin_api", "text", "diagnosis/inference/thresholds", "diagnosis/inference/noise",
        "diagnosis/inference/state", "diagnosis/inference/score"}},
      {"diagnosis/inference/assess",
       {"plugin_api", "text", "diagnosis/inference/thresholds", "diagnosis/inference/noise",
        "diagnosis/inference/state", "diagnosis/inference/score", "diagnosis/inference/select"}},

      {"diagnosis/data", {"plugin_api", "text"}},
      // The world with measured rows in it, and plugins as candidates: no kind of measurement is named there.
      {"diagnosis/prediction", {"plugin_api", "text", "kernel", "world_file"}},
      {"diagnosis/causes",
       {"plugin_api", "text", "kernel", "diagnosis/inference/*", "diagnosis/data", "diagnosis/prediction"}},

      // Radio links: the first kind of measurement.
      {"diagnosis/radio/thresholds", {}},
      {"diagnosis/radio/links",
       {"plugin_api", "text", "kernel", "scene", "plotting", "plugins", "diagnosis/inference/*", "diagnosis/data",
        "diagnosis/prediction", "diagnosis/radio/thresholds"}},
      {"diagnosis/calibration",
       {"plugin_api", "text", "plotting", "diagnosis/inference/noise", "diagnosis/data", "diagnosis/prediction",
        "diagnosis/radio/thresholds", "diagnosis/radio/links"}},
      // Runs of a world against recorded tables.
      {"diagnosis/replicates",
       {"plugin_api", "text", "kernel", "world_file", "diagnosis/prediction", "diagnosis/calibration"}},
      {"diagnosis/result", {"text", "diagnosis/inference/*", "diagnosis/radio/links"}},
      {"diagnosis/radio/causes",
       {"plugin_api", "text", "kernel", "diagnosis/inference/*", "diagnosis/data", "diagnosis/prediction",
        "diagnosis/causes", "diagnosis/radio/thresholds", "diagnosis/radio/links", "diagnosis/calibration"}},
      {"diagnosis/radio/laws",
       {"plugin_api", "text", "diagnosis/result", "diagnosis/inference/*", "diagnosis/data", "diagnosis/prediction",
        "diagnosis/causes", "diagnosis/radio/thresholds", "diagnosis/radio/links", "diagnosis/calibration"}},
      {"diagnosis/planning",
       {"plugin_api", "text", "diagnosis/result", "diagnosis/inference/*", "diagnosis/data", "diagnosis/prediction",
        "diagnosis/causes", "diagnosis/radio/*", "diagnosis/calibration"}},
      {"diagnosis/pipeline",
       {"plugin_api", "text", "kernel", "diagnosis/result", "diagnosis/inference/*", "diagnosis/data",
        "diagnosis/prediction", "diagnosis/causes", "diagnosis/radio/*", "diagnosis/calibration",
        "diagnosis/planning"}},
      {"diagnosis/report",
       {"plugin_api", "text", "kernel", "plotting", "diagnosis/result", "diagnosis/inference/*", "diagnosis/data",
        "diagnosis/prediction", "diagnosis/radio/*", "diagnosis/calibration", "diagnosis/replicates",
        "diagnosis/pipeline"}},

      // A run as one page.
      {"viewer", {"plugin_api", "text", "kernel", "description"}},

      // The container of logs, and a run in it.
      {"mcap", {"text"}},
      {"run_log/tables", {"text", "mcap"}},
      {"run_log", {"plugin_api", "text", "kernel", "world_file", "mcap", "run_log/tables"}},
      // Missions and orders are XML files.
      {"plugins/controllers", {"plugin_api", "text", "roadmap", "description", "plugins"}},
      // In the place of a robot's hardware.
      {"plugins/devices", {"plugin_api", "text", "ports", "mcap", "run_log/tables"}},
      // A run for those who watch and drive it as it goes.
      {"live", {"plugin_api", "text", "kernel", "world_file", "mcap", "run_log", "run_log/tables"}},

      // Plans of many runs, and the table of them.
      {"sweep", {"text", "plotting"}},

      // A run in one file.
      {"bundle", {"text"}},

      // Shares no code with what it grades.
      {"exam", {}},
      // Clients of the bridge, one file each, for programs outside.
      {"bridge", {}},
      {"cli",
       {"plugin_api", "text", "loader", "world_file", "kernel", "roadmap", "plotting", "diagnosis/*", "viewer", "mcap",
        "run_log", "live", "sweep", "bundle"}},
      {"python", {"plugin_api", "text", "loader", "world_file", "kernel", "plotting", "diagnosis/*"}},
  };
  return table;
}

}  // namespace muster::test
