// OpenVDB files: where samples lie, which grid is taken, what a file holds, what is written.
#include "unit/vdb/vdb_fixture.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

#include "volume/density_source.hpp"
#include "volume/formats/openvdb.hpp"

using namespace brume;
using namespace brume::test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

dvec3 world_of(const Grid& grid, ivec3 i) { return dvec3(grid.world_from_lattice * glm::dvec4(dvec3(i) + 0.5, 1.0)); }

TEST_F(Vdb, OneVoxelSitsWhereItsTransformPutsIt) {
  const auto g = grid();
  openvdb::Mat4R m = openvdb::Mat4R::identity();
  m.postScale(openvdb::Vec3d(0.5, 0.25, 2));
  m.postRotate(openvdb::math::Z_AXIS, 0.3);
  m.postTranslate(openvdb::Vec3d(10, -20, 30));
  g->setTransform(openvdb::math::Transform::createLinearTransform(m));
  const openvdb::Vec3d expected = g->transform().indexToWorld(Coord(3, 4, 5));
  const Grid read = volume_read(file({g}));
  ASSERT_EQ(read.size(), ivec3(1));
  EXPECT_EQ(read.at({0, 0, 0}), 1.0f);
  EXPECT_EQ(read.border, Border::ZERO);
  EXPECT_LT(glm::distance(world_of(read, {0, 0, 0}), dvec3(expected.x(), expected.y(), expected.z())), 1e-12);
}

// Every sample of a grid with a tile and a negative origin against OpenVDB's own accessor and transform.
TEST_F(Vdb, TilesAndNegativeIndicesAreReadInPlace) {
  const auto g = grid();
  g->fill(CoordBBox(Coord(-16, -8, -24), Coord(-9, -1, -9)), 0.5f);  // two leaves: tiles after pruning
  g->tree().setValueOn(Coord(-30, 2, 1), 0.25f);
  g->tree().setValueOn(Coord(-31, 2, 1), 0.0f);  // active with value 0
  g->tree().prune();
  g->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
  ASSERT_GT(g->tree().activeTileCount(), 0u);
  const Grid read = volume_read(file({g}));
  const Coord origin(-31, -8, -24);
  ASSERT_EQ(read.size(), ivec3(35, 13, 30));
  for (ivec3 i(0); i.z < 30; ++i.z)
    for (i.y = 0; i.y < 13; ++i.y)
      for (i.x = 0; i.x < 35; ++i.x) ASSERT_EQ(read.at(i), g->tree().getValue(origin.offsetBy(i.x, i.y, i.z)));
  EXPECT_LT(glm::distance(world_of(read, {0, 0, 0}), dvec3(-3.1, -0.8, -2.4)), 1e-12);
  EXPECT_EQ(grid_stats(read).nonzero, 2u * 512 + 2);
}

TEST_F(Vdb, TakesTheGridThatIsMeant) {
  const auto fire = grid("fire", 2.0f), density = grid("density", 3.0f);
  const auto vec = grid_named("vec3s", "velocity");
  const fs::path both = file({vec, fire, density}), other = file({vec, fire}, "other.vdb");
  EXPECT_EQ(volume_read(both).name, "density");
  EXPECT_EQ(volume_read(both).at({0, 0, 0}), 3.0f);
  EXPECT_EQ(volume_read(both, "fire").at({0, 0, 0}), 2.0f);
  EXPECT_EQ(volume_read(other).name, "fire");
  EXPECT_THAT(refusal(both, "smoke"), AllOf(HasSubstr("no grid 'smoke'"), HasSubstr("'velocity' (vec3s, unknown)"),
                                            HasSubstr("'fire' (float, unknown)"), HasSubstr("'density'")));
  EXPECT_THAT(refusal(both, "velocity"),
              AllOf(HasSubstr("grid 'velocity': holds vec3s values"), HasSubstr("float, double")));
  EXPECT_THAT(refusal(file({vec, grid_named("vec3d", "normal")}, "none.vdb")),
              HasSubstr("none of its grids can be a density"));
}

TEST_F(Vdb, ANameInAnotherCaseAndTheOnlyFloatsAreTaken) {
  const auto fire = grid("fire", 2.0f), upper = grid("Density", 3.0f), lower = grid("density", 4.0f);
  const auto count = grid<openvdb::Int32Grid>("count", 5);
  EXPECT_EQ(volume_read(file({fire, upper})).name, "Density");
  EXPECT_EQ(volume_read(file({upper, lower, fire})).name, "density");
  EXPECT_EQ(volume_read(file({count, fire})).name, "fire");
  EXPECT_EQ(volume_read(file({count})).name, "count");
}

// Names become text: what is none, is shown as '?' and asked for so.
TEST_F(Vdb, NamesThatAreNoText) {
  const fs::path path = file({grid("d\xff\n\xc3\xa4", 2.0f), grid("e", 3.0f)});
  EXPECT_EQ(volume_list(path)[0].name, "d??\xc3\xa4");
  EXPECT_EQ(volume_read(path, "d??\xc3\xa4").at({0, 0, 0}), 2.0f);
}

// Silence would be a guess: which one is meant is for the scene to say.
TEST_F(Vdb, AmbiguousFilesAreAsked) {
  openvdb::GridPtrVec many;
  for (int i = 0; i < 30; ++i) many.push_back(grid("grid_" + std::to_string(i)));
  EXPECT_THAT(refusal(file(many)), AllOf(HasSubstr("which grid? 'grid_0', 'grid_1'"), HasSubstr("'grid_7' and 22 more"),
                                         HasSubstr("\"grid\" names one")));
  EXPECT_THAT(refusal(file({grid("Density"), grid("DENSITY")})), HasSubstr("which grid? 'Density', 'DENSITY'"));
  const VolumeFirst first = volume_read_first(file(many));
  EXPECT_EQ(first.grid.name, "grid_0");
  EXPECT_THAT(first.why, AllOf(HasSubstr("'grid_7' (float, unknown) and 22 more")));
}

// The first that can be one, not the first that looks like one.
TEST_F(Vdb, TheFirstIsOneThatCanBe) {
  const auto bad = grid("a", 1.0f, 0.5f), good = grid("b", 2.0f);
  EXPECT_EQ(volume_read_first(file({bad, good})).grid.name, "b");
  const auto level_set = grid("c", -0.5f, 1.5f);
  level_set->setGridClass(openvdb::GRID_LEVEL_SET);
  EXPECT_FALSE(volume_read_first(file({level_set, good})).fill);
  EXPECT_TRUE(volume_read_first(file({level_set})).fill);
}

TEST_F(Vdb, SeveralGridsOfOneName) {
  const fs::path path = file({grid("density", 2.0f), grid("density", 3.0f)});
  EXPECT_THAT(refusal(path), HasSubstr("which grid? 'density[0]', 'density[1]'"));
  EXPECT_EQ(volume_read_first(path).grid.at({0, 0, 0}), 2.0f);
  EXPECT_EQ(volume_read(path, "density[1]").at({0, 0, 0}), 3.0f);
  EXPECT_THAT(refusal(path, "density"),
              AllOf(HasSubstr("several grids 'density'"), HasSubstr("'density[0]'"), HasSubstr("'density[1]'")));
}

// Two grids that share a tree are stored as one tree and an instance of it.
TEST_F(Vdb, SharedTrees) {
  const auto a = grid("a", 2.0f);
  const auto b = FloatGrid::create(a->treePtr());
  b->setName("b");
  b->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  const fs::path path = file({a, b});
  const Grid read = volume_read(path, "b");
  EXPECT_EQ(read.at({0, 0, 0}), 2.0f);
  EXPECT_LT(glm::distance(world_of(read, {0, 0, 0}), dvec3(1.5, 2, 2.5)), 1e-12);
  EXPECT_EQ(volume_list(path)[1].active_voxels, 1u);
}

TEST_F(Vdb, WrittenGridsComeBack) {
  DensitySpec spec;
  spec.type = "sphere";
  spec.of = std::make_shared<DensitySpec>();
  spec.of->resolution = {30, 20, 17};
  spec.of->value = 0.75;
  Grid made = density_make(spec);
  made.world_from_lattice = dmat4(2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, -5, 6, 7, 1);
  made.set({29, 19, 16}, 0.3f);
  made.set({0, 0, 0}, 1e-3f);  // so that the active box is the whole lattice
  for (VdbPrecision precision : {VdbPrecision::FLOAT, VdbPrecision::HALF}) {
    vdb_write(made, folder_ / "out.vdb", precision);
    const Grid read = volume_read(folder_ / "out.vdb");
    ASSERT_EQ(read.size(), made.size());
    const float tolerance = precision == VdbPrecision::HALF ? 1.0f / 4096 : 0.0f;
    for (ivec3 i(0); i.z < 17; ++i.z)
      for (i.y = 0; i.y < 20; ++i.y)
        for (i.x = 0; i.x < 30; ++i.x) ASSERT_NEAR(read.at(i), made.at(i), tolerance);
    EXPECT_LT(glm::distance(world_of(read, {4, 5, 6}), world_of(made, {4, 5, 6})), 1e-12);
    EXPECT_EQ(read.name, "density");
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);  // no temporary is left
  EXPECT_THROW(vdb_write(made, folder_ / "absent" / "out.vdb"), RuntimeError);
}

TEST_F(Vdb, SparseGridsStaySparse) {
  const auto g = grid();
  for (int i = 0; i < 512; ++i) g->fill(CoordBBox(Coord(i, i, i), Coord(std::min(511, i + 7), i, i)), 1.0f);
  EXPECT_LT(volume_read(file({g})).stored_bytes(), 2u << 20);  // dense: 512 MiB
}

TEST_F(Vdb, ListsWhatAFileHolds) {
  const auto level_set = grid("inside", -0.5f, 0.25f);
  level_set->setGridClass(openvdb::GRID_LEVEL_SET);
  const auto fog = grid("fog");
  fog->tree().setValueOn(Coord(-1, 9, 5), 2.0f);
  fog->setGridClass(openvdb::GRID_FOG_VOLUME);
  fog->setTransform(openvdb::math::Transform::createLinearTransform(0.125));
  const std::vector<VolumeGridInfo> list = volume_list(file({level_set, fog}));
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].type, "float");
  EXPECT_EQ(list[0].grid_class, "level set");
  EXPECT_EQ(list[0].background, "0.25");
  EXPECT_THAT(list[0].refusal, HasSubstr("level set"));
  EXPECT_TRUE(list[1].can_be_density());
  EXPECT_EQ(list[1].name, "fog");
  EXPECT_EQ(list[1].grid_class, "fog volume");
  EXPECT_EQ(list[1].active_voxels, 2u);
  EXPECT_EQ(list[1].index_min, ivec3(-1, 4, 5));
  EXPECT_EQ(list[1].index_max, ivec3(3, 9, 5));
  EXPECT_EQ(list[1].voxel_size, dvec3(0.125));
}

// Every grid by itself, and in one reading of the file.
TEST_F(Vdb, ListsWhatCanBeADensityOnceItsVoxelsAreRead) {
  const auto negative = grid("negative", -1.0f), bent = grid("bent", 1.0f, 0.5f);
  const std::vector<VolumeGridInfo> list =
      volume_list(file({negative, grid("fine", 2.0f), bent, grid_named("vec3s", "wind")}), true);
  ASSERT_EQ(list.size(), 4u);
  EXPECT_THAT(list[0].refusal, HasSubstr("1 voxels are negative"));
  EXPECT_TRUE(list[1].can_be_density());
  EXPECT_EQ(list[1].density.value().max, 2.0f);
  EXPECT_THAT(list[2].refusal, HasSubstr("has the background 0.5"));
  EXPECT_THAT(list[3].refusal, HasSubstr("holds vec3s values"));
}

TEST_F(Vdb, RealFiles) {
  NEED_DATA(data_path("volumes/smoke.vdb"));
  const Grid smoke = volume_read(data_path("volumes/smoke.vdb"));
  EXPECT_EQ(smoke.size(), ivec3(111, 222, 112));
  EXPECT_EQ(grid_stats(smoke).nonzero, 1049275u);
  EXPECT_NEAR(glm::length(dvec3(smoke.world_from_lattice[0])), 0.476, 5e-4);
  std::vector<std::string> names;
  for (const VolumeGridInfo& info : volume_list(data_path("own/plume.vdb"))) names.push_back(info.name);
  EXPECT_THAT(names, ElementsAre("density", "flame", "temperature"));
  EXPECT_EQ(volume_read(data_path("own/plume.vdb"), "flame").size(), ivec3(16, 41, 16));
  EXPECT_THAT(refusal(data_path("volumes/cortex_points_nongrid.vdb")), HasSubstr("holds ptdataidx32 values"));
  EXPECT_THAT(refusal(data_path("volumes/cortex_sphere_levelset.vdb")), HasSubstr("is a level set"));
  EXPECT_THAT(refusal(data_path("volumes/oiio_sphereCd_vec3.vdb")), HasSubstr("holds vec3s values"));
}

// A ball about the world's origin made from a signed distance: 1 inside, falling to 0 at radius 1 over 0.305. The
// distance in the file is itself off by up to 1.6 % of the radius, hence the tolerance; half a voxel beside would miss
// by 0.16.
TEST_F(Vdb, TheBallIsRound) {
  NEED_DATA(data_path("volumes/oiio_sphere_fog.vdb"));
  const Grid ball = volume_read(data_path("volumes/oiio_sphere_fog.vdb"));
  ASSERT_EQ(ball.size(), ivec3(25));
  for (ivec3 i(0); i.z < 25; ++i.z)
    for (i.y = 0; i.y < 25; ++i.y)
      for (i.x = 0; i.x < 25; ++i.x) {
        const double expected = std::clamp((1 - glm::length(world_of(ball, i))) / 0.3052, 0.0, 1.0);
        ASSERT_NEAR(ball.at(i), expected, 0.06) << i.x << " " << i.y << " " << i.z;
      }
}

}  // namespace
