#include "diagnosis/inference/noise/row_kernel.hpp"

namespace muster::noise {

#ifdef __x86_64__

extern const RowKernel x86_64_v2, x86_64_v3, x86_64_v4;

const RowKernels& row_kernels() {
  static const RowKernels kernels = [] {
    RowKernels found{{&x86_64_v2}, 1};
    if (__builtin_cpu_supports("x86-64-v3")) found.all[found.number++] = &x86_64_v3;
    if (__builtin_cpu_supports("x86-64-v4")) found.all[found.number++] = &x86_64_v4;
    return found;
  }();
  return kernels;
}

#else

extern const RowKernel native;

const RowKernels& row_kernels() {
  static const RowKernels kernels{{&native}, 1};
  return kernels;
}

#endif

}  // namespace muster::noise
