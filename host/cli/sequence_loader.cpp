// See sequence_loader.hpp.
#include "cli/sequence_loader.hpp"

#include "base/error.hpp"
#include "base/out_of_memory.hpp"
#include "base/stopwatch.hpp"
#include "load/load_ahead.hpp"

namespace brume {

void SequenceLoader::begin(int frame, std::optional<int> next) {
  loading_ = std::async(std::launch::async, [=] { return load(frame, next); });
}

LoadedFrame SequenceLoader::load(int frame, std::optional<int> next) {
  Stopwatch watch;
  LoadedFrame made;
  const RenderArguments one = arguments_.of_frame(frame);
  return with_memory(one.scene.string(), [&] {
    made.asked = scene_.describe(frame);
    made.loaded = kept_;
    made.loaded.needed_again = false;
    { const LoadAhead ahead(made.loaded, made.asked); }
    made.load_s = watch.lap();
    const int lanes = lanes_given_.get();
    watch.lap();
    try {
      kept_ = next ? made.loaded.shared_with(scene_.describe(*next)) : LoadedScene();
    } catch (const InputError&) {  // told in its turn
      kept_ = {};
    }
    if (!made.asked.render.has_goal()) {
      Prepared prepared = prepared_of(one, made.asked, made.loaded, lanes);
      made.prepared = std::move(prepared);
      made.loaded = {};
    }
    made.load_s += watch.seconds();
    return std::move(made);
  });
}

SequenceLoader::~SequenceLoader() {
  if (!loading_.valid()) return;
  lanes_ = {};  // where they were never given, whoever waits for them is told so
  loading_.wait();
}

}  // namespace brume
