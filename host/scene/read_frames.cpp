// The names in a scene of which every frame of a sequence has its own: "tank_%04d.vdb".
#include "base/frame_pattern.hpp"
#include "scene/read_parts.hpp"

namespace brume {

namespace {

void text_apply(nlohmann::json& text, int frame, const JsonValue& value) {
  if (!frame_pattern(text.get_ref<const std::string&>())) return;
  if (frame == FRAME_NONE)
    value.fail("names the files of a sequence, expected together with brume render --frames" + value.got());
  text = frame_name(text.get<std::string>(), frame);
}

}  // namespace

void apply_frame(nlohmann::json& at, int frame, const std::string& file, const std::string& place) {
  if (at.is_string()) text_apply(at, frame, JsonValue(at, file, place));
  if (at.is_object())
    for (const auto& member : at.items()) apply_frame(member.value(), frame, file, place + "/" + member.key());
  if (at.is_array())
    for (std::size_t i = 0; i < at.size(); ++i) apply_frame(at[i], frame, file, place + "/" + std::to_string(i));
}

}  // namespace brume
