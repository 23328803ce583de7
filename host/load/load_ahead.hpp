// What a scene's description names, loaded in a thread of its own while this one does something else: looks for the
// device, which takes about as long as a volume.
#pragma once
#include <atomic>
#include <thread>

#include "load/loaded_scene.hpp"

namespace brume {

class LoadAhead {
 public:
  // Until it dies nobody else may use `loaded`. What cannot be loaded is left out: whoever asks for it is told then.
  LoadAhead(LoadedScene& loaded, const SceneDesc& desc);
  ~LoadAhead();  // waits, for one file at most where an exception ends its scope
  LoadAhead(const LoadAhead&) = delete;
  LoadAhead& operator=(const LoadAhead&) = delete;

 private:
  int exceptions_;
  std::atomic<bool> stopped_{false};
  std::thread thread_;
};

}  // namespace brume
