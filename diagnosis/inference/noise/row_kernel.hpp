// Per-row arithmetic of the noise model, several lanes at a time, built once for each instruction set. All kernels
// give the same bits, since every lane is computed alike.
//
// Only plain data cross this border: a function compiled on both sides could be linked in its newest form everywhere.
#pragma once

#include <cstdint>

namespace muster::noise {

constexpr int lanes = 8;         // rows whose neighbourhoods are computed side by side
constexpr int parameters = 4;    // of the covariance
constexpr int distances = 4096;  // entries of a table of correlations; one more means "uncorrelated"
// Added to an entry of two rows of one site, and twice for one stream there: the table goes on with correlations
// within.
constexpr int same_site = distances + 1;
constexpr int alignment = 64;  // bytes, of arrays with a value a lane

// Relation of joint distances (place and anchor) to distances of places, over the rows of a group.
enum class Joint : std::uint8_t { same = 1, uncorrelated, other };

// Covariance of eight rows and their neighbours. Unless noted otherwise an array has `lanes` doubles for each slot,
// then for the rows themselves.
struct Neighbourhoods {
  long slots;
  const double *correlation, *by_distance;  // by entry: the correlation, and its derivative by log decorrelation
  double near_variance, joint_variance;     // factors of the correlations by place, and by place and anchor
  double near_slope, joint_slope;           // the same of the derivatives
  double share_slope;                       // of the near variance by logit rho; minus that of the joint one
  double floor_variance;                    // of every row, beside its nugget

  const std::uint16_t *near,
      *joint;                      // entries: pair a (a + 1) / 2 + b is slots a and b < a; with b = a, the row itself
  const Joint* kinds;              // of the pairs
  const double *nugget, *present;  // reading variance over count; 1 where a slot has a neighbour
  const double *field, *field_slope;  // variance of the field; its derivative by log decorrelation

  double* root;                // lower triangle, slots x slots; the diagonal holds its inverse
  double* cross;               // the last row of the factor that has the row itself at the end
  double* combination;         // (-kriging weights, 1), over the standard deviation of the prediction
  double* turned[parameters];  // last row of L^-1 dC L^-T
  double* slope[parameters];   // of the combination
  double* information;         // Fisher information: one entry for each pair of parameters, row by row
};

// Linear combinations of rows with their neighbours: out_i = own_i x_i + sum over slots of beside_ia x_neighbour.
struct Combinations {
  long rows, slots;
  const long* neighbours;  // -1: none
  const double *own, *beside;
};

// Positions of rows (row_distance.hpp). Arrays have a value a row, padded to a multiple of `many`.
constexpr int many = 16;
struct Ends {
  const float *middle[3], *stretch[3];  // m, along each axis
};
struct Places {
  Ends place, anchor;
  const float *within_place, *within_both;  // m: half the mean distance of a row's readings; null: rows are points
  float far;                                // m: beyond this the distance of rows is that of their middles
  bool anchors_move;                        // or differ from others of their group
};

// Rows whose covariances are needed pair by pair.
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
  // Applies the combinations to columns stored row by row.
  void (*combine)(const Combinations&, const double* x, long columns, double* out);
  void (*combine_floats)(const Combinations&, const float* x, long columns, float* out);
  // For four combinations c, the sum over rows i of (c x)_i . with_i; both are stored row by row, and `columns` is a
  // multiple of `lanes`.
  void (*contract)(const Combinations* four, const double* x, const double* with, long columns, double* sums);
  // Distances, m, of a row from those before it: by place, and by place and anchor jointly. Writes some values
  // beyond, up to a multiple of `many`.
  void (*apart)(const Places&, long row, float* place, float* both);
  void (*covariances)(const Pairs&, long row, double* out);
  // x less its projection on the orthonormal columns of q, both row by row. `scratch`: width x 32 floats.
  void (*take_out)(const float* q, long rows, long width, float* x, long columns, float* scratch);
};

// The kernels that this machine can run, the fastest one last.
struct RowKernels {
  const RowKernel* all[3];
  int number;

  const RowKernel& best() const { return *all[number - 1]; }
};
const RowKernels& row_kernels();

}  // namespace muster::noise
