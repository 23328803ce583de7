// The frames of a sequence before they are rendered: what each of them is, which are there already, what is missing.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "cli/render_arguments.hpp"
#include "cli/scene_describe.hpp"

namespace brume {

inline constexpr const char* NOT_THERE = "cannot be opened: No such file or directory";

// That a name is one of many and --frames says nothing. InputError.
void sequence_refuse(const RenderArguments& arguments);

// What --frames cannot go with, and what it needs. InputError.
void sequence_check(const RenderArguments& arguments);

class SequenceScene {
 public:
  // A scene file is read now; around bare files one is made: camera and coefficients of the largest that can be read of
  // `frames`. Throws InputError.
  SequenceScene(const RenderArguments& arguments, const std::vector<int>& frames, const Say& say);

  SceneDesc describe(int frame) const;  // InputError
  // The scene with the names of the sequence in it and the camera of one frame. Not where each has a scene of its own.
  SceneDesc describe_all(int camera_of) const;
  bool scene_each() const { return text_.file.empty(); }
  // What the description of a frame names; nothing where it cannot be read, which is told in its turn.
  std::vector<std::filesystem::path> files(int frame) const;
  // The files that the frame needs and that are not there.
  std::vector<std::filesystem::path> missing(int frame) const;

 private:
  SceneText text_of(int frame) const;

  const RenderArguments& arguments_;
  SceneText text_;  // of all frames; empty where each has a scene file of its own
};

// Of those frames, the ones that are whole: all their outputs are there.
std::vector<int> frames_finished(const RenderArguments& arguments, const std::vector<int>& frames);

// frames whose files are missing → those files. InputError where that is every one of `frames`.
std::map<int, std::vector<std::filesystem::path>> frames_missing(const SequenceScene& scene,
                                                                 const std::vector<int>& frames);

}  // namespace brume
