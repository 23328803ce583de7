// brume-embree FILE REPETITIONS: triangles and rays of bench/ray_file.hpp through Embree 3, the peer of `brume bench
// --peers`. A line for the build and for each kind of rays: its name, which call was the quickest, seconds of each run.
#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <tuple>
#include <vector>

#include "base/stopwatch.hpp"
#include "ray_file.hpp"

namespace brume::bench {

namespace {

constexpr std::size_t AT_A_TIME = 4096;  // rays that a thread takes

RTCScene scene_build(RTCDevice device, const RayFile& file, double& seconds) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t corners = file.corners.size() / 3;
  void* positions =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), corners);
  std::memcpy(positions, file.corners.data(), file.corners.size() * sizeof(float));
  auto* numbers = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                 3 * sizeof(unsigned), file.numbers.size() / 3));
  std::copy(file.numbers.begin(), file.numbers.end(), numbers);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  const Stopwatch watch;
  rtcCommitScene(scene);
  seconds = watch.seconds();
  return scene;
}

// One call of Embree's on N rays from `ray` on; returns how many are hit.
template <int N>
struct Calls;

template <>
struct Calls<1> {
  static RTCRay one(const float* ray) {
    RTCRay r{};
    std::tie(r.org_x, r.org_y, r.org_z) = std::tie(ray[0], ray[1], ray[2]);
    std::tie(r.dir_x, r.dir_y, r.dir_z, r.tfar) = std::tie(ray[3], ray[4], ray[5], ray[6]);
    r.mask = ~0u;
    return r;
  }
  static long intersect(RTCScene scene, RTCIntersectContext* context, const float* ray) {
    RTCRayHit hit{one(ray), {}};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, context, &hit);
    return hit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
  }
  static long occluded(RTCScene scene, RTCIntersectContext* context, const float* ray) {
    RTCRay r = one(ray);
    rtcOccluded1(scene, context, &r);
    return r.tfar < 0;
  }
};

template <class Rays>
void lane_set(Rays& r, int lane, const float* ray) {
  std::tie(r.org_x[lane], r.org_y[lane], r.org_z[lane]) = std::tie(ray[0], ray[1], ray[2]);
  std::tie(r.dir_x[lane], r.dir_y[lane], r.dir_z[lane]) = std::tie(ray[3], ray[4], ray[5]);
  r.tfar[lane] = ray[6];
  r.tnear[lane] = r.time[lane] = 0;
  r.mask[lane] = ~0u;
  r.flags[lane] = 0;
}

template <int N, class Rays, class RayHits, auto INTERSECT, auto OCCLUDED>
struct Packets {
  static constexpr int lanes = N;
  static long intersect(RTCScene scene, RTCIntersectContext* context, const float* rays) {
    alignas(64) int valid[N];
    std::fill(valid, valid + N, -1);
    RayHits hits;
    for (int i = 0; i < N; ++i) {
      lane_set(hits.ray, i, rays + RAY_FLOATS * i);
      hits.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    INTERSECT(valid, scene, context, &hits);
    return N - std::count(hits.hit.geomID, hits.hit.geomID + N, RTC_INVALID_GEOMETRY_ID);
  }
  static long occluded(RTCScene scene, RTCIntersectContext* context, const float* rays) {
    alignas(64) int valid[N];
    std::fill(valid, valid + N, -1);
    Rays r;
    for (int i = 0; i < N; ++i) lane_set(r, i, rays + RAY_FLOATS * i);
    OCCLUDED(valid, scene, context, &r);
    return std::count_if(r.tfar, r.tfar + N, [](float t) { return t < 0; });
  }
};
template <>
struct Calls<8> : Packets<8, RTCRay8, RTCRayHit8, rtcIntersect8, rtcOccluded8> {};
template <>
struct Calls<16> : Packets<16, RTCRay16, RTCRayHit16, rtcIntersect16, rtcOccluded16> {};

using Call = long (*)(RTCScene, RTCIntersectContext*, const float*);
struct Way {
  const char* name;
  int rays;
  Call intersect, occluded;
};
constexpr Way WAYS[] = {{"1", 1, Calls<1>::intersect, Calls<1>::occluded},
                        {"8", 8, Calls<8>::intersect, Calls<8>::occluded},
                        {"16", 16, Calls<16>::intersect, Calls<16>::occluded}};

// Seconds for all rays of a kind, on all cores. Rays come in whole packets.
double seconds_of(RTCScene scene, const RayKind& kind, const Way& way, const std::vector<float>& rays, long& hits) {
  std::atomic<std::size_t> next{0};
  std::atomic<long> all{0};
  const std::size_t count = rays.size() / RAY_FLOATS;
  const auto work = [&] {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = kind.coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    long mine = 0;
    for (std::size_t from; (from = next.fetch_add(AT_A_TIME)) < count;)
      for (std::size_t i = from; i < std::min(from + AT_A_TIME, count); i += static_cast<std::size_t>(way.rays))
        mine += (kind.any ? way.occluded : way.intersect)(scene, &context, &rays[RAY_FLOATS * i]);
    all += mine;
  };
  const Stopwatch watch;
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  hits = all;
  return watch.seconds();
}

void print(const char* name, const char* way, long hits, const std::vector<double>& seconds) {
  std::printf("%s %s %ld", name, way, hits);
  for (const double s : seconds) std::printf(" %.9g", s);
  std::printf("\n");
}

void kind_measure(RTCScene scene, const RayKind& kind, const std::vector<float>& rays, int repetitions) {
  std::vector<double> best;
  const char* best_way = "";
  long best_hits = 0;
  for (const Way& way : WAYS) {
    long hits = 0;
    std::vector<double> seconds;
    for (int run = -1; run < repetitions; ++run) {
      const double took = seconds_of(scene, kind, way, rays, hits);
      if (run >= 0) seconds.push_back(took);  // the first warms up
    }
    if (!best.empty() &&
        *std::min_element(best.begin(), best.end()) <= *std::min_element(seconds.begin(), seconds.end()))
      continue;
    best = seconds;
    best_way = way.name;
    best_hits = hits;
  }
  print(kind.name, best_way, best_hits, best);
}

void measure(const char* path, int repetitions) {
  const RayFile file = ray_file_read(path);
  RTCDevice device = rtcNewDevice(nullptr);
  std::vector<double> builds(static_cast<std::size_t>(repetitions));
  RTCScene scene = nullptr;
  for (double& seconds : builds) {
    if (scene) rtcReleaseScene(scene);
    scene = scene_build(device, file, seconds);
  }
  print("build", "high", 0, builds);
  for (std::size_t i = 0; i < std::size(RAY_KINDS); ++i) kind_measure(scene, RAY_KINDS[i], file.rays[i], repetitions);
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}

}  // namespace

}  // namespace brume::bench

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  brume::bench::measure(argv[1], std::atoi(argv[2]));
  return 0;
}
