// json_parse and JsonValue: every class of refusal with its message, ranges, unread keys. Not the scene:
// test_scene_reader.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "base/error.hpp"
#include "base/json_text.hpp"
#include "base/json_value.hpp"
#include "base/text_printable.hpp"
#include "base/typo.hpp"

namespace brume {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// The message of the InputError that `act` throws, or "no error".
std::string error_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

std::string parse_error(std::string_view text) {
  return error_of([&] { json_parse(text, "a.json"); });
}

std::string nested(std::size_t levels) { return std::string(levels, '[') + std::string(levels, ']'); }

TEST(JsonParse, TellsLineAndColumn) {
  EXPECT_THAT(parse_error("{\n  \"a\": 1,\n  \"b\" 2\n}"), StartsWith("a.json: line 3, column 7: syntax error"));
  EXPECT_THAT(parse_error("{\"a\": 1"), HasSubstr("line 1, column 8: syntax error"));
  EXPECT_THAT(parse_error("[1, 2,]"), HasSubstr("line 1, column 7"));
  EXPECT_THAT(parse_error("[NaN]"), HasSubstr("invalid literal"));
  EXPECT_THAT(parse_error("{} {}"), HasSubstr("line 1, column 4"));
}

TEST(JsonParse, RefusesDuplicateKeys) {
  EXPECT_EQ(parse_error("{\"a\": {\"b\": 1,\n  \"b\": 2}}"),
            "a.json: line 2, column 5: the key 'b' stands twice in one object");
  EXPECT_EQ(parse_error(R"([{"b": 1}, {"b": 2, "c": {"b": 3}}])"), "no error");
}

TEST(JsonParse, RefusesNumbersBeyondDouble) {
  EXPECT_THAT(parse_error("[1,\n1e400]"), StartsWith("a.json: line 2, column "));
  EXPECT_THAT(parse_error("[1,\n1e400]"), HasSubstr("number overflow parsing '1e400'"));
  EXPECT_THAT(parse_error("[-1e999]"), HasSubstr("number overflow"));
  EXPECT_EQ(parse_error("[1e-400]"), "no error");
}

TEST(JsonParse, RefusesDeepNesting) {
  EXPECT_EQ(parse_error(nested(64)), "no error");
  EXPECT_EQ(parse_error(nested(65)), "a.json: line 1, column 65: nested deeper than 64 levels");
  EXPECT_THAT(parse_error(std::string(1000000, '[')), HasSubstr("nested deeper than 64 levels"));
}

TEST(JsonParse, RefusesWhatIsNoText) {
  EXPECT_EQ(parse_error(""), "a.json: is empty, expected JSON text");
  EXPECT_EQ(parse_error(" \n\t"), "a.json: is empty, expected JSON text");
  EXPECT_EQ(parse_error(std::string_view("{\0}", 3)),
            "a.json: is not a plain text file (binary or UTF-16), expected JSON text in UTF-8");
  for (const char* text : {"\x89PNG\r\n\x1a\n", "\xff\xfe{}", "[\"\xff\"]", "\x1f\x8b\x08"})
    EXPECT_THAT(parse_error(text), testing::MatchesRegex("a.json: line 1, column [0-9]+: syntax error[ -~]*"));
}

// A quote is of whole characters, and of what is none the bytes.
TEST(JsonParse, QuotesWhatStandsThere) {
  EXPECT_THAT(parse_error("{\"a\": \xC3\xA4}"), HasSubstr("last read: '\"a\": \xC3\xA4'"));
  EXPECT_THAT(parse_error("{\"a\": \xF0\x9F\x8C\xAB}"), HasSubstr("\xF0\x9F\x8C\xAB'"));
  EXPECT_THAT(parse_error("{\"a\": \xE4}"), HasSubstr("\\xE4'"));
  EXPECT_THAT(parse_error("{\"\xC3\xA4\": 1, \"\xC3\xA4\": 2}"), HasSubstr("the key '\xC3\xA4' stands twice"));
}

TEST(TextPrintable, IsOneLineOfUtf8) {
  EXPECT_EQ(text_printable("a\xC3\xA4\xE2\x82\xAC\xF0\x9F\x8C\xAB"), "a\xC3\xA4\xE2\x82\xAC\xF0\x9F\x8C\xAB");
  EXPECT_EQ(text_printable("a\n\x1B[2J\x7F\xC2\x9B"), "a??[2J??");
  // Cut off, out of order, longer than needed, a surrogate, beyond the last.
  EXPECT_EQ(text_printable("\xE4.\xE2\x82"), "\\xE4.\\xE2\\x82");
  EXPECT_EQ(text_printable("\x82 \xC0\xAF \xE0\x80\xAF"), "\\x82 \\xC0\\xAF \\xE0\\x80\\xAF");
  EXPECT_EQ(text_printable("\xED\xA0\x80"), "\\xED\\xA0\\x80");
  EXPECT_EQ(text_printable("\xF4\x90\x80\x80"), "\\xF4\\x90\\x80\\x80");
}

TEST(JsonParse, MessagesStayShort) { EXPECT_LT(parse_error("{\"" + std::string(1 << 20, 'x')).size(), 300u); }

TEST(JsonParse, TakesComments) {
  EXPECT_EQ(json_parse("// one\n{\"a\": /* two */ 1}", "a.json"), nlohmann::json({{"a", 1}}));
  EXPECT_THAT(parse_error("{} /* open"), HasSubstr("line 1, column"));
}

// One value and what is done with it.
struct Access {
  const char* json;
  std::function<void(const JsonValue&)> act;
  const char* error;
};

const Family COLORS{{0, "red", ""}, {1, "blue", ""}};

const Access ACCESSES[] = {
    {"\"red\"", [](auto& v) { v.as_color(Range::at_least_0()); }, R"(expected a number or 3 numbers, got "red")"},
    {"[1, 2]", [](auto& v) { v.as_color(Range::any()); }, "expected a number or 3 numbers, got [1,2]"},
    {"[1, 2, true]", [](auto& v) { v.as_color(Range::any()); }, "/x/2: expected a number, got true"},
    {"[1, -2, 3]", [](auto& v) { v.as_color(Range::at_least_0()); }, "/x/1: expected a number >= 0, got -2"},
    {"1", [](auto& v) { v.as_vec3(Range::any()); }, "expected 3 numbers, got 1"},
    {"null", [](auto& v) { v.as_number(Range::any()); }, "expected a number, got null"},
    {"0", [](auto& v) { v.as_number(Range::positive()); }, "expected a number > 0, got 0"},
    {"-1", [](auto& v) { v.as_number(Range::at_least(0.5)); }, "expected a number >= 0.5, got -1"},
    {"180", [](auto& v) { v.as_number(Range::open(0, 180)); }, "expected a number in (0, 180), got 180"},
    {"179.999999", [](auto& v) { v.as_number(Range::open(0, 180)); },
     "expected a number in (0, 180), got 179.999999, which is 180 in single precision"},
    {"1e-60", [](auto& v) { v.as_number(Range::positive()); },
     "expected a number > 0, got 1e-60, which is 0 in single precision"},
    {"2", [](auto& v) { v.as_number(Range::closed(0, 1)); }, "expected a number in [0, 1], got 2"},
    {"1e300", [](auto& v) { v.as_number(Range::any()); }, "expected a number of at most 3.4e38, got 1e+300"},
    {"1.5", [](auto& v) { v.as_integer(1, 9); }, "expected an integer in [1, 9], got 1.5"},
    {"1e99", [](auto& v) { v.as_integer(1, 9); }, "expected an integer in [1, 9], got 1e+99"},
    {"\"1\"", [](auto& v) { v.as_integer(1, 9); }, R"(expected an integer in [1, 9], got "1")"},
    {"{}", [](auto& v) { v.as_string(); }, "expected a string, got {}"},
    {"\"green\"", [](auto& v) { v.as_member(COLORS, "color"); }, "unknown color 'green'; known: red, blue"},
    {"7", [](auto& v) { v.as_list(); }, "expected a list, got 7"},
    {"7", [](auto& v) { v.has("a"); }, "expected an object, got 7"},
    {"{}", [](auto& v) { v.get("a"); }, "the key 'a' is missing"},
    {R"({"positon": 1})", [](auto& v) { v.get("position"); }, "the key 'position' is missing (it has 'positon')"},
    {R"({"a": "x"})", [](auto& v) { v.number("a", 1, Range::any()); }, R"(/x/a: expected a number, got "x")"},
    {R"({"a/b~": "x"})", [](auto& v) { v.integer("a/b~", 1, 0, 9); }, "/x/a~1b~0: expected an integer in [0, 9]"},
    {R"({"a": 1})", [](auto& v) { v.list("a"); }, "/x/a: expected a list, got 1"},
    {R"({"a": ["b"]})", [](auto& v) { v.list("a")[0].as_number(Range::any()); }, "/x/a/0: expected a number"},
};

TEST(JsonValue, ErrorsNameFilePlaceCauseAndWhatIsAllowed) {
  for (const Access& access : ACCESSES) {
    const nlohmann::json json = json_parse(access.json, "a.json");
    const std::string error = error_of([&] { access.act(JsonValue(json, "a.json", "/x")); });
    EXPECT_THAT(error, StartsWith("a.json: /x")) << access.json;
    EXPECT_THAT(error, HasSubstr(access.error)) << access.json;
  }
}

TEST(JsonValue, MessagesAreOneShortLine) {
  const nlohmann::json json = {{"a\nb\x1b[31m", 1}, {std::string(1 << 20, 'x'), 2}};
  const std::string error = error_of([&] { JsonValue(json, "a.json").refuse_unread(); });
  EXPECT_EQ(error, "a.json: /: unknown key 'a?b?[31m'; known: ");
  for (int cut = 0; cut < 3; ++cut) {  // wherever the cut falls, it falls between characters
    const nlohmann::json value = std::string(54 + cut, 'x') + "ääää";
    const std::string line = error_of([&] { JsonValue(value, "a.json").as_list(); });
    EXPECT_LT(line.size(), 100u);
    EXPECT_NO_THROW(nlohmann::json(line).dump()) << "not UTF-8";
  }
}

TEST(JsonValue, RootIsASlash) {
  const nlohmann::json json = 1;
  EXPECT_EQ(error_of([&] { JsonValue(json, "a.json").expect_object(); }), "a.json: /: expected an object, got 1");
}

TEST(JsonValue, DefaultsStandForAbsentKeys) {
  const nlohmann::json json = json_parse(R"({"n": 2, "v": [1, 2, 3], "c": 4})", "a.json");
  const JsonValue v(json, "a.json");
  EXPECT_EQ(v.number("n", 7, Range::any()), 2);
  EXPECT_EQ(v.number("absent", 7, Range::closed(0, 1)), 7);
  EXPECT_EQ(v.integer("n", 7, 0, 9), 2);
  EXPECT_EQ(v.vec3("v", glm::dvec3(0)), glm::dvec3(1, 2, 3));
  EXPECT_EQ(v.color("c", glm::dvec3(0), Range::any()), glm::dvec3(4));
  EXPECT_EQ(v.member("m", 1, COLORS, "color"), 1);
  EXPECT_TRUE(v.list("l").empty());
  EXPECT_NO_THROW(v.refuse_unread());
}

TEST(JsonValue, UnreadKeysAreRefused) {
  const nlohmann::json json = json_parse(R"({"size": 1, "sise": 2, "elephant": 3})", "a.json");
  const JsonValue v(json, "a.json", "/film");
  v.has("elephant");
  v.integer("size", 0, 0, 9);
  EXPECT_EQ(error_of([&] { v.refuse_unread(); }),
            "a.json: /film: unknown key 'sise' (did you mean 'size'?); known: elephant, size");
  v.has("sise");
  EXPECT_NO_THROW(v.refuse_unread());
}

TEST(Range, OpenEndsAreComparedInFloat) {
  EXPECT_TRUE(Range::open(-1, 1).holds(0.999999));
  EXPECT_FALSE(Range::open(-1, 1).holds(0.9999999999));  // 1 as a float
  EXPECT_FALSE(Range::positive().holds(1e-60));          // 0 as a float
  EXPECT_TRUE(Range::positive().holds(1e-30));
  EXPECT_TRUE(Range::at_least(1e-6).holds(1e-6));  // a closed end is in, whatever float makes of it
  EXPECT_FALSE(Range::at_least_0().holds(-1e-300));
  EXPECT_TRUE(Range::any().holds(std::numeric_limits<float>::max()));
}

TEST(Typo, NearestKey) {
  const std::vector<std::string> keys{"size", "spp", "exposure", "u", "up"};
  EXPECT_EQ(key_nearest("sise", keys), "size");
  EXPECT_EQ(key_nearest("exposition", keys), "");
  EXPECT_EQ(key_nearest("esposur", keys), "exposure");
  EXPECT_EQ(key_nearest("v", keys), "");  // another letter is no typo of a name of one letter
  EXPECT_EQ(key_nearest(std::string(1 << 20, 's'), keys), "");
}

TEST(JsonText, ShortThingsStandOnOneLine) {
  const nlohmann::ordered_json json = {{"b", {1, 2.5, "x[1, 2]"}},
                                       {"a", {{"long", std::string(60, 'y')}, {"more", std::string(60, 'z')}}}};
  const std::string text = json_text(json);
  EXPECT_THAT(text, StartsWith("{\n  \"b\": [1, 2.5, \"x[1, 2]\"],\n  \"a\": {\n    \"long\": \"yy"));
  EXPECT_EQ(nlohmann::ordered_json::parse(text), json);
}

}  // namespace
}  // namespace brume
