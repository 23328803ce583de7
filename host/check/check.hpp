// Kernels against the scalar reference on one device: device functions one by one, then whole images.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "check/tolerances.hpp"
#include "cl/context.hpp"
#include "flat/render_plan.hpp"

namespace brume {

struct CheckRow {
  std::string name;  // "hit/sphere", "image/fog"
  int lanes = 0;
  std::size_t items = 0;  // values compared
  std::size_t edges = 0;  // pixels (or rays) left out because they hit another surface or shadow
  double max_error = 0, mean_error = 0;
  Tolerance allowed{};
  bool passed() const;  // within tolerance, and no more edges than EDGE_SHARE (but one of a small set is let through)
};

// Collects the errors of one row.
class ErrorSum {
 public:
  ErrorSum(std::string name, int lanes, std::string_view tolerance_name);
  void add(double kernel, double reference);
  void add_edge() { ++row_.edges; }
  bool agrees(double kernel, double reference) const;
  CheckRow row() const;

 private:
  double error(double kernel, double reference) const;
  CheckRow row_;
  double sum_ = 0;
};

struct CheckOptions {
  std::vector<int> lanes{1, 4, 8, 16};
  int size = 64;       // pixels per side of the images; rays of the function checks follow its square
  std::string filter;  // only rows whose name contains this
};

// `report` is called with every row as it is finished. Returns all rows.
std::vector<CheckRow> check_run(Context& context, const CheckOptions& options,
                                const std::function<void(const CheckRow&)>& report);

// Runs one probe kernel (kernels/probes/probes.cl) over in.size() / in_stride items.
class Probe {
 public:
  Probe(Context& context, const PlannedScene& scene, int lanes) : context_(context), scene_(scene), lanes_(lanes) {}
  std::vector<float> run(const char* kernel, const std::vector<float>& in, std::size_t in_stride,
                         std::size_t out_stride) const;
  const PlannedScene& scene() const { return scene_; }
  int lanes() const { return lanes_; }

 private:
  Context& context_;
  const PlannedScene& scene_;
  int lanes_;
};

}  // namespace brume
