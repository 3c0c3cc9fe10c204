// Services of a run for its clients, whatever they are reached by.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace muster::live {

struct Service {
  std::string name;               // "/simulation_interfaces/StepSimulation"
  std::string type;               // "simulation_interfaces/srv/StepSimulation"
  std::string request, response;  // definitions in ros2msg
};

struct ServiceAnswer {
  std::string payload;
  std::string fault{};  // why there is no payload
};

class Services {
 public:
  virtual ~Services() = default;
  virtual const std::vector<Service>& services() const = 0;
  // Encodings "json" and "cdr". The answer may come later.
  virtual void call(std::size_t service, const std::string& encoding, std::string_view payload,
                    std::function<void(ServiceAnswer)> answer) = 0;
};

}  // namespace muster::live
