// A scene of `brume check` as text. check_media_texts.hpp and check_surface_texts.hpp hold them.
#pragma once

namespace brume {

struct SceneText {
  const char* name;
  const char* text;
};

}  // namespace brume
