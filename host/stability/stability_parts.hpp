// What the stability cases share: rays through a small volume, and the judgement of what comes back.
#pragma once
#include <glm/vec3.hpp>

#include "check/check_parts.hpp"
#include "reference/vec.hpp"
#include "stability/stability.hpp"

namespace brume {

struct StabilityRays {
  std::vector<reference::RayD> rays;  // with coordinates that float holds
  std::vector<double> ends;

  void add(const dvec3& origin, const dvec3& dir, double t_max = INFINITY);  // dir is taken as it is
  void through(const dvec3& point, const dvec3& dir, double back = 4);       // dir is made unit
};

// One method at work on one case.
class StabilityRun {
 public:
  StabilityRun(Context& context, int method, int lanes) : context_(context), method_(method), lanes_(lanes) {}

  Context& context() const { return context_; }
  int method() const { return method_; }
  int lanes() const { return lanes_; }
  bool tracks() const;
  bool steps() const;  // equal steps: neither exact nor a tracker
  bool exact() const;  // for its interpolation

  // A cube [-1,1]³ of 8³ voxels under a sun from the front right, by this method. `density` and `medium` are JSON
  // members ("density" is constant 1 when empty), `render` too.
  PlannedScene cube(const std::string& density = "", const std::string& medium = "",
                    const std::string& render = "") const;

  struct Sent {
    dvec3 radiance, transmittance;
  };
  // The kernels along each ray; judges what must always hold.
  std::vector<Sent> shoot(const PlannedScene& scene, const StabilityRays& rays);
  // The same, and transmittances against the exact optical depth of the reference: methods that are exact must be
  // within `limit`, so must the others where all are (in a constant density, but for trackers); else the error is
  // recorded.
  void compare(const PlannedScene& scene, const StabilityRays& rays, double limit, bool all_exact);

  void expect(bool holds, const std::string& remark);  // a remark is kept when it does not hold
  void record(const std::string& remark);
  const StabilityRow& row() const { return row_; }

 private:
  Context& context_;
  int method_, lanes_;
  StabilityRow row_;
};

std::string number(double value);  // three digits

inline bool all_methods(int) { return true; }
inline bool is_for_liquids(int method) { return method_fits(method) == FITS_PRESENCE; }
inline bool for_densities(int method) { return !is_for_liquids(method); }

struct StabilityEntry {
  const char* name;
  const char* what;
  void (*run)(StabilityRun&);
  bool (*fits)(int method);
};
extern const std::vector<StabilityEntry> STABILITY_RAYS, STABILITY_MEDIA;

}  // namespace brume
