# The methods, in the order of the tables: each once, with what it needs.
find_package(Boost REQUIRED)
find_package(CGAL QUIET)
find_package(GEOS CONFIG QUIET)
pkg_check_modules(SPATIALITE QUIET IMPORTED_TARGET GLOBAL spatialite sqlite3)
pkg_check_modules(LIBPQ QUIET IMPORTED_TARGET GLOBAL libpq)
# By pkg-config and name: PCL's CMake package looks for VTK and all else that PCL can use, which takes seconds.
pkg_check_modules(PCL QUIET pcl_surface)

set(needs_cgal NEEDS CGAL_FOUND MISSING "CGAL" INSTALL "sudo apt-get install libcgal-dev")
set(needs_spatialite NEEDS SPATIALITE_FOUND MISSING "libspatialite"
  INSTALL "sudo apt-get install libspatialite-dev libsqlite3-dev")
set(needs_libpq NEEDS LIBPQ_FOUND MISSING "libpq" INSTALL "sudo apt-get install libpq-dev postgresql-postgis")

add_adapter(NAME polylidar TITLE "Polylidar" LIBRARIES polylidar::core
  DEFINITIONS POLYLIDAR_VERSION="${PROJECT_VERSION}")
add_adapter(NAME polylidar_steps TITLE "Polylidar, step by step" LIBRARIES hullbench_adapter_polylidar polylidar::core)

add_adapter(NAME cgal_alpha_shape TITLE "CGAL alpha shape" ${needs_cgal} LIBRARIES CGAL::CGAL)
add_adapter(NAME cgal_delaunay TITLE "CGAL Delaunay + filter" ${needs_cgal} LIBRARIES CGAL::CGAL)

# Not linked: the adapter loads the library by this name, see there. 1.4.1 is the first with alpha shapes.
find_path(SFCGAL_INCLUDE SFCGAL/capi/sfcgal_c.h)
find_library(SFCGAL_LIBRARY SFCGAL)
mark_as_advanced(SFCGAL_INCLUDE SFCGAL_LIBRARY)
set(sfcgal_alpha_shapes "")
if(SFCGAL_INCLUDE AND SFCGAL_LIBRARY)
  file(STRINGS "${SFCGAL_INCLUDE}/SFCGAL/capi/sfcgal_c.h" sfcgal_alpha_shapes REGEX "sfcgal_geometry_optimal_alpha_shapes")
endif()
string(COMPARE NOTEQUAL "${sfcgal_alpha_shapes}" "" sfcgal_has_alpha_shapes)
set(sfcgal_remedy "sudo apt-get install libsfcgal-dev")
add_adapter(NAME sfcgal_alpha_shape TITLE "SFCGAL alpha shape"
  NEEDS sfcgal_has_alpha_shapes MISSING "SFCGAL 1.4.1 or newer" INSTALL "${sfcgal_remedy}"
  LIBRARIES ${CMAKE_DL_LIBS} INCLUDES "${SFCGAL_INCLUDE}"
  DEFINITIONS SFCGAL_LIBRARY="${SFCGAL_LIBRARY}" SFCGAL_REMEDY="${sfcgal_remedy}")

# Modules, as SpatiaLite's library and PostgreSQL's bring along some forty others (PROJ, curl, LDAP): every other method's
# process would load them too.
add_adapter(NAME spatialite TITLE "SpatiaLite" MODULE ${needs_spatialite} LIBRARIES PkgConfig::SPATIALITE
  SOURCES spatialite.cpp spatialite_database.cpp)
add_adapter(NAME spatialite_steps TITLE "SpatiaLite, step by step" MODULE ${needs_spatialite}
  LIBRARIES hullbench_adapter_spatialite PkgConfig::SPATIALITE)

# Three methods from one client; which of them can run is for the server to say.
add_adapter(NAME postgis TITLE "PostGIS" MODULE ${needs_libpq} LIBRARIES PkgConfig::LIBPQ hullbench::process_identity
  SOURCES postgis.cpp postgis_session.cpp private_postgres.cpp postgres_supervisor.cpp server_folder.cpp)
add_adapter(NAME postgis_legacy TITLE "PostGIS <= 3.2" MODULE ${needs_libpq} LIBRARIES hullbench_adapter_postgis)
add_adapter(NAME postgis_steps TITLE "PostGIS, step by step" MODULE ${needs_libpq}
  LIBRARIES hullbench_adapter_postgis PkgConfig::LIBPQ)

# Before 3.12 GEOS's C API has the hull by ratio only; the C++ headers and library then give the hull by length.
find_path(GEOS_CXX_INCLUDE geos/algorithm/hull/ConcaveHull.h)
mark_as_advanced(GEOS_CXX_INCLUDE)
set(geos_libraries GEOS::geos_c)
set(geos_definitions "")
set(geos_is_enough OFF)
if(GEOS_FOUND AND GEOS_VERSION VERSION_GREATER_EQUAL 3.12)
  set(geos_is_enough ON)
elseif(GEOS_FOUND AND GEOS_VERSION VERSION_GREATER_EQUAL 3.11 AND GEOS_CXX_INCLUDE)
  set(geos_is_enough ON)
  list(APPEND geos_libraries GEOS::geos)
  # By which GEOS lets its C++ headers be used without a warning.
  set(geos_definitions USE_UNSTABLE_GEOS_CPP_API)
endif()
add_adapter(NAME geos_concave_hull TITLE "GEOS concave hull" NEEDS geos_is_enough
  MISSING "GEOS 3.11 with its C++ headers, or a newer GEOS," INSTALL "sudo apt-get install libgeos-dev libgeos++-dev"
  SOURCES geos_concave_hull.cpp geos_hull_by_length.cpp LIBRARIES ${geos_libraries} DEFINITIONS ${geos_definitions})

# This project's own implementations: their version is the project's. Boost 1.74's Geometry includes headers of its own that
# announce themselves as deprecated in every compilation.
add_adapter(NAME chi_shape TITLE "Chi shape" LIBRARIES polylidar::core
  DEFINITIONS HULLBENCH_VERSION="${PROJECT_VERSION}")
add_adapter(NAME knn_hull TITLE "k-nearest-neighbours hull" LIBRARIES polylidar::core Boost::headers
  DEFINITIONS HULLBENCH_VERSION="${PROJECT_VERSION}" BOOST_ALLOW_DEPRECATED_HEADERS)

# A module, as PCL's library brings VTK, TBB and OpenMP into the process. PCL is compiled for generic x86-64; with
# -march=native Eigen would align and free memory in another way.
add_adapter(NAME pcl_concave_hull TITLE "PCL concave hull" MODULE
  NEEDS PCL_FOUND MISSING "PCL" INSTALL "make deps-extra && make build"
  SOURCES pcl_concave_hull.cpp ring_nesting.cpp INCLUDES "${PCL_INCLUDE_DIRS}"
  LIBRARIES polylidar::core pcl_surface pcl_search pcl_kdtree pcl_common
  DEFINITIONS EIGEN_MAX_ALIGN_BYTES=16)

add_adapter(NAME convex_hull TITLE "Convex hull" LIBRARIES polylidar::core Boost::headers
  DEFINITIONS BOOST_ALLOW_DEPRECATED_HEADERS)
