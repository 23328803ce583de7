// See gnuplot.hpp.
#include "base/gnuplot.hpp"

#include "base/atomic_file.hpp"
#include "base/command_line.hpp"
#include "base/error.hpp"
#include "base/text_printable.hpp"

namespace brume {

std::string gnuplot_quoted(const std::string& text) {
  std::string word = "'";
  for (const char c : text_printable(text)) word += c == '\'' ? "''" : std::string(1, c);
  return word + "'";
}

bool gnuplot_draw(const std::filesystem::path& svg, const std::filesystem::path& png, const std::string& script) {
  if (!command_succeeds("command -v gnuplot >/dev/null")) return false;
  AtomicFile svg_file(svg), png_file(png);
  AtomicFile script_file(std::filesystem::path(svg).replace_extension(".gnuplot"));  // not committed: it goes again
  script_file.write("svg_file = " + gnuplot_quoted(svg_file.temporary().string()) +
                    "\npng_file = " + gnuplot_quoted(png_file.temporary().string()) + "\n" + script);
  if (!command_succeeds("gnuplot " + shell_quoted(script_file.temporary().string()) + " >/dev/null 2>&1"))
    throw RuntimeError(svg.string() + ": gnuplot could not draw it");
  svg_file.commit();
  png_file.commit();
  return true;
}

}  // namespace brume
