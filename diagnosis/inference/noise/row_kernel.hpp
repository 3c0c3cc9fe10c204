// What the noise model does to every row, several lanes at a time: the part that is built for each instruction set. All
// kernels give the same bits, since every lane is worked out alike.
//
// Only plain data cross this border: a function that both sides compile could be linked in its newest form everywhere.
#pragma once

#include <cstdint>

namespace muster::noise {

constexpr int lanes = 8;         // rows whose neighbourhoods are worked out side by side
constexpr int parameters = 4;    // of the covariance
constexpr int distances = 4096;  // entries of a table of correlations; one more stands for "uncorrelated"
constexpr int alignment = 64;    // bytes, of whatever has a value a lane

// How the distances of both ends compare to those of places, over the rows of a group.
enum class Joint : std::uint8_t { same = 1, uncorrelated, other };

// The covariance of eight rows and their neighbours. Unless said otherwise an array has `lanes` doubles for each slot,
// then for the rows themselves.
struct Neighbourhoods {
  long slots;
  const double *correlation, *by_distance;  // by entry: the correlation, and its derivative by log decorrelation
  double near_variance, joint_variance;     // what they are multiplied by, of places and of both ends
  double share_slope;                       // of the near variance by logit rho; minus that of the joint one
  double field_variance, least_variance, floor_variance;

  const std::uint16_t *near,
      *joint;                      // entries: pair a (a + 1) / 2 + b is slots a and b < a; with b = a, the row itself
  const Joint* kinds;              // of the pairs
  const double *nugget, *present;  // reading variance over count; 1 where a slot has a neighbour

  double* root;                // lower triangle, slots x slots; the diagonal holds its inverse
  double* cross;               // the last row of the factor that has the row itself at the end
  double* combination;         // minus the weights of the best prediction and one, over its standard deviation
  double* turned[parameters];  // last row of L^-1 dC L^-T
  double* slope[parameters];   // of the combination
  double* information;         // Fisher's: one entry for each pair of parameters, row by row
};

// Rows with what is beside them: out_i = own_i x_i + sum over slots of beside_ia x_neighbour.
struct Combinations {
  long rows, slots;
  const long* neighbours;  // -1: none
  const double *own, *beside;
};

// Where rows lie (row_distance.hpp). Arrays have a value a row, filled up to a multiple of `many`.
constexpr int many = 16;
struct Ends {
  const float *middle[3], *stretch[3];  // m, along each axis
};
struct Places {
  Ends place, anchor;
  const float *within_place, *within_both;  // m: half the mean distance of a row's readings; null: rows are points
  float far;                                // m: rows this far apart are so by their middles
  bool anchors_move;                        // or stand where all others of their group do
};

// Rows whose covariances are asked for two by two.
struct Pairs {
  Places at;
  const int* group;          // the anchor's
  const float* correlation;  // by the nearest entry
  float entries_per_metre;
  float everywhere, joint;  // variances: between places, and in addition between both ends of the same anchor
};

struct RowKernel {
  const char* name;
  // Slots without a neighbour hold an independent value of variance one and get weight zero.
  void (*factorise)(const Neighbourhoods&);
  // After factorise().
  void (*differentiate)(const Neighbourhoods&);
  // Of columns that lie row by row.
  void (*combine)(const Combinations&, const double* x, long columns, double* out);
  void (*combine_floats)(const Combinations&, const float* x, long columns, float* out);
  // Of four combinations c, the sum over rows i of (c x)_i . with_i, both row by row and `columns` a multiple of
  // `lanes`.
  void (*contract)(const Combinations* four, const double* x, const double* with, long columns, double* sums);
  // Of a row and those before it; some values beyond are written too, up to a multiple of `many`. Distances, m, are
  // those of places and of both ends.
  void (*apart)(const Places&, long row, float* place, float* both);
  void (*covariances)(const Pairs&, long row, double* out);
  // x less what the orthonormal columns of q explain, both row by row. `scratch`: width x 32 floats.
  void (*take_out)(const float* q, long rows, long width, float* x, long columns, float* scratch);
};

// Those that this machine can run, the fastest one last.
struct RowKernels {
  const RowKernel* all[3];
  int number;

  const RowKernel& best() const { return *all[number - 1]; }
};
const RowKernels& row_kernels();

}  // namespace muster::noise
