// Reads the next frame of a sequence while the one before is rendered: description, files and all that is flat, in a
// thread of its own.
#pragma once
#include <functional>
#include <future>
#include <optional>

#include "cli/picture.hpp"
#include "cli/sequence_scene.hpp"

namespace brume {

struct LoadedFrame {
  SceneDesc asked;
  std::optional<Prepared> prepared;  // unless settings are to be chosen, for which the device is needed
  LoadedScene loaded;                // for that
  double load_s = 0;
};

class SequenceLoader {
 public:
  SequenceLoader(const RenderArguments& arguments, const SequenceScene& scene) : arguments_(arguments), scene_(scene) {}
  // The device's, without which nothing becomes flat.
  void lanes_known(int lanes) { lanes_.set_value(lanes); }
  // Where nothing is being loaded. What `frame` shares with `next` is kept for it.
  void begin(int frame, std::optional<int> next);
  // Waits for it; throws what kept it from being loaded.
  LoadedFrame take() { return loading_.get(); }
  // Waits for what is being loaded, if the lanes are known; else for its files.
  ~SequenceLoader();
  SequenceLoader(const SequenceLoader&) = delete;
  SequenceLoader& operator=(const SequenceLoader&) = delete;

 private:
  LoadedFrame load(int frame, std::optional<int> next);

  const RenderArguments& arguments_;
  const SequenceScene& scene_;
  std::promise<int> lanes_;
  std::shared_future<int> lanes_given_{lanes_.get_future()};
  LoadedScene kept_;
  std::future<LoadedFrame> loading_;
};

}  // namespace brume
