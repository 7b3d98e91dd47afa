# The methods, in the order of the tables: one line each.

add_adapter(NAME polylidar TITLE "Polylidar" LIBRARIES polylidar::core)
set_source_files_properties(polylidar.cpp PROPERTIES COMPILE_DEFINITIONS "POLYLIDAR_VERSION=\"${PROJECT_VERSION}\"")

find_package(CGAL QUIET)
if(CGAL_FOUND)
  add_adapter(NAME cgal_alpha_shape TITLE "CGAL alpha shape" LIBRARIES CGAL::CGAL)
  add_adapter(NAME cgal_delaunay TITLE "CGAL Delaunay + filter" LIBRARIES CGAL::CGAL)
else()
  add_adapter(NAME cgal_alpha_shape TITLE "CGAL alpha shape"
    MISSING "CGAL" INSTALL "sudo apt-get install libcgal-dev")
  add_adapter(NAME cgal_delaunay TITLE "CGAL Delaunay + filter"
    MISSING "CGAL" INSTALL "sudo apt-get install libcgal-dev")
endif()

# Not linked: the adapter loads the library by this name, see there. 1.4.1 is the first with alpha shapes.
find_path(SFCGAL_INCLUDE SFCGAL/capi/sfcgal_c.h)
find_library(SFCGAL_LIBRARY SFCGAL)
mark_as_advanced(SFCGAL_INCLUDE SFCGAL_LIBRARY)
set(sfcgal_has_alpha_shapes "")
if(SFCGAL_INCLUDE AND SFCGAL_LIBRARY)
  file(STRINGS "${SFCGAL_INCLUDE}/SFCGAL/capi/sfcgal_c.h" sfcgal_has_alpha_shapes
    REGEX "sfcgal_geometry_optimal_alpha_shapes")
endif()
set(sfcgal_remedy "sudo apt-get install libsfcgal-dev")
if(sfcgal_has_alpha_shapes)
  add_adapter(NAME sfcgal_alpha_shape TITLE "SFCGAL alpha shape" LIBRARIES ${CMAKE_DL_LIBS})
  target_include_directories(hullbench_adapter_sfcgal_alpha_shape SYSTEM PRIVATE "${SFCGAL_INCLUDE}")
  set_source_files_properties(sfcgal_alpha_shape.cpp PROPERTIES
    COMPILE_DEFINITIONS "SFCGAL_LIBRARY=\"${SFCGAL_LIBRARY}\";SFCGAL_REMEDY=\"${sfcgal_remedy}\"")
else()
  add_adapter(NAME sfcgal_alpha_shape TITLE "SFCGAL alpha shape"
    MISSING "SFCGAL 1.4.1 or newer" INSTALL "${sfcgal_remedy}")
endif()

pkg_check_modules(SPATIALITE QUIET IMPORTED_TARGET GLOBAL spatialite sqlite3)
if(SPATIALITE_FOUND)
  add_adapter(NAME spatialite TITLE "SpatiaLite" LIBRARIES PkgConfig::SPATIALITE
    SOURCES spatialite.cpp spatialite_database.cpp)
  add_adapter(NAME spatialite_steps TITLE "SpatiaLite, step by step"
    LIBRARIES hullbench_adapter_spatialite PkgConfig::SPATIALITE)
else()
  add_adapter(NAME spatialite TITLE "SpatiaLite"
    MISSING "libspatialite" INSTALL "sudo apt-get install libspatialite-dev libsqlite3-dev")
  add_adapter(NAME spatialite_steps TITLE "SpatiaLite, step by step"
    MISSING "libspatialite" INSTALL "sudo apt-get install libspatialite-dev libsqlite3-dev")
endif()

# Three methods from one client; which of them can run is for the server to say.
pkg_check_modules(LIBPQ QUIET IMPORTED_TARGET GLOBAL libpq)
if(LIBPQ_FOUND)
  add_adapter(NAME postgis TITLE "PostGIS" LIBRARIES PkgConfig::LIBPQ hullbench::process_identity
    SOURCES postgis.cpp postgis_session.cpp private_postgres.cpp postgres_supervisor.cpp server_folder.cpp)
  add_adapter(NAME postgis_legacy TITLE "PostGIS <= 3.2" LIBRARIES hullbench_adapter_postgis)
  add_adapter(NAME postgis_steps TITLE "PostGIS, step by step"
    LIBRARIES hullbench_adapter_postgis PkgConfig::LIBPQ)
else()
  add_adapter(NAME postgis TITLE "PostGIS"
    MISSING "libpq" INSTALL "sudo apt-get install libpq-dev postgresql-postgis")
  add_adapter(NAME postgis_legacy TITLE "PostGIS <= 3.2"
    MISSING "libpq" INSTALL "sudo apt-get install libpq-dev postgresql-postgis")
  add_adapter(NAME postgis_steps TITLE "PostGIS, step by step"
    MISSING "libpq" INSTALL "sudo apt-get install libpq-dev postgresql-postgis")
endif()

# Before 3.12 GEOS's C API has the hull by ratio only; the C++ headers and library then give the hull by length.
find_package(GEOS CONFIG QUIET)
find_path(GEOS_CXX_INCLUDE geos/algorithm/hull/ConcaveHull.h)
mark_as_advanced(GEOS_CXX_INCLUDE)
set(geos_sources geos_concave_hull.cpp geos_hull_by_length.cpp)
if(GEOS_FOUND AND GEOS_VERSION VERSION_GREATER_EQUAL 3.12)
  add_adapter(NAME geos_concave_hull TITLE "GEOS concave hull" LIBRARIES GEOS::geos_c SOURCES ${geos_sources})
elseif(GEOS_FOUND AND GEOS_VERSION VERSION_GREATER_EQUAL 3.11 AND GEOS_CXX_INCLUDE)
  add_adapter(NAME geos_concave_hull TITLE "GEOS concave hull" LIBRARIES GEOS::geos_c GEOS::geos
    SOURCES ${geos_sources})
  # By which GEOS lets its C++ headers be used without a warning.
  set_source_files_properties(geos_hull_by_length.cpp PROPERTIES COMPILE_DEFINITIONS USE_UNSTABLE_GEOS_CPP_API)
else()
  add_adapter(NAME geos_concave_hull TITLE "GEOS concave hull"
    MISSING "GEOS 3.11 with its C++ headers, or a newer GEOS," INSTALL "sudo apt-get install libgeos-dev libgeos++-dev")
endif()

# This project's own implementations: their version is the project's.
find_package(Boost REQUIRED)
add_adapter(NAME chi_shape TITLE "Chi shape" LIBRARIES polylidar::core)
add_adapter(NAME knn_hull TITLE "k-nearest-neighbours hull" LIBRARIES polylidar::core Boost::headers)

# By pkg-config and name: PCL's CMake package looks for VTK and all else that PCL can use, which takes seconds.
pkg_check_modules(PCL QUIET pcl_surface)
if(PCL_FOUND)
  # A module, as PCL's library brings VTK, TBB and OpenMP into the process.
  add_adapter(NAME pcl_concave_hull TITLE "PCL concave hull" MODULE
    LIBRARIES polylidar::core pcl_surface pcl_search pcl_kdtree pcl_common
    SOURCES pcl_concave_hull.cpp ring_nesting.cpp)
  target_include_directories(hullbench_adapter_pcl_concave_hull SYSTEM PRIVATE "${PCL_INCLUDE_DIRS}")
  # PCL is compiled for generic x86-64; with -march=native Eigen would align and free memory in another way.
  set_source_files_properties(pcl_concave_hull.cpp PROPERTIES COMPILE_DEFINITIONS EIGEN_MAX_ALIGN_BYTES=16)
else()
  add_adapter(NAME pcl_concave_hull TITLE "PCL concave hull" MISSING "PCL" INSTALL "make deps-extra && make build")
endif()

add_adapter(NAME convex_hull TITLE "Convex hull" LIBRARIES polylidar::core Boost::headers)
set_source_files_properties(chi_shape.cpp PROPERTIES COMPILE_DEFINITIONS "HULLBENCH_VERSION=\"${PROJECT_VERSION}\"")
# Boost 1.74's Geometry includes headers of its own that announce themselves as deprecated in every compilation.
set_source_files_properties(knn_hull.cpp PROPERTIES
  COMPILE_DEFINITIONS "HULLBENCH_VERSION=\"${PROJECT_VERSION}\";BOOST_ALLOW_DEPRECATED_HEADERS")
set_source_files_properties(convex_hull.cpp PROPERTIES COMPILE_DEFINITIONS BOOST_ALLOW_DEPRECATED_HEADERS)
