#include "benchmarks/record/protocols.hpp"

#include "benchmarks/base/names.hpp"
#include "benchmarks/record/embedded.hpp"

namespace hullbench::record {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Protocol, name, chosen, title)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ProtocolGroup, name, methods, protocols)

const std::vector<Protocol>& protocols() {
  static const auto all = json::parse(kProtocolsJson).at("protocols").get<std::vector<Protocol>>();
  return all;
}

const std::vector<ProtocolGroup>& protocol_groups() {
  static const auto all = json::parse(kProtocolsJson).at("groups").get<std::vector<ProtocolGroup>>();
  return all;
}

std::vector<std::string> protocols_by_group() {
  std::vector<std::string> names;
  for (const ProtocolGroup& group : protocol_groups())
    names.insert(names.end(), group.protocols.begin(), group.protocols.end());
  return names;
}

}  // namespace hullbench::record
