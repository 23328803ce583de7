// Where densities come from: one table name -> function of generators and files. Knows nothing of where a medium stands
// or of its coefficients.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "base/family.hpp"
#include "volume/grid.hpp"
#include "volume/volume_file.hpp"

namespace brume {

// What becomes of values beyond 1 where the density is a presence.
enum class Presence { NONE, REFUSE, SCALE, CLAMP };

// The "density" of a medium; each type reads the fields that name it.
struct DensitySpec {
  std::string type = "constant";    // a name of density_family()
  ivec3 resolution{64};             // generators but sphere: samples, each >= 1
  double value = 1;                 // constant: finite, >= 0
  double scale = 4;                 // perlin: lattice cells along the longest side, in (0, 1e9]
  int octaves = 4;                  // perlin: 1 ... 16
  int seed = 1;                     // perlin
  double radius = 0.75;             // ball: share of half the grid, > 0
  double ramp = 2;                  // ball: voxels, > 0
  std::filesystem::path file;       // file
  std::string grid;                 // file: name of the grid, empty = the one that volume_read() takes
  VolumeValues values;              // file
  std::shared_ptr<DensitySpec> of;  // sphere: what is cut
  Presence presence = Presence::NONE;
};

const Family& density_family();

// Equal where density_make gives the same grid: the file by its absolute path.
std::string density_key(const DensitySpec& spec);

// Generators: Border::CLAMP and world_from_lattice left at identity. Files: Border::ZERO and the file's transform.
// Every sample is finite and >= 0, of a presence at most 1. Throws InputError.
Grid density_make(const DensitySpec& spec);

}  // namespace brume
