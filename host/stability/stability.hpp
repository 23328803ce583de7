// Where methods fail: cases that are known to break volume renderers, for every method that fits, on one device.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "cl/context.hpp"

namespace brume {

// One method in one case. Always demanded: no NaN, no infinity, no negative light, 0 <= transmittance <= 1, and an
// end. What else a case demands of which methods, and what it only records, its remark says.
struct StabilityRow {
  std::string name;    // of the case
  std::string method;  // with the in-scattering rule or interpolation where the case is about them
  int lanes = 0;
  bool holds = true;
  std::string remark;  // "transmittance off by 2e-7", "overshoots 3.1 times"
};

struct StabilityOptions {
  std::vector<int> lanes{1, 8};
  std::string filter;  // only cases whose name contains this
};

// `report` is called with every row as it is finished. Returns all rows.
std::vector<StabilityRow> check_stability(Context& context, const StabilityOptions& options,
                                          const std::function<void(const StabilityRow&)>& report);

struct StabilityCase {
  const char* name;
  const char* what;
};
std::vector<StabilityCase> stability_cases();

}  // namespace brume
