// Checks attributes of the world file against the declarations of parameters: kind, bounds, unit, choices.
#pragma once

#include <muster/plugin.h>

#include <functional>
#include <string>
#include <vector>

#include "text/error.hpp"
#include "text/xml.hpp"

namespace muster {

// Finds a row's number by its set and name, or throws with the place.
using FindRow = std::function<double(const std::string& set, const std::string& row, const Place& place)>;

// A warning for the run's events, such as an angle that looks like degrees, a power that looks like milliwatts.
using Warn = std::function<void(const Place& place, const std::string& message)>;

// `count` numbers of one attribute, checked. Texts and files give none.
std::vector<double> attribute_values(const muster_param& declared, int count, const XmlAttribute& given,
                                     const FindRow& find_row, const Warn& warn);

// Refusals of attributes, for any element.
[[noreturn]] void refuse_unknown(const XmlAttribute& given, const std::string& element,
                                 const std::vector<std::string>& valid);
Error lacking(const XmlElement& element, const std::string& attribute, const std::string& expected);
[[noreturn]] void refuse_inside(const XmlElement& element);  // the first element inside one that has attributes only
void expect_attributes(const XmlElement& element, const std::vector<std::string>& valid);  // and none inside it
void check_name(const XmlAttribute& given);

// An attribute that the element must have. Throws Error.
const XmlAttribute& needed(const XmlElement& element, const char* name, const char* expected);
// An integer from 1. Throws Error.
uint64_t positive_integer(const XmlAttribute& given);
// A number of ticks of `dt`, as positive_integer(); of one in seconds the error says how many ticks they are.
uint64_t ticks_in(const XmlAttribute& given, double dt);
// Its number of seconds, at least `least`. Throws Error.
double real_of(const XmlAttribute& given, double least, const char* expected);

// The words of a choice, "a|b|c".
std::vector<std::string> choices(const muster_param& declared);

// "number from 0 to 120 dB", "one of a, b", "name of a robot": what a declaration expects.
std::string expectation(const muster_param& declared, int count = 1);

// Text of a value as the world file writes it.
std::string value_text(const muster_param& declared, double value);

}  // namespace muster
