#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "datasets/sha256.hpp"
#include "tests/complaint.hpp"
#include "tests/temporary_folder.hpp"

namespace hullbench::testing {
namespace {

// The examples of FIPS 180-4 for one block and two blocks, and the digest of nothing.
TEST(Sha256, PublishedExamples) {
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(Sha256, FileIsHashedByteByByte) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "bytes";
  const std::string bytes("a\0b\r\n\xFF", 6);
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_EQ(sha256_file(path), sha256_hex(bytes));
}

TEST(Sha256, UnreadableFileIsNamed) {
  for (const std::filesystem::path path : {"/nowhere/at all", "/"}) {
    expect_complaint([&] { sha256_file(path); }, "cannot read " + path.string());
  }
}

}  // namespace
}  // namespace hullbench::testing
