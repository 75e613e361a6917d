// SPDX-License-Identifier: Zlib
#include "command/scene/JsonCursor.h"

#include "command/cli/Errors.h"
#include "command/cli/NearestWord.h"
#include "command/cli/TextFile.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace command {
namespace {

std::string escapedKey(const std::string& key) {
  std::string text;
  for (const char character : key) {
    if (character == '~') {
      text += "~0";
    } else if (character == '/') {
      text += "~1";
    } else {
      text += character;
    }
  }
  return text;
}

std::string shown(const Json& value) {
  constexpr std::size_t longest = 60;
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return shortened(text, longest);
}

std::string place(const std::string& text, std::size_t offset) {
  offset = std::min(offset, text.size());
  const auto begin = text.begin();
  const auto end = begin + static_cast<std::ptrdiff_t>(offset);
  const auto line = 1 + std::count(begin, end, '\n');
  const std::size_t lineBreak = offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
  const std::size_t column = lineBreak == std::string::npos ? offset + 1 : offset - lineBreak;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

/// Without the library's own prefix and place: "[json.exception...] parse error at line 1, column 2: ".
std::string reasonOf(const nlohmann::json::parse_error& error) {
  const std::string text = error.what();
  const std::size_t start = text.find(": ");
  return start == std::string::npos ? text : text.substr(start + 2);
}

/// Deeper ones would take the stack of what goes through them.
constexpr int deepest = 100;

/// JSON allows a key twice and keeps the last: in a scene that is a slip, and a silent one.
class Refusals {
 public:
  bool operator()(int depth, Json::parse_event_t event, Json& parsed) {
    if (depth > deepest) throw std::invalid_argument("is nested deeper than 100 times");
    if (event == Json::parse_event_t::object_start) m_open.emplace_back();
    if (event == Json::parse_event_t::object_end) m_open.pop_back();
    if (event == Json::parse_event_t::key && !m_open.back().insert(parsed.get<std::string>()).second) {
      throw std::invalid_argument("the key " + parsed.dump() + " is there twice in one object");
    }
    return true;
  }

 private:
  std::vector<std::set<std::string>> m_open;
};

}  // namespace

Json loadJson(const std::string& file) {
  try {
    const std::string text = readTextFile(file);
    try {
      return Json::parse(text, Refusals());
    } catch (const Json::parse_error& error) {
      const std::size_t offset = error.byte == 0 ? 0 : error.byte - 1;
      throw std::invalid_argument("is not JSON: " + place(text, offset) + ": " + reasonOf(error));
    } catch (const Json::out_of_range& error) {  // a number such as 1e999
      const std::string reason = error.what();
      throw std::invalid_argument("has a number that is not finite: " + reason.substr(reason.rfind(' ') + 1));
    }
  } catch (const std::invalid_argument& error) {
    throw InputError(onOneLine(file + ": " + error.what()));
  }
}

void JsonCursor::expectObject(const KeyTable& keys) {
  if (!isObject()) reject("an object with keys among " + joined(keys.keys));
  for (const auto& [key, value] : m_value->items()) {
    if (std::find(keys.keys.begin(), keys.keys.end(), key) != keys.keys.end()) continue;
    JsonCursor(value, m_file, m_pointer + "/" + escapedKey(key))
        .complain("unknown key; " + didYouMean(key, keys.keys) + "allowed here: " + joined(keys.keys));
  }
  m_keys = &keys;
}

std::optional<JsonCursor> JsonCursor::find(const std::string& key) const {
  if (m_keys == nullptr || std::find(m_keys->keys.begin(), m_keys->keys.end(), key) == m_keys->keys.end()) {
    throw std::logic_error("the key " + key + " is read but is not in the table of keys");
  }
  const auto found = m_value->find(key);
  if (found == m_value->end()) return std::nullopt;
  return JsonCursor(*found, m_file, m_pointer + "/" + escapedKey(key));
}

JsonCursor JsonCursor::at(const std::string& key) const {
  const std::optional<JsonCursor> found = find(key);
  if (!found) complain("the key \"" + key + "\" is missing");
  return *found;
}

std::string JsonCursor::exactlyOneOf(const std::vector<std::string>& keys) const {
  std::vector<std::string> present;
  for (const std::string& key : keys) {
    if (find(key)) present.push_back(key);
  }
  if (present.size() != 1) {
    complain("must have exactly one of the keys " + joined(keys) + ", has " +
             (present.empty() ? "none" : joined(present)));
  }
  return present.front();
}

std::vector<JsonCursor> JsonCursor::elements() const {
  if (!isArray()) reject("an array");
  std::vector<JsonCursor> elements;
  for (std::size_t i = 0; i < m_value->size(); ++i) {
    elements.emplace_back((*m_value)[i], m_file, m_pointer + "/" + std::to_string(i));
  }
  return elements;
}

double JsonCursor::number(const Range& range) const {
  if (!m_value->is_number()) reject(std::string("a number, ") + range.text);
  const double value = m_value->get<double>();
  if (!range.contains(value)) reject(range.text);
  return value;
}

int JsonCursor::integer(int low, int high) const {
  const std::string allowed = "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  if (!m_value->is_number()) reject(allowed);
  const double value = m_value->get<double>();  // 4.0 is a whole number too
  if (!(value >= low && value <= high) || value != std::floor(value)) reject(allowed);
  return static_cast<int>(value);
}

bool JsonCursor::boolean() const {
  if (!m_value->is_boolean()) reject("true or false");
  return m_value->get<bool>();
}

std::string JsonCursor::text() const {
  if (!m_value->is_string()) reject("a string");
  return m_value->get<std::string>();
}

std::array<double, 3> JsonCursor::triple(const Range& range) const {
  if (!isArray() || m_value->size() != 3) reject("an array of three numbers");
  const std::vector<JsonCursor> parts = elements();
  return {parts[0].number(range), parts[1].number(range), parts[2].number(range)};
}

std::size_t JsonCursor::indexOf(const std::string& word, const std::vector<std::string>& names) const {
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end()) complain(didYouMean(word, names) + "must be one of " + joined(names));
  return static_cast<std::size_t>(found - names.begin());
}

void JsonCursor::reject(const std::string& allowed) const { complain("must be " + allowed); }

void JsonCursor::complain(const std::string& complaint) const {
  constexpr std::size_t longest = 300;
  const std::string where = m_pointer.empty() ? "/" : shortened(m_pointer, longest);
  throw InputError(onOneLine(m_file + ": " + where + " = " + shown(*m_value) + ": " + complaint));
}

}  // namespace command
