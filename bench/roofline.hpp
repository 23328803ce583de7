// How near brume comes to what the device allows: rates of its parts, each next to the rate that the device's own speed
// of copying, multiplying and loading would allow. All of it is measured in the same run.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cl/device.hpp"
#include "row.hpp"

namespace brume::bench {

// What one item of a row cannot do without, counted by hand from the kernels.
struct Cost {
  double bytes = 0;  // to and from memory, where caches keep whatever is used again
  double flops = 0;  // an fma is two
  double loads = 0;  // from places that differ by lane, of one number or of two neighbours
  std::string because;
};

struct RooflineRow {
  Row row;           // counters: items, item_bytes, item_flops, item_loads; once it is held against the limits, share
  std::string item;  // "lookup"
  Cost cost;
  double rate = 0, allowed = 0;  // items a second
  std::string limit;             // which of the device's rates allows no more: copy, fma or loads
};

struct RooflineOptions {
  int size = 512;  // pixels a side
  int repetitions = 3;
};

// Every row is reported as it is finished, the limits first. `folder` takes volumes, meshes and pictures.
std::vector<RooflineRow> roofline_run(const DeviceInfo& device, const RooflineOptions& options,
                                      const std::filesystem::path& folder,
                                      const std::function<void(const RooflineRow&)>& report);

std::string roofline_header();
std::string roofline_text(const RooflineRow& row);
std::string roofline_legend(const std::vector<RooflineRow>& rows);  // why an item costs what it costs

// By gnuplot; false where there is none.
bool roofline_plot(const std::string& device, const std::vector<RooflineRow>& rows, const std::filesystem::path& svg,
                   const std::filesystem::path& png);

}  // namespace brume::bench
