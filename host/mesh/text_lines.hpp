// The lines of OBJ and MTL files, their words and numbers, and what a user is told about lines that are not read.
#pragma once
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace brume {

// Lines of a text, numbered from 1 as the file has them: a byte order mark is skipped, those that "\" continues (but no
// comment) are one line.
class TextLines {
 public:
  explicit TextLines(std::string_view text);
  bool next();  // false at the end
  const std::string& line() const { return line_; }
  std::size_t number() const { return first_; }

 private:
  std::string_view rest_;
  std::string line_;
  std::size_t first_ = 0, next_ = 1;
};

// Takes the next word off the line; empty at its end.
std::string_view word_take(std::string_view& line);

// A name or path that fills the rest of a line: blanks within are part of it, those about it and a comment (" # ...")
// are not.
std::string_view name_of(std::string_view rest);
// The same where "#" begins a comment without a blank behind it: "m #old" is m. Where name_of() finds nothing.
std::string_view name_before_hash(std::string_view name);

std::string text_lower(std::string_view text);

// A decimal number, infinite where it is beyond double; none for any other word, "nan" and "0,2" among them.
std::optional<double> number_of(std::string_view word);

// What is told about the lines of one file: one note for each kind, with the first line of it and how many there are.
class LineNotes {
 public:
  explicit LineNotes(std::filesystem::path file) : file_(std::move(file)) {}
  // `text` of the first line of its `kind` is what is printed.
  void add(std::size_t line, const std::string& text, const std::string& kind);
  void add(std::size_t line, const std::string& text) { add(line, text, text); }
  void write(std::vector<std::string>& notes) const;  // in the order of the lines that came first

 private:
  struct Row {
    std::size_t line, count;
    std::string text;
  };
  std::filesystem::path file_;
  std::vector<Row> rows_;
  std::map<std::string, std::size_t> index_;
};

}  // namespace brume
