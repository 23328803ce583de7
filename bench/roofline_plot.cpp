// roofline.svg and roofline.png, drawn by gnuplot as charts are.
#include "base/gnuplot.hpp"
#include "base/number_text.hpp"
#include "roofline.hpp"
#include "roofline_texts.hpp"

namespace brume::bench {

bool roofline_plot(const std::string& device, const std::vector<RooflineRow>& rows, const std::filesystem::path& svg,
                   const std::filesystem::path& png) {
  std::string data, limits;
  for (const RooflineRow& row : rows) {
    const std::string text = rate_text(row.rate);
    if (row.row.name.rfind("limit/", 0) == 0)
      limits += (limits.empty() ? "" : ", ") + row.row.name.substr(6) + " " + text;
    else
      data += "\"" + row.row.name + "\" " + number_text(row.row.counter("share")) + " \"" + row.limit + "\" \"" + text +
              "\"\n";
  }
  return gnuplot_draw(svg, png,
                      "plot_title = " + gnuplot_quoted(device + ": " + limits) + "\n$rows << EOD\n" + data + "EOD\n" +
                          ROOFLINE_GNUPLOT);
}

}  // namespace brume::bench
