#include "datasets/real/real_points.hpp"

namespace hullbench::real {

namespace {

/// Of one package: its name, its licence, and then title and object of each set.
struct Package {
  std::string name;
  std::string licence;
  struct Set {
    std::string name;
    std::string title;
    std::string object;
  };
  std::vector<Set> sets;
};

/// The longer sets of each package, those with a window first.
const std::vector<Package>& packages() {
  static const std::vector<Package> all = {
      {"r-cran-spatstat.data",
       "GPL-2+",
       {
           {"clmfires", "Forest fires in Castilla-La Mancha", "clmfires"},
           {"nbfires", "Fires in New Brunswick", "nbfires"},
           {"stonetools", "Stone tools and bones in a layer of soil", "stonetools"},
           {"shapley", "Galaxies of the Shapley supercluster", "shapley"},
           {"bei", "Trees in a tropical rain forest", "bei"},
           {"urkiola", "Birches and oaks in a wood", "urkiola"},
           {"chorley", "Cases of cancer in Chorley", "chorley"},
           {"mucosa", "Cells in a stomach's mucosa", "mucosa"},
           {"btb", "Farms in Cornwall with bovine tuberculosis", "btb"},
           {"bramblecanes", "Bramble canes in a field", "bramblecanes"},
           {"gorillas", "Nests of gorillas", "gorillas"},
           {"longleaf", "Longleaf pines", "longleaf"},
           {"sporophores", "Fungi around a tree", "sporophores"},
           {"murchison", "Gold deposits", "murchison$gold"},
           {"humberside", "Addresses of children in Humberside", "humberside"},
           {"vesicles", "Synaptic vesicles round a mitochondrion", "vesicles"},
       }},
      {"r-cran-spdata",
       "CC0-1.0",
       {
           {"house", "Houses sold in Lucas County", "house"},
           {"elect80", "Counties of the United States", "elect80"},
           {"properties", "Flats in Athens", "properties"},
           {"cycle-hire", "Cycle hire stations in London", "cycle_hire"},
           {"boston", "Census tracts of Boston", "boston.c[c('LON','LAT')]"},
           {"wheat", "Plots of a field of wheat", "wheat[c('lon','lat')]"},
           {"splashdams", "Splash dams along rivers in Oregon", "SplashDams"},
           {"baltimore", "Houses sold in Baltimore", "baltimore[c('X','Y')]"},
       }},
      {"r-cran-sp",
       "GPL-2+",
       {
           {"meuse", "Cells of a lattice in a flood plain of the Meuse", "meuse.grid[c('x','y')]"},
       }},
      {"libcgal-demo",
       "CC0-1.0",
       {
           {"laser", "Airborne laser scan of a plot with houses, from above",
            "data/points_3/b9_training.ply"},
           {"laser-ground", "Laser scan: points labelled as ground", "data/points_3/b9_training.ply label=0"},
           {"laser-plants", "Laser scan: points labelled as plants", "data/points_3/b9_training.ply label=1"},
           {"laser-roof", "Laser scan: points labelled as roof", "data/points_3/b9_training.ply label=2"},
           {"walls", "Walls of buildings, from above", "data/points_3/point_set_2.xyz"},
           {"hippo", "Surface of a hippopotamus, from the side", "data/points_3/hippo1.ply"},
       }},
  };
  return all;
}

std::vector<Source> list_sources() {
  std::vector<Source> list;
  for (const Package& package : packages()) {
    for (const Package::Set& set : package.sets)
      list.push_back({"real-" + set.name, set.title, package.name, set.object, package.licence});
  }
  return list;
}

}  // namespace

const std::vector<Source>& sources() {
  static const std::vector<Source> all = list_sources();
  return all;
}

}  // namespace hullbench::real
