#include "adapters/postgis.hpp"

namespace hullbench {

std::unique_ptr<Adapter> make_postgis_legacy() {
  return make_postgis_adapter(PostgisMethod::kTargetPercent);
}

}  // namespace hullbench
