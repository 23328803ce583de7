// Sequences: which frames there are ("1-60"), and names of files that differ from frame to frame ("tank_%04d.vdb").
#pragma once
#include <string>
#include <vector>

namespace brume {

inline constexpr int FRAME_NONE = -1;  // no sequence: a name that is one of many is a mistake
inline constexpr int FRAME_ANY = -2;   // names stay as they are

// Whether the text holds %d or %0Nd, N from 1 to 9.
bool frame_pattern(const std::string& text);

// The text with the number of the frame in place of each of them, with N digits at least.
std::string frame_name(const std::string& text, int frame);

// "1-60", "1-60:2" (every second), "5", and several of them: "1-9,20"; ascending. InputError, naming the
// option, for anything else.
std::vector<int> frames_parse(const std::string& option, const std::string& text);

// The other way: "frames 1-4, 7", "frame 5"; of more than a few runs the rest by number.
std::string frames_name(const std::vector<int>& frames);

}  // namespace brume
