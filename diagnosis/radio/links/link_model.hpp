// A world asked what it expects to be measured: its channel, evaluated at the places and times of the readings by the
// code that a simulation runs.
#pragma once

#include <array>
#include <set>

#include "diagnosis/prediction/measured_world.hpp"

namespace muster::diagnosis {

// One end of a reading, as the channel saw it.
struct End {
  double x, y, z, yaw;
  int radio;  // row of the set `radio`
};

// The instance that stands in for a world's links: data.links with the readings of `file`.
InstanceDeclaration measured_links(const std::filesystem::path& file, const Place& place);

class LinkModel : public MeasuredWorld {
 public:
  // The world with the readings of `data` in the place of its links. Throws Error.
  // `tables`: files that were read already.
  LinkModel(const std::filesystem::path& world, const std::filesystem::path& data, const Library::SearchPath& plugins,
            const std::shared_ptr<TableCache>& tables = std::make_shared<TableCache>());

  // Row i's two ends, tx first.
  const std::vector<std::array<End, 2>>& ends() const { return ends_; }
  const std::vector<std::string>& radio_names() const;  // by row of the set `radio`
  std::string radio_name(int radio) const;
  // Radios of the readings that the world does not have, and that were added to it; no cause is about them.
  std::vector<std::string> added_radios() const;
  std::set<std::string> link_of(int one, int other) const;  // names of both, whichever sends

  // By how much it changes, dB, if every link is moved so far to either side: what hangs on how exactly the ends of
  // walls and the places of radios are known. Lengths and bearings stay.
  Eigen::VectorXd changes_aside(double metres);

 private:
  LinkModel(World declared, const std::filesystem::path& data, const Library::SearchPath& plugins,
            const std::shared_ptr<TableCache>& tables);
  void read_ends();

  std::vector<std::array<End, 2>> ends_;
};

}  // namespace muster::diagnosis
