// SIMD packs spread over as many registers as they need: compilers keep a vector wider than a register in memory.
// Internal to row_kernel.cpp.
#pragma once

#define MUSTER_INLINE [[gnu::always_inline]] inline

namespace muster::noise {
namespace {

#ifdef __AVX512F__
inline constexpr int register_bytes = 64;
#elif defined __AVX__
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

template <class Scalar>
struct Register;
template <>
struct Register<double> {
  using Type = double __attribute__((vector_size(register_bytes), aligned(alignof(double)), may_alias));
};
template <>
struct Register<float> {
  using Type = float __attribute__((vector_size(register_bytes), aligned(alignof(float)), may_alias));
};

template <class Scalar, int number>
struct [[gnu::may_alias]] Pack {
  using Part = typename Register<Scalar>::Type;
  static constexpr int each = register_bytes / sizeof(Scalar), parts = number / each;
  Part part[parts];

  MUSTER_INLINE Scalar operator[](int lane) const { return part[lane / each][lane % each]; }
  MUSTER_INLINE void set(int lane, Scalar value) { part[lane / each][lane % each] = value; }

  // Other is a pack as well, or one number for all lanes.
  MUSTER_INLINE static const Part& of(const Pack& pack, int k) { return pack.part[k]; }
  MUSTER_INLINE static Scalar of(Scalar value, int) { return value; }
  template <class Other>
  MUSTER_INLINE Pack& operator+=(const Other& other) {
    for (int k = 0; k < parts; ++k) part[k] += of(other, k);
    return *this;
  }
  template <class Other>
  MUSTER_INLINE Pack& operator-=(const Other& other) {
    for (int k = 0; k < parts; ++k) part[k] -= of(other, k);
    return *this;
  }
  template <class Other>
  MUSTER_INLINE Pack& operator*=(const Other& other) {
    for (int k = 0; k < parts; ++k) part[k] *= of(other, k);
    return *this;
  }
  template <class Other>
  MUSTER_INLINE friend Pack operator+(Pack a, const Other& b) {
    return a += b;
  }
  template <class Other>
  MUSTER_INLINE friend Pack operator-(Pack a, const Other& b) {
    return a -= b;
  }
  template <class Other>
  MUSTER_INLINE friend Pack operator*(Pack a, const Other& b) {
    return a *= b;
  }
  MUSTER_INLINE friend Pack operator*(Scalar a, Pack b) { return b *= a; }
  MUSTER_INLINE friend Pack operator/(Pack a, Scalar b) {
    for (Part& part : a.part) part /= b;
    return a;
  }
  MUSTER_INLINE Pack operator-() const {
    Pack result;
    for (int k = 0; k < parts; ++k) result.part[k] = -part[k];
    return result;
  }

  // Lanes of which something holds: all bits set, or none.
  struct Within {
    decltype(Part{} <= Part{}) part[parts];

    MUSTER_INLINE Within& operator&=(const Within& other) {
      for (int k = 0; k < parts; ++k) part[k] &= other.part[k];
      return *this;
    }
    MUSTER_INLINE bool all() const {
      bool result = true;
      for (int lane = 0; lane < number; ++lane) result &= part[lane / each][lane % each] != 0;
      return result;
    }
  };
  MUSTER_INLINE static Within everywhere() { return at_most(Pack{}, Pack{}); }
  // None of a lane that is not a number.
  MUSTER_INLINE friend Within at_most(const Pack& a, const Pack& b) {
    Within result;
    for (int k = 0; k < parts; ++k) result.part[k] = a.part[k] <= b.part[k];
    return result;
  }
};

}  // namespace
}  // namespace muster::noise
