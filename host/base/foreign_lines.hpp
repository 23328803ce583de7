// What libraries print to stderr by themselves, so that it goes through brume's messages: warnings, and a driver's last
// words before it ends the process.
#pragma once
#include <string>
#include <vector>

namespace brume {

// While one lives, what is written to descriptor 2 is kept; brume's own lines go around it by message_write. Not for
// two threads at once; one inside another does nothing.
class ForeignLines {
 public:
  explicit ForeignLines(const char* who);  // "the OpenCL driver"
  ~ForeignLines();                         // tells what was not taken
  ForeignLines(const ForeignLines&) = delete;
  ForeignLines& operator=(const ForeignLines&) = delete;

  // What was printed, "<who>: <line>", each line once. Descriptor 2 is stderr again.
  std::vector<std::string> take();

 private:
  std::string who_;
  bool active_ = false;
};

// "brume: note: <text>", unless notes are muted, as ForeignLines are then.
void note_write(const std::string& text);
void notes_mute();

// To stderr, past any ForeignLines. Safe in a signal handler, as is telling what is kept.
void message_write(const char* text);
void foreign_lines_tell();
void stderr_restore();  // before exec

}  // namespace brume
