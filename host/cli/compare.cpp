// brume compare: how far two images are apart.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/out_of_memory.hpp"
#include "cli/command.hpp"
#include "cli/output_files.hpp"
#include "film/film_compare.hpp"

namespace brume {

namespace {

struct CompareArguments {
  std::filesystem::path a, b, difference;
  std::string layer;
  bool json = false;
  double fail_above = -1;
};

nlohmann::ordered_json compare_json(const CompareResult& r) {
  return {{"width", r.width},
          {"height", r.height},
          {"channels", r.channels},
          {"values", r.on_display ? "display" : "linear"},
          {"rmse", r.rmse},
          {"rel_rmse", r.rel_rmse},
          {"max_abs", r.max_abs},
          {"max_at", {r.max_x, r.max_y, r.max_channel}},
          {"display_p99", r.display_p99},
          {"display_rmse", r.display_rmse},
          {"mean_a", r.mean_a},
          {"mean_b", r.mean_b},
          {"different_pixels", r.different},
          {"nan", r.nan}};
}

int compare_run(const CompareArguments& arguments) {
  output_files_check({{"-o", arguments.difference}}, {{"the image", arguments.a}, {"the reference", arguments.b}});
  if (!arguments.difference.empty()) image_check_writable(arguments.difference);
  const auto read = [](const std::filesystem::path& file) {
    return with_memory(file.string(), [&] { return image_read(file); });
  };
  const Image a = read(arguments.a), b = read(arguments.b);
  const CompareResult result =
      with_memory(arguments.a.string() + ": comparing it", [&] { return image_compare(a, b, arguments.layer); });
  const nlohmann::ordered_json json = compare_json(result);
  if (arguments.json) {
    std::printf("%s\n", json.dump(2).c_str());
  } else {
    for (const auto& [name, value] : json.items()) std::printf("%-17s %s\n", name.c_str(), value.dump().c_str());
  }
  if (!arguments.difference.empty()) {
    const Image difference = image_difference(a, b, arguments.layer);
    image_write_display(arguments.difference, difference.width, difference.height, difference.values);
  }
  const bool fails = arguments.fail_above >= 0 && (!(result.rel_rmse <= arguments.fail_above) || result.nan > 0);
  return fails ? 1 : 0;
}

}  // namespace

void command_compare(CLI::App& app, Command& run) {
  CLI::App* command = app.add_subcommand("compare", "Compare image A with the reference B");
  auto arguments = std::make_shared<CompareArguments>();
  command->add_option("a", arguments->a, "Image")->required();
  command->add_option("b", arguments->b, "Reference image")->required();
  command->add_option("-o,--output", arguments->difference,
                      "Write the absolute difference, scaled to its maximum (.png, .jpg)");
  command->add_option("--layer", arguments->layer, "Compare this EXR layer instead of R, G, B");
  command->add_flag("--json", arguments->json, "Print JSON");
  command->add_option("--fail-above", arguments->fail_above, "Exit 1 when rel_rmse is above this, or anything is NaN")
      ->check(CLI::NonNegativeNumber);
  command->callback([arguments, &run] { run = [arguments] { return compare_run(*arguments); }; });
}

}  // namespace brume
