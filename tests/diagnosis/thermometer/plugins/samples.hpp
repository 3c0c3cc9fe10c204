// Rows of the thermometer domain's tables.
#pragma once

#include <muster/plugin.hpp>

struct Sample {
  static constexpr const char* columns = "t[s] thermometer:thermometer";
  double t, thermometer;
};
struct Temperature {
  static constexpr const char* columns = "temperature[K]";
  double temperature;
};

// Adds a term of (time [s], thermometer) to every sample.
struct SampleTerm {
  explicit SampleTerm(muster::Setup& s)
      : samples(s.read<Sample>("sample/*/at")), temperature(s.add<Temperature>("sample/*/temperature")) {}
  template <class Term>
  void add(const muster::Step& k, const Term& term) const {
    for (std::size_t i = 0; i < k[samples].size(); ++i)
      k[temperature][i].temperature = term(k[samples][i].t, k[samples][i].thermometer);
  }
  muster::In<Sample> samples;
  muster::Out<Temperature> temperature;
};
