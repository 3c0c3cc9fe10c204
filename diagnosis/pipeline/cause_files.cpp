#include "diagnosis/pipeline/cause_files.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "diagnosis/radio/causes/applicability.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

// The columns walls_MATERIAL, in the order of the readings.
std::string counts_of_walls(const Dataset& data) {
  std::vector<const Covariate*> columns;
  std::string text;
  for (const Covariate& c : data.covariates) {
    if (c.name.rfind("walls_", 0) != 0 || c.values.empty()) continue;
    text += (columns.empty() ? "" : ",") + c.name;
    columns.push_back(&c);
  }
  for (std::size_t row = 0; row < data.rows(); ++row) {
    for (const Covariate* c : columns) text += (c == columns[0] ? "\n" : ",") + print_real(c->values[row]);
  }
  return text + '\n';
}

// One column, with what tells whose reading and when.
std::string values_of(const Covariate& column, const Dataset& data) {
  const bool timed = !data.t.empty();
  std::string text = (timed ? "t[s],tx,rx," : "tx,rx,") + column.name + '\n';
  for (std::size_t row = 0; row < data.rows(); ++row)
    text += (timed ? print_real(data.t[row]) + ',' : "") + data.tx.levels[data.tx.level[row]] + ',' +
            data.rx.levels[data.rx.level[row]] + ',' + print_real(column.values[row]) + '\n';
  return text;
}

}  // namespace

void give_files(const CauseShape& shape, const Dataset& data, CauseEstimate& found) {
  const muster_param* file = shape.cause.file();
  if (!file) return;
  const std::string column = own_column(shape.cause);
  const auto values = std::find_if(data.covariates.begin(), data.covariates.end(),
                                   [&](const Covariate& c) { return c.name.substr(0, c.name.find('[')) == column; });
  found.files[file->name] = column == "walls" ? counts_of_walls(data) : values_of(*values, data);
}

}  // namespace muster::diagnosis
