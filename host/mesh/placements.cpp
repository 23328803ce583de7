// See placements.hpp.
#include "mesh/placements.hpp"

#include <cmath>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/file_read.hpp"
#include "mesh/text_lines.hpp"

namespace brume {

namespace {

constexpr std::size_t BYTES_MAX = std::size_t(1) << 30;
constexpr double NUMBER_MAX = 1e38;
constexpr int NUMBERS = 12;

class Reader {
 public:
  explicit Reader(const std::filesystem::path& file) : file_(file) {}

  std::vector<MeshPlacement> run() {
    const std::string text = file_read_text(file_, BYTES_MAX, "a file of instances");
    TextLines lines(text);
    while (lines.next()) {
      line_ = lines.number();
      std::string_view rest = std::string_view(lines.line()).substr(0, lines.line().find('#'));
      if (std::string_view ahead = rest; !word_take(ahead).empty()) placements_.push_back(matrix(rest));
      if (placements_.size() > PLACEMENTS_MAX)
        fail("is more than the " + std::to_string(PLACEMENTS_MAX) + "th instance");
    }
    if (placements_.empty())
      throw InputError(file_.string() + ": holds no instance: expected 12 numbers a line, the rows of a 3x4 matrix");
    return std::move(placements_);
  }

 private:
  [[noreturn]] void fail(const std::string& cause) const {
    throw InputError(file_.string() + ": line " + std::to_string(line_) + ": " + cause);
  }

  MeshPlacement matrix(std::string_view rest) const {
    MeshPlacement m(0);
    int count = 0;
    for (std::string_view word = word_take(rest); !word.empty(); word = word_take(rest), ++count) {
      const std::optional<double> number = number_of(word);
      if (!number || !(std::abs(*number) <= NUMBER_MAX))
        fail("'" + std::string(word.substr(0, 40)) + "' is no number up to 1e38");
      if (count < NUMBERS) m[count % 4][count / 4] = *number;
    }
    if (count != NUMBERS) fail("expected 12 numbers, the rows of a 3x4 matrix, got " + std::to_string(count));
    if (!placement_keeps_volume(m))
      fail("instance " + std::to_string(placements_.size()) + ": the transform is singular, it leaves no volume");
    return m;
  }

  std::filesystem::path file_;
  std::size_t line_ = 0;
  std::vector<MeshPlacement> placements_;
};

}  // namespace

std::vector<MeshPlacement> placements_read(const std::filesystem::path& file) { return Reader(file).run(); }

}  // namespace brume
