// write_laz_files FOLDER: LAS files of all point formats that are compressed, and the same as LAZ, for a
// decoder that is not ours: NAME.las and NAME.laz.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <utility>

#include "tests/laz_file.hpp"
#include "tests/laz_samples.hpp"

namespace {

using hullbench::testing::compressed;
using hullbench::testing::las_sample;
using hullbench::testing::LazSample;

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: write_laz_files FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  constexpr std::pair<LazSample, const char*> kSamples[] = {{LazSample::kScan, "scan"},
                                                            {LazSample::kOneBeam, "one_beam"},
                                                            {LazSample::kWild, "wild"},
                                                            {LazSample::kExtremes, "extremes"},
                                                            {LazSample::kConstant, "constant"}};
  for (const unsigned format : {0U, 1U, 2U, 3U, 6U, 7U, 8U}) {
    for (const auto& [sample, name] : kSamples) {
      const unsigned extra_bytes = format % 3;
      const std::string las = las_sample(sample, format, extra_bytes, 5000, 10 + format);
      const std::filesystem::path path = folder / (std::string(name) + std::to_string(format));
      write(path.string() + ".las", las);
      write(path.string() + ".laz", compressed(las, {.chunk_size = 1999}));
    }
  }
}
