// See text_lines.hpp.
#include "mesh/text_lines.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>

namespace brume {

namespace {

constexpr std::string_view BYTE_ORDER_MARK = "\xEF\xBB\xBF", BLANKS = " \t\v\f";

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(BLANKS), text.size()));
  return text.substr(0, text.find_last_not_of(BLANKS) + 1);
}

bool blank_at(std::string_view text, std::size_t at) {
  return at >= text.size() || BLANKS.find(text[at]) != std::string_view::npos;
}

}  // namespace

TextLines::TextLines(std::string_view text) : rest_(text) {
  if (rest_.substr(0, BYTE_ORDER_MARK.size()) == BYTE_ORDER_MARK) rest_.remove_prefix(BYTE_ORDER_MARK.size());
}

bool TextLines::next() {
  if (rest_.empty()) return false;
  line_.clear();
  first_ = next_;
  while (!rest_.empty()) {
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    line_ += rest_.substr(0, end);
    rest_.remove_prefix(end);
    rest_.remove_prefix(rest_.substr(0, 2) == "\r\n" ? 2 : std::min<std::size_t>(1, rest_.size()));
    ++next_;
    // In a comment it is the end of a folder's name.
    if (line_.empty() || line_.back() != '\\' || rest_.empty() || line_.find('#') != std::string::npos) break;
    line_.back() = ' ';
  }
  return true;
}

std::string_view word_take(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(BLANKS), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(BLANKS));
  line.remove_prefix(word.size());
  return word;
}

std::string_view name_of(std::string_view rest) {
  for (std::size_t at = rest.find('#'); at != std::string_view::npos; at = rest.find('#', at + 1))
    if ((at == 0 || blank_at(rest, at - 1)) && blank_at(rest, at + 1)) return trimmed(rest.substr(0, at));
  return trimmed(rest);
}

std::string_view name_before_hash(std::string_view name) {
  for (std::size_t at = name.find('#'); at != std::string_view::npos; at = name.find('#', at + 1))
    if (at > 0 && blank_at(name, at - 1)) return trimmed(name.substr(0, at));
  return name;
}

std::string text_lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

std::optional<double> number_of(std::string_view word) {
  if (word.find_first_not_of("+-.0123456789eE") != std::string_view::npos) return {};
  if (word.substr(0, 1) == "+") word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error == std::errc::invalid_argument || end != word.data() + word.size()) return {};
  if (error == std::errc::result_out_of_range) return std::strtod(std::string(word).c_str(), nullptr);
  return value;
}

void LineNotes::add(std::size_t line, const std::string& text, const std::string& kind) {
  const auto [known, is_new] = index_.emplace(kind, rows_.size());
  if (is_new) rows_.push_back({line, 0, text});
  ++rows_[known->second].count;
}

void LineNotes::write(std::vector<std::string>& notes) const {
  for (const Row& row : rows_) {
    const std::string more = row.count > 1 ? " (" + std::to_string(row.count) + " such lines)" : "";
    notes.push_back(file_.string() + ": line " + std::to_string(row.line) + ": " + row.text + more);
  }
}

}  // namespace brume
