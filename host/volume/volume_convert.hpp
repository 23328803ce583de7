// Active voxels as they come → Grid. Private to host/volume.
#pragma once
#include "volume/volume_file.hpp"
#include "volume/volume_program.hpp"

namespace brume {

class VolumeConvert {
 public:
  // `place`: "file: grid 'x'" for messages; `bytes_max`: of the grid.
  VolumeConvert(const VolumeProgram::GridHead& grid, std::string place, const VolumeValues& values,
                std::uint64_t bytes_max);
  // In this order; take() once. Each throws InputError where this is no density.
  void topology(const VolumeTopology& topology);
  void leaf(const VolumeLeaf& leaf);
  void tile(const VolumeTile& tile);
  Grid take(const VolumeReadEnd& end);

 private:
  struct Found {  // voxels of a kind
    std::uint64_t count = 0;
    ivec3 first{0};
    double value = 0;
  };
  double density(double value) const;
  float judge(float value, ivec3 index, std::uint64_t voxels);
  void finish_negative();
  void finish_background();

  const VolumeProgram::GridHead& head_;
  std::string place_;
  const VolumeValues& values_;
  std::uint64_t bytes_max_;
  bool plain_;        // densities are the values
  double voxel_ = 1;  // side of one
  VolumeTopology topology_{};
  ivec3 origin_{0};
  Grid grid_{ivec3(1)};
  double largest_ = 0;
  Found wild_, negative_;  // not finite; below 0, with the lowest
};

}  // namespace brume
