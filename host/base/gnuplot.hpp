// Plots: gnuplot draws them, because it knows logarithmic axes, keys and fonts of vector and pixel files alike, is one
// small package, and is told what to draw by a text.
#pragma once
#include <filesystem>
#include <string>

namespace brume {

// The text as a string of gnuplot's, without control characters.
std::string gnuplot_quoted(const std::string& text);

// Both files from one script, which is handed their quoted temporary names as svg_file and png_file before `script`.
// False where there is no gnuplot; RuntimeError where it fails.
bool gnuplot_draw(const std::filesystem::path& svg, const std::filesystem::path& png, const std::string& script);

}  // namespace brume
