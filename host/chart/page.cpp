// See page.hpp.
#include "chart/page.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "base/json_text.hpp"
#include "chart/chart_text.hpp"
#include "chart/pictures.hpp"
#include "chart_texts.hpp"
#include "scene/families.hpp"

namespace brume {

namespace {

using Json = nlohmann::ordered_json;

std::string data_uri(const std::filesystem::path& file) {
  constexpr std::size_t BYTES_MAX = 64 << 20;
  return "data:image/jpeg;base64," +
         base64_text(file_head(file, std::filesystem::file_size(file), BYTES_MAX, "a picture"));
}

// Colours of evenly spaced errors, as CSS knows them.
Json ramp_json() {
  constexpr int STOPS = 11;
  Json ramp = Json::array();
  for (int i = 0; i < STOPS; ++i) {
    const auto color = error_color(ERROR_LO * std::pow(ERROR_HI / ERROR_LO, double(i) / (STOPS - 1)));
    std::string text = "rgb(";
    for (const float value : color) text += (text.size() > 4 ? "," : "") + std::to_string(std::lround(255 * value));
    ramp.push_back(text + ")");
  }
  return ramp;
}

Json pictures_json(const Chart& chart, const ChartFolder& folder) {
  Json json{{"exact", data_uri(folder.file("exact.jpg"))},
            {"ramp", ramp_json()},
            {"ends", {"≤ 0.01 %", "0.1 %", "1 %", "10 %", "100 %"}},
            {"methods", Json::array()}};  // all: each has its own mark
  for (const FamilyRow& row : method_family()) json["methods"].push_back(row.name);
  Json& points = json["points"] = Json::object();
  for (const ChartPoint& p : chart.points)
    points[knobs_id(p.knobs)] = {{"picture", data_uri(folder.picture_file(p.knobs))},
                                 {"error", data_uri(folder.error_file(p.knobs))}};
  return json;
}

// Text of a <script> must not end it.
std::string script_text(std::string text) {
  for (std::size_t at = 0; (at = text.find("</", at)) != std::string::npos; at += 3) text.insert(at + 1, "\\");
  return text;
}

void put(std::string& page, const std::string& mark, const std::string& text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw RuntimeError("chart/page.html: has no " + mark);
  page.replace(at, mark.size(), text);
}

}  // namespace

std::string base64_text(std::string_view bytes) {
  static constexpr char DIGITS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? DIGITS[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string chart_page(const Chart& chart, const ChartFolder& folder) {
  std::string page = PAGE_HTML;
  put(page, "@PICTURES@", script_text(json_line(pictures_json(chart, folder))));
  put(page, "@CHART@", script_text(chart_json(chart)));
  return page;
}

}  // namespace brume
