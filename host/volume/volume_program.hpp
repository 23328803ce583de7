// A volume file opened by brume-volume (volume_protocol.hpp). Private to host/volume.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/helper_program.hpp"
#include "volume/volume_protocol.hpp"

namespace brume {

// The program has ended: nothing more can be asked of it.
struct VolumeCrash : InputError {
  using InputError::InputError;
};

class VolumeProgram {
 public:
  struct GridHead {
    VolumeGridHead head;
    std::string name, plain_name, type, grid_class, map;
    std::string failure;  // why it cannot be read, "" if it can
  };
  struct Sink {
    std::function<void(const VolumeTopology&, const std::string& background)> topology;
    std::function<void(const VolumeLeaf&)> leaf;
    std::function<void(const VolumeTile&)> tile;
  };

  // All of this throws InputError "file: ..." for files that cannot be read, VolumeCrash where the program crashes on
  // one; Interrupted on Ctrl-C.
  explicit VolumeProgram(const std::filesystem::path& file);
  const std::vector<GridHead>& grids() const { return grids_; }
  std::string place(std::size_t i) const;  // "file: grid 'density'", for messages
  // What a sink refuses is thrown when the grid has been received: the next one can be asked for.
  VolumeReadEnd read(std::size_t i, bool voxels, bool inside, const Sink& sink);

 private:
  VolumeFrame receive(VolumePayload& payload, const std::string& where);
  [[noreturn]] void fail_dead();
  std::string file_;
  HelperProgram program_;
  std::vector<GridHead> grids_;
};

// Sends one frame; false where the program is gone.
bool volume_send(HelperProgram& program, VolumeFrame kind, const void* data, std::size_t bytes,
                 const std::string& texts = {});
std::filesystem::path volume_program_file();

}  // namespace brume
