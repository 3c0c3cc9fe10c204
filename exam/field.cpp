#include "exam/field.hpp"

#include <algorithm>
#include <numbers>

namespace muster::exam {
namespace {

constexpr double pitch = 0.08;  // m

// Complex numbers as two arrays, for vectorised sums of products.
struct Spectrum {
  std::size_t columns, rows;  // powers of two
  std::vector<double> re, im;

  Spectrum(std::size_t c, std::size_t r) : columns(c), rows(r), re(c * r), im(c * r) {}
};

// Fast Fourier transform (Cooley and Tukey 1965) in place and in natural order, elements `stride` apart. Other lines
// of the array are transformed alongside.
class Transform {
 public:
  explicit Transform(std::size_t size) : size_(size), cosine_(size / 2), sine_(size / 2), order_(size) {
    for (std::size_t i = 0; i < size / 2; ++i) {
      cosine_[i] = std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size));
      sine_[i] = -std::sin(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size));
    }
    for (std::size_t i = 1; i < size; ++i) order_[i] = (order_[i / 2] | (i & 1 ? size : 0)) / 2;
  }

  // Transforms `width` adjacent lines: element i of line k is at data[i * stride + k].
  void operator()(double* re, double* im, std::size_t stride, std::size_t width) const {
    for (std::size_t i = 0; i < size_; ++i) {
      if (order_[i] <= i) continue;
      std::swap_ranges(re + i * stride, re + i * stride + width, re + order_[i] * stride);
      std::swap_ranges(im + i * stride, im + i * stride + width, im + order_[i] * stride);
    }
    for (std::size_t half = 1; half < size_; half *= 2)
      for (std::size_t block = 0; block < size_; block += 2 * half)
        for (std::size_t k = 0; k < half; ++k)
          butterfly(re, im, (block + k) * stride, (block + k + half) * stride, width, k * (size_ / 2 / half));
  }

 private:
  void butterfly(double* re, double* im, std::size_t a, std::size_t b, std::size_t width, std::size_t turn) const {
    const double c = cosine_[turn], s = sine_[turn];
    for (std::size_t k = 0; k < width; ++k) {
      const double x = re[b + k] * c - im[b + k] * s, y = re[b + k] * s + im[b + k] * c;
      re[b + k] = re[a + k] - x;
      im[b + k] = im[a + k] - y;
      re[a + k] += x;
      im[a + k] += y;
    }
  }

  std::size_t size_;
  std::vector<double> cosine_, sine_;
  std::vector<std::size_t> order_;
};

void transform(Spectrum& s) {
  const Transform along(s.columns), across(s.rows);
  for (std::size_t r = 0; r < s.rows; ++r) along(s.re.data() + r * s.columns, s.im.data() + r * s.columns, 1, 1);
  constexpr std::size_t strip = 32;  // columns at a time, for the cache
  for (std::size_t c = 0; c < s.columns; c += strip) across(s.re.data() + c, s.im.data() + c, s.columns, strip);
}

std::size_t power_of_two_over(double n) {
  std::size_t result = 64;
  while (static_cast<double>(result) < n) result *= 2;
  return result;
}

// Roots of the eigenvalues of the periodic covariance. A torus that is too small gives a few negative ones; these are
// cut and the variance is restored.
std::vector<double> amplitudes(const FieldLaw& law, std::size_t columns, std::size_t rows) {
  Spectrum s(columns, rows);
  for (std::size_t y = 0; y < rows; ++y)
    for (std::size_t x = 0; x < columns; ++x)
      s.re[y * columns + x] = correlation(law, pitch * std::hypot(static_cast<double>(std::min(x, columns - x)),
                                                                  static_cast<double>(std::min(y, rows - y))));
  transform(s);
  double sum = 0;
  for (const double v : s.re) sum += std::max(v, 0.0);
  std::vector<double> result(s.re.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = std::sqrt(std::max(s.re[i], 0.0) / sum);
  return result;
}

}  // namespace

double correlation(const FieldLaw& law, double distance) {
  const double u = distance / law.decorrelation;
  switch (law.family) {
    case Family::exponential:
      return std::exp(-u);
    case Family::gaussian:
      return std::exp(-u * u);
    case Family::two_scale:
      return 0.6 * std::exp(-2 * u) + 0.4 * std::exp(-u / 3);
  }
  return 0;
}

CorrelationTable::CorrelationTable(const FieldLaw& law) {
  for (int i = 0; i < 60 * per_metre; ++i) values_.push_back(correlation(law, i / per_metre));
}

Field::Field(const GroundTruth& site, std::uint64_t seed) : plan_(site.plan), law_(site.noise.field) {
  columns_ = static_cast<std::size_t>(plan_.whole.high.x / pitch) + 2;
  rows_ = static_cast<std::size_t>(plan_.whole.high.y / pitch) + 2;
  const double tail = 4 * law_.decorrelation / pitch;
  Spectrum s(power_of_two_over(static_cast<double>(columns_) + tail),
             power_of_two_over(static_cast<double>(rows_) + tail));
  const std::vector<double> amplitude = amplitudes(law_, s.columns, s.rows);
  Random random(seed, "shadowing");
  while (values_.size() < plan_.stations.size() + 1) {  // real and imaginary part are independent fields
    for (std::size_t i = 0; i < amplitude.size(); ++i) {
      s.re[i] = amplitude[i] * random.normal();
      s.im[i] = amplitude[i] * random.normal();
    }
    transform(s);
    for (const auto* part : {&s.re, &s.im}) {
      std::vector<float>& field = values_.emplace_back();
      for (std::size_t y = 0; y < rows_; ++y)
        for (std::size_t x = 0; x < columns_; ++x) field.push_back(static_cast<float>((*part)[y * s.columns + x]));
    }
  }
}

double Field::operator()(int station, Vec2 world) const {
  const Vec2 own = plan_.to_own(world);
  const auto node = [](double v, std::size_t count) {
    return std::min(static_cast<std::size_t>(std::max(0.0, v / pitch + 0.5)), count - 1);
  };
  const std::size_t at = node(own.y, rows_) * columns_ + node(own.x, columns_);
  const double own_part = values_[static_cast<std::size_t>(station)][at], common = values_[plan_.stations.size()][at];
  return law_.sigma * (std::sqrt(1 - law_.shared) * own_part + std::sqrt(law_.shared) * common);
}

}  // namespace muster::exam
