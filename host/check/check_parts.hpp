// The checks behind check_run, and the scenes they share.
#pragma once
#include <cstring>

#include "check/check.hpp"
#include "scene/scene_desc.hpp"

namespace brume {

struct CheckScene {
  std::string name;
  FlatScene flat;
};

// Scenes that between them use every shape, light, material, phase, method, interpolation and density. Made here, not read from
// files: `brume check` works wherever brume is installed.
std::vector<std::string> check_scene_names();
FlatScene check_scene(const std::string& name, int size, int bvh_width);

// One function check: fills rows for a device, a lane width and a number of items.
using FunctionCheck = std::vector<CheckRow> (*)(Context&, int lanes, int items);
struct FunctionCheckRow {
  const char* name;
  FunctionCheck run;
};
const std::vector<FunctionCheckRow>& function_checks();

std::vector<CheckRow> check_layout(Context&, int lanes, int items);
std::vector<CheckRow> check_rng(Context&, int lanes, int items);
std::vector<CheckRow> check_camera(Context&, int lanes, int items);
std::vector<CheckRow> check_phase(Context&, int lanes, int items);
std::vector<CheckRow> check_light(Context&, int lanes, int items);
std::vector<CheckRow> check_texture(Context&, int lanes, int items);
std::vector<CheckRow> check_surfaces(Context&, int lanes, int items);
std::vector<CheckRow> check_media(Context&, int lanes, int items);
std::vector<CheckRow> check_density(Context&, int lanes, int items);

// Random numbers for test inputs; same on every platform.
class CheckRandom {
 public:
  double uniform(double lo, double hi);
  dvec3 in_box(double half);
  dvec3 direction();  // unit, as float rounds it

 private:
  std::uint64_t state_ = 0x853c49e6748fea9bULL;
};

inline float bits_as_float(std::int32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}
inline std::int32_t float_as_bits(float value) {
  std::int32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace brume
