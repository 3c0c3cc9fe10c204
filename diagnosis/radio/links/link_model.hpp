// Predicts measured readings from a world: evaluates its channel at their places and times by the simulator's own code.
#pragma once

#include <array>
#include <optional>
#include <set>

#include "diagnosis/prediction/measured_world.hpp"

namespace muster::diagnosis {

// One end of a reading, as passed to the channel; m, rad.
struct End {
  double x, y, z, yaw;
  int radio;  // row of the set `radio`
};

// The instance that replaces a world's links: data.links with the readings of `file`.
InstanceDeclaration measured_links(const std::filesystem::path& file, const Place& place);

class LinkModel : public MeasuredWorld {
 public:
  // The world with the readings of `data` as its links. `tables`: files already read. Throws Error.
  LinkModel(const std::filesystem::path& world, const std::filesystem::path& data, const Library::SearchPath& plugins,
            const std::shared_ptr<TableCache>& tables = std::make_shared<TableCache>(),
            std::optional<uint64_t> seed = {},                             // of its draws, instead of the world's
            const std::vector<std::shared_ptr<Library>>& libraries = {});  // loaded already, as of another such model

  // Both ends of each row, tx first.
  const std::vector<std::array<End, 2>>& ends() const { return ends_; }
  // The same with instances inserted since, as of the last evaluation.
  std::vector<std::array<End, 2>> ends_now() const;
  const std::vector<std::string>& radio_names() const;  // by row of the set `radio`
  std::string radio_name(int radio) const;
  // Radios of the readings that the world lacks and that were added to it; no cause concerns them.
  std::vector<std::string> added_radios() const;
  // Carrier of the channel: what a term of the world writes, or else the default of one, which says nothing of the
  // data.
  struct Carrier {
    double frequency = 0;  // Hz
    bool is_written = false;
  };
  std::optional<Carrier> carrier() const;
  // The first end of a radio in the data; nothing for a radio without a reading.
  std::optional<End> first_end(const std::string& radio) const;
  std::set<std::string> link_of(int one, int other) const;  // names of both, in either direction

  // Largest change of each expected level, dB, if links are moved by this distance, to either side or along their way.
  // It bounds the effect of inaccurate walls and radio places. Lengths and bearings are unchanged.
  Eigen::VectorXd changes_nearby(double metres);

 private:
  LinkModel(const World& declared, const std::filesystem::path& data, const Library::SearchPath& plugins,
            const std::shared_ptr<TableCache>& tables, const std::vector<std::shared_ptr<Library>>& libraries);
  std::vector<std::array<End, 2>> ends_;
};

}  // namespace muster::diagnosis
