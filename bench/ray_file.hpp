// Triangles and rays that brume and a peer meet alike, as a file between them. Private to bench/.
#pragma once
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace brume::bench {

struct RayKind {
  const char* name;  // permanent
  bool any;          // whether anything is hit before t_max, or what first
  bool coherent;     // neighbours go about the same way
};
constexpr RayKind RAY_KINDS[] = {{"primary", false, true}, {"shadow", true, true}, {"bounce", false, false}};

constexpr std::size_t RAY_FLOATS = 7;     // origin, direction, t_max
constexpr std::size_t RAY_MULTIPLE = 16;  // rays of a kind, so that packets are whole

struct RayFile {
  std::vector<float> corners;          // 3 a corner
  std::vector<std::uint32_t> numbers;  // 3 corners a triangle
  std::vector<float> rays[std::size(RAY_KINDS)];
};

template <class Value>
void values_write(std::ofstream& out, const std::vector<Value>& values) {
  const std::uint64_t count = values.size();
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  out.write(reinterpret_cast<const char*>(values.data()), static_cast<std::streamsize>(count * sizeof(Value)));
}

template <class Value>
void values_read(std::ifstream& in, std::vector<Value>& values) {
  std::uint64_t count = 0;
  in.read(reinterpret_cast<char*>(&count), sizeof count);
  values.resize(count);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(Value)));
}

inline void ray_file_write(const RayFile& file, const std::string& path) {
  std::ofstream out(path, std::ios::binary);
  values_write(out, file.corners);
  values_write(out, file.numbers);
  for (const std::vector<float>& rays : file.rays) values_write(out, rays);
}

inline RayFile ray_file_read(const std::string& path) {
  RayFile file;
  std::ifstream in(path, std::ios::binary);
  values_read(in, file.corners);
  values_read(in, file.numbers);
  for (std::vector<float>& rays : file.rays) values_read(in, rays);
  return file;
}

}  // namespace brume::bench
