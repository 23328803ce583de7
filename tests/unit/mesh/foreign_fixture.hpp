// PLY and glTF files as tests write them, and what the reader says to them.
#pragma once
#include <cstring>
#include <nlohmann/json.hpp>

#include "unit/mesh/obj_fixture.hpp"

namespace brume::test {

class Foreign : public Obj {
 protected:
  Mesh read_file(const std::string& name, const std::string& text) const { return mesh_read(write(text, name)); }
  // The message of the InputError behind the file's name, or "accepted".
  std::string refusal_of(const std::string& name, const std::string& text) const {
    const fs::path file = write(text, name);
    try {
      mesh_read(file);
    } catch (const InputError& error) {
      const std::string message = error.what(), begin = file.string() + ": ";
      EXPECT_THAT(message, testing::StartsWith(begin));
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return message.substr(std::min(begin.size(), message.size()));
    }
    return "accepted";
  }
};

// The bytes of a number, in the order of a big machine where asked.
template <class T>
std::string bytes_of(T value, bool big = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

// Two triangles and a square: the sides of a box without three of its faces. format: ascii, ...
inline std::string ply_text(const std::string& format, const std::string& vertices = "5") {
  const double positions[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 2}};
  const std::vector<std::vector<int>> faces{{0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}};
  std::string text = "ply\nformat " + format + " 1.0\ncomment of a test\nelement vertex " + vertices +
                     "\nproperty float x\nproperty double y\nproperty float z\nelement face 3\n"
                     "property list uchar int vertex_indices\nend_header\n";
  const bool ascii = format == "ascii", big = format == "binary_big_endian";
  for (const auto& p : positions)
    text += ascii ? std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + "\n"
                  : bytes_of(float(p[0]), big) + bytes_of(p[1], big) + bytes_of(float(p[2]), big);
  for (const auto& face : faces) {
    text += ascii ? std::to_string(face.size()) : std::string(1, char(face.size()));
    for (const int index : face) text += ascii ? " " + std::to_string(index) : bytes_of(index, big);
    if (ascii) text += "\n";
  }
  return text;
}

// One triangle in a buffer of its own, of which nodes make what they like.
inline nlohmann::json gltf_json() {
  return nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
    "materials": [{"name": "red", "emissiveFactor": [0, 0.5, 0],
                   "pbrMetallicRoughness": {"baseColorFactor": [1, 0.25, 0, 1], "metallicFactor": 0}}],
    "buffers": [{"uri": "a.bin", "byteLength": 72}],
    "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24},
                    {"buffer": 0, "byteOffset": 60, "byteLength": 12}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"},
                  {"bufferView": 2, "componentType": 5125, "count": 3, "type": "SCALAR"}]})");
}

inline std::string gltf_buffer(std::uint32_t last_index = 2) {
  std::string bytes;
  for (const float v : {0, 0, 0, 1, 0, 0, 0, 1, 0}) bytes += bytes_of(v);            // positions
  for (const float v : {0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.25f}) bytes += bytes_of(v);  // uv, v = 0 at the top
  for (const std::uint32_t i : {0u, 1u, last_index}) bytes += bytes_of(i);
  return bytes;
}

inline std::string glb_text(const nlohmann::json& json, std::string buffer) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  const auto number = [](std::size_t n) { return bytes_of(static_cast<std::uint32_t>(n)); };
  return "glTF" + number(2) + number(28 + text.size() + buffer.size()) + number(text.size()) + "JSON" + text +
         number(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

}  // namespace brume::test
