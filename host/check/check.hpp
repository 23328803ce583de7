// Kernels against the scalar reference on one device: device functions one by one, then whole images.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "check/tolerances.hpp"
#include "cl/context.hpp"

namespace brume {

struct CheckRow {
  std::string name;  // "hit/sphere", "image/fog"
  int lanes = 0;
  std::size_t items = 0;  // values compared
  std::size_t edges = 0;  // pixels (or rays) left out, see EDGE_SHARE
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
  void set_items(std::size_t items) { items_ = items; }  // of which edges are a share; else the values added
  bool agrees(double kernel, double reference) const;
  bool agree(const std::vector<double>& kernel, const std::vector<double>& reference) const;  // all of them
  CheckRow row() const;

 private:
  double error(double kernel, double reference) const;
  CheckRow row_;
  double sum_ = 0;
  std::size_t items_ = 0;
};

struct CheckOptions {
  std::vector<int> lanes{1, 4, 8, 16};
  int size = 64;                  // pixels per side of the images; rays of the function checks follow its square
  std::string filter;             // only rows whose name contains this; nothing is worked out for the others
  std::vector<std::string> skip;  // and none of these
};

// The names of all rows, in their order. Most follow from the rows of the families in kernels/shared.
std::vector<std::string> check_names();

// `report` is called with every row as it is finished. Returns all rows: one per name and lane width.
std::vector<CheckRow> check_run(Context& context, const CheckOptions& options,
                                const std::function<void(const CheckRow&)>& report);

}  // namespace brume
