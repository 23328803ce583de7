// See text_printable.hpp. UTF-8 as RFC 3629 has it: no surrogates, nothing beyond U+10FFFF, no longer forms than
// needed.
#include "base/text_printable.hpp"

#include <cstddef>
#include <cstdint>

namespace brume {

namespace {

// Bytes of the character that `text` begins with; 0 where it is none.
std::size_t character_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return 1;
  const std::size_t size = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < size) return 0;
  std::uint32_t code = byte(0) & (0xFFu >> (size + 1));
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  constexpr std::uint32_t SMALLEST[] = {0, 0, 0x80, 0x800, 0x10000};
  return code < SMALLEST[size] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000) ? 0 : size;
}

std::string byte_text(unsigned char byte) {
  constexpr char DIGITS[] = "0123456789ABCDEF";
  return {'\\', 'x', DIGITS[byte >> 4], DIGITS[byte & 15]};
}

}  // namespace

std::string text_printable(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const auto first = static_cast<unsigned char>(text[0]);
    const bool control = first < ' ' || first == 0x7F || (size == 2 && first == 0xC2 && (text[1] & 0xE0) == 0x80);
    out += size == 0 ? byte_text(first) : control ? "?" : std::string(text.substr(0, size));
    text.remove_prefix(size == 0 ? 1 : size);
  }
  return out;
}

}  // namespace brume
