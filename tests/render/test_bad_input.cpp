// Bad input answers with one line and exit 2, what the machine lacks with exit 1, and neither leaves a file behind.
#include "program.hpp"

namespace brume::test {
namespace {

class BadInput : public Program {
 protected:
  void expect_scene_refused(const std::string& scene, const std::string& cause) const {
    write("a.json", scene);
    expect_refused("render a.json -o a.png", 2, cause);
  }
};

struct SceneCase {
  const char* scene;
  const char* cause;
};

TEST_F(BadInput, Scenes) {
  const SceneCase cases[] = {
      {"", "a.json: is empty"},
      {"{\"camera\": {", "a.json: line 1"},
      {R"({"camra": {}})", "a.json: /: unknown key 'camra' (did you mean 'camera'?)"},
      {R"({"film": {"size": "big"}})", "a.json: /film/size: expected"},
      {R"({"film": {"size": [0, 64]}})", "a.json: /film/size/0: expected an integer in [1,"},
      {R"({"film": {"spp": 0}})", "a.json: /film/spp: expected"},
      {R"({"camera": {"eye": [1, 1, 1], "target": [1, 1, 1]}})", "/camera"},
      {R"({"media": [{"density": {"type": "constant"}, "sigma_a": -1}]})", "a.json: /media/0/sigma_a: expected"},
      {R"({"media": [{"density": {"type": "constant"}, "phase": {"type": "henyey_greenstein", "g": 1}}]})",
       "a.json: /media/0/phase/g: expected"},
      {R"({"media": [{"density": {"type": "constant"}, "bounds": [[1, 1, 1], [0, 0, 0]]}]})", "/media/0/bounds"},
      {R"({"render": {"method": "magic"}})", "unknown method 'magic'; known: auto, dda_nearest"},
      {R"({"render": {"step": 0}})", "a.json: /render/step: expected"},
      {R"({"film": {"size": [512, 512]}, "lights": [{"type": "directional", "direction": [0, -1, 0]}],
           "media": [{"density": {"type": "linear"}, "sigma_s": 1}], "render": {"method": "march_midpoint", "step": 1e-5}})",
       "173206 steps a ray and 8e+15 density lookups"},
      {R"({"render": {"method": "dda_nearest"}, "media": [{"density": {"type": "linear"}}]})", "these do: auto"},
      {R"({"render": {"shadow": "grid"}, "media": [{"density": {"type": "linear"}, "sigma_a": 1}]})", "sigma_s is 0"},
      {R"({"media": [{"density": {"type": "linear"}, "method": "homogeneous"}]})",
       "/media/0/method: 'homogeneous' does not"},
      {R"({"media": [{"density": {"type": "file", "path": "none.vdb"}}]})", "none.vdb"},
      {R"({"shapes": [{"type": "mesh", "file": "none.obj"}]})", "none.obj"},
      {R"({"materials": {"m": {"texture": "none.png"}},
           "shapes": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"}]})",
       "none.png"},
  };
  for (const SceneCase& c : cases) expect_scene_refused(c.scene, c.cause);
}

TEST_F(BadInput, Meshes) {
  const SceneCase cases[] = {
      {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "bad.obj"},
      {"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "bad.obj"},
      {"", "bad.obj"},
  };
  for (const SceneCase& c : cases) {
    write("bad.obj", c.scene);
    expect_refused("render bad.obj -o a.png", 2, c.cause);
  }
}

TEST_F(BadInput, Volumes) {
  write("empty.vdb", "");
  expect_refused("render empty.vdb -o a.png", 2, "empty.vdb");
  write("text.vdb", "this is no volume at all, whatever its name says\n");
  expect_refused("render text.vdb -o a.png", 2, "text.vdb");
  const std::string whole = text(BRUME_SOURCE_DIR "/scenes/data/plume.vdb");
  ASSERT_GT(whole.size(), 10000u);
  for (const std::size_t size : {std::size_t(20), std::size_t(400), whole.size() / 2, whole.size() - 10}) {
    write("cut.vdb", whole.substr(0, size));
    expect_refused("render cut.vdb -o a.png", 2, "cut.vdb");
  }
  std::string damaged = text(BRUME_SOURCE_DIR "/tests/data/mitsuba/fog_grey.vdb");
  damaged.at(9408) = 127;  // within compressed voxels: it crashes OpenVDB
  write("damaged.vdb", damaged);
  expect_refused("render damaged.vdb -o a.png", 2, "damaged.vdb: ");
  expect_refused("info damaged.vdb", 2, "damaged.vdb: ");
  write("a.json", R"({"media": [{"density": {"type": "file", "path": ")" BRUME_SOURCE_DIR
                  R"(/scenes/data/plume.vdb", "grid": "soot"}}]})");
  expect_refused("render a.json -o a.png", 2, "soot");
}

TEST_F(BadInput, DamagedImages) {
  const fs::path folder = test_data() / "damaged";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is not there";
  for (const char* name :
       {"oiio/bomb.exr", "oiio/bomb-65500x65500.jpg", "oiio/bad-y.bmp", "openexr/memory_DOS_1.exr"}) {
    write("a.json", R"({"materials": {"m": {"texture": ")" + (folder / name).string() +
                        R"("}}, "shapes": [{"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "m"}]})");
    expect_refused("render a.json -o a.png", 2, fs::path(name).filename().string());
  }
}

TEST_F(BadInput, CommandLine) {
  write("a.json", "{}");
  expect_refused("render a.json -o a.gif", 2, "a.gif");
  expect_refused("render a.json -o a.png --size 64", 2, "--size");
  expect_refused("render a.json -o a.png --crop 0,0,9999,9999", 2, "--crop");
  expect_refused("render a.json -o a.png --method magic", 2, "dda_nearest");
  expect_refused("render a.json -o a.png --set /film/spp", 2, "--set");
  expect_refused("render a.json -o a.png --aov heat", 2, "depth");
  expect_refused("render a.json -o a.png --lanes 3", 2, "--lanes");
  expect_refused("render none.json -o a.png", 2, "none.json");
  expect_refused("rendr a.json", 2, "rendr");
  expect_refused("info none.vdb", 2, "none.vdb");
  expect_refused("compare none.exr a.exr", 2, "none.exr");
}

TEST_F(BadInput, DevicesAndFolders) {
  write("a.json", "{}");
  expect_refused("render a.json -o a.png --device gpu-of-tomorrow", 2, "gpu-of-tomorrow");
  expect_refused("render a.json -o a.png", 1, "OpenCL", "OCL_ICD_VENDORS=/nonexistent");
  expect_refused("render a.json -o none/a.png", 1, "none");
  expect_refused("render a.json -o a.exr --size 65536x65536", 1,
                 "a film of 65536 x 65536 pixels: needs more memory than there is");
}

TEST_F(BadInput, FolderWithoutPermission) {
  write("a.json", "{}");
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere: a folder without permission is not tested";
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  expect_refused("render a.json -o a.png", 1, folder_.string());
}

}  // namespace
}  // namespace brume::test
