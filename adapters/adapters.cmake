# The methods, in the order of the tables: one line each.

add_adapter(NAME polylidar TITLE "Polylidar" LIBRARIES polylidar::core)
set_source_files_properties(polylidar.cpp PROPERTIES COMPILE_DEFINITIONS "POLYLIDAR_VERSION=\"${PROJECT_VERSION}\"")

find_package(CGAL QUIET)
if(CGAL_FOUND)
  add_adapter(NAME cgal_alpha_shape TITLE "CGAL alpha shape" LIBRARIES CGAL::CGAL)
else()
  add_adapter(NAME cgal_alpha_shape TITLE "CGAL alpha shape"
    MISSING "CGAL" INSTALL "sudo apt-get install libcgal-dev")
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
