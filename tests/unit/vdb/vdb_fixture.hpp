// Fixture for tests of OpenVDB files: a folder to make them in, made files, and what the reader says to them.
#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "base/error.hpp"
#include "volume/volume_file.hpp"

namespace brume::test {

namespace fs = std::filesystem;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;

inline fs::path data_path(const std::string& name) {
  const char* set = std::getenv("BRUME_TEST_DATA");
  return fs::path(set ? set : BRUME_SOURCE_DIR "/../shared/data") / name;
}

#define NEED_DATA(path) \
  if (!fs::exists(path)) GTEST_SKIP() << "absent: " << path

inline std::string bytes_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// An empty grid of any registered type: "bool", "vec3s". Instantiates nothing.
inline openvdb::GridBase::Ptr grid_named(const std::string& type, const std::string& name) {
  const openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid("Tree_" + type + "_5_4_3");
  grid->setName(name);
  return grid;
}

// A folder of its own for every test, removed at the end.
class Vdb : public testing::Test {
 protected:
  void SetUp() override {
    openvdb::initialize();
    folder_ = fs::temp_directory_path() / ("brume_vdb_" + std::to_string(getpid()) + "_" +
                                           testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file(const std::string& bytes, const std::string& name = "bytes.vdb") {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  fs::path file(const openvdb::GridPtrVec& grids, const std::string& name = "made.vdb") {
    openvdb::io::File((folder_ / name).string()).write(grids);
    return folder_ / name;
  }
  // A grid with one voxel, at index (3, 4, 5).
  template <class G = FloatGrid>
  static typename G::Ptr grid(const std::string& name = "density",
                              typename G::ValueType value = typename G::ValueType(1),
                              typename G::ValueType background = typename G::ValueType(0)) {
    const auto g = G::create(background);
    g->setName(name);
    g->tree().setValueOn(Coord(3, 4, 5), value);
    return g;
  }
  static std::string refusal(const fs::path& path, const std::string& name = "") {
    try {
      volume_read(path, name);
    } catch (const InputError& e) {
      const std::string message = e.what();
      EXPECT_EQ(message.find(path.string()), 0u) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return message;
    }
    return "accepted";
  }
  fs::path folder_;
};

}  // namespace brume::test
