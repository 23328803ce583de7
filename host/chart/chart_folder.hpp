// The folder of a chart: what an earlier run left in it is kept where it is of the same pictures.
#pragma once
#include <filesystem>
#include <optional>

#include "chart/point.hpp"
#include "image/image.hpp"

namespace brume {

class ChartFolder {
 public:
  // Reads what is there. InputError where that is the chart of something else, or no chart, unless `overwrite`: then
  // nothing of it counts, and what the new one does not write stays until it does. RuntimeError where the folder cannot
  // be made; one that is made and stays empty goes again.
  ChartFolder(const std::filesystem::path& folder, const ChartIdentity& identity, bool overwrite);
  ~ChartFolder();
  ChartFolder(const ChartFolder&) = delete;
  ChartFolder& operator=(const ChartFolder&) = delete;

  // Points of the earlier run whose pictures are there, and its exact picture's error.
  const Chart& kept() const { return kept_; }

  std::filesystem::path file(const char* name) const { return folder_ / name; }  // "chart.csv"
  std::filesystem::path exact_file(int spp) const;
  std::filesystem::path picture_file(const Knobs& knobs) const;
  std::filesystem::path error_file(const Knobs& knobs) const;

  // The exact picture of an earlier run of the same chart, where it is there, of that size.
  std::optional<Image> exact_read(int spp, int width, int height) const;
  void exact_write(int spp, const Image& image) const;
  void exact_show(const Image& image, const FilmDesc& film) const;  // exact.jpg
  void point_write(const Knobs& knobs, const Image& image, const Image& exact, const FilmDesc& film) const;
  void json_write(const Chart& chart) const;

 private:
  std::filesystem::path folder_;
  bool made_ = false, same_ = false;
  Chart kept_;
};

// Why points of the one cannot stand in the chart of the other: "spp is 1 there and 4 here"; "" where they can.
std::string identity_difference(const ChartIdentity& there, const ChartIdentity& here);

}  // namespace brume
