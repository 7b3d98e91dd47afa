// What a user can mend.
#pragma once

#include <stdexcept>

namespace polylidar::tool {

/// Something the user asked for that cannot be done as it stands; one sentence with the way out. Exit code 2.
class ConfigurationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace polylidar::tool
