// PostGIS has had two methods under the name ST_ConcaveHull; both adapters are made from this one.
#pragma once

#include <memory>

#include "adapters/adapter.hpp"

namespace hullbench {

enum class PostgisMethod {
  kLengthRatio,    ///< PostGIS >= 3.3 on GEOS >= 3.11: GEOS's own concave hull
  kTargetPercent,  ///< before that: the method which the paper describes, written in PL/pgSQL
};

/// Connects to the method's own server: kCurrentServer, or kLegacyServer for kTargetPercent
/// (postgis_session.hpp). Throws NotInstalled when there is no server or when it has the other method.
std::unique_ptr<Adapter> make_postgis_adapter(PostgisMethod method);

}  // namespace hullbench
