// Selects the kernels that the machine can run.
#include "block_kernel.hpp"

namespace muster::simbody {

#ifdef __x86_64__
extern const BlockKernel x86_64_v2, x86_64_v3, x86_64_v4;

BlockKernels block_kernels() {
  BlockKernels found{1, {&x86_64_v2}};
  if (__builtin_cpu_supports("x86-64-v3")) found.all[found.number++] = &x86_64_v3;
  if (__builtin_cpu_supports("x86-64-v4")) found.all[found.number++] = &x86_64_v4;
  return found;
}
#else
extern const BlockKernel native;

BlockKernels block_kernels() { return {1, {&native}}; }
#endif

namespace {

const BlockKernel& best() {
  static const BlockKernel& kernel = [&]() -> const BlockKernel& {
    const BlockKernels kernels = block_kernels();
    return *kernels.all[kernels.number - 1];
  }();
  return kernel;
}

}  // namespace

template <>
const BlockArithmetic<6>& block_arithmetic() {
  return best().six;
}
template <>
const BlockArithmetic<8>& block_arithmetic() {
  return best().eight;
}
template <>
const BlockArithmetic<12>& block_arithmetic() {
  return best().twelve;
}
const LaneArithmetic& lane_arithmetic() { return best().lanes; }

}  // namespace muster::simbody
