// What a benchmark measured: a row of the table that people read, and of the JSON that comparisons and README read.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace brume::bench {

struct Row {
  std::string name;                        // permanent: results of years are compared by it
  std::vector<double> seconds;             // of each run
  std::map<std::string, double> counters;  // rel_rmse, lookups, device_bytes, process_s, mean_to_exact: those it has
  std::string failure;                     // why there are no seconds

  double counter(const std::string& key, double fallback = 0) const;
};

// What the rows were measured on: those of another size, device or lanes are other rows.
struct Results {
  std::string version, device, driver;
  int units = 0, lanes = 0, size = 0;  // cores of the device; pixels a side
  std::vector<Row> rows;

  const Row* find(const std::string& name) const;
};

std::string results_json(const Results& results);
// InputError where the file is none.
Results results_read(const std::filesystem::path& file);

std::string seconds_text(double seconds);  // "4.93 s", "12.3 ms"
std::string share_text(double share);      // "1.20 %"
std::string error_text(double rel_rmse);   // the same; "exact" for 0
std::string rate_text(double per_second);  // "312 M/s"

// In a column of that width, at its right end; of a negative width at its left.
std::string column(const std::string& text, int width);

// Of the table: header, a row, what the columns mean. `width`: of the names.
std::string rows_header(std::size_t width);
std::string row_text(const Row& row, std::size_t width);
std::string rows_legend();

}  // namespace brume::bench
