// Who chose the parameters: the protocols, from protocols.json, which the programs in plots/ read too.
#pragma once

#include <string>
#include <vector>

namespace hullbench::record {

struct Protocol {
  std::string name;    ///< "paper"
  std::string chosen;  ///< who chose: "by the paper's rules"
  std::string title;   ///< what is chosen, as a heading of the league
};

/// In the order in which a method's lines stand in a table.
const std::vector<Protocol>& protocols();

/// Protocols that know as much, which the league compares with each other.
struct ProtocolGroup {
  std::string name;     ///< "blind"
  std::string methods;  ///< behind "methods": "that see the points only"
  std::vector<std::string> protocols;
};

/// In the order of the league.
const std::vector<ProtocolGroup>& protocol_groups();

/// The names of the protocols, group by group.
std::vector<std::string> protocols_by_group();

}  // namespace hullbench::record
