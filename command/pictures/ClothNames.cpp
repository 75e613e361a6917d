// SPDX-License-Identifier: Zlib
#include "command/pictures/ClothNames.h"

#include <set>

namespace pictures {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isAllowed(char c) { return isDigit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::string identifier(std::string name) {
  for (char& c : name) {
    if (!isAllowed(c)) c = '_';
  }
  if (name.empty()) return "cloth";
  return isDigit(name[0]) ? "_" + name : name;
}

std::string lowerCase(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return name;
}

}  // namespace

std::vector<std::string> uniqueNames(const std::vector<std::string>& names) {
  std::vector<std::string> unique;
  std::set<std::string> taken;
  for (const std::string& name : names) {
    const std::string wanted = identifier(name);
    std::string given = wanted;
    for (int i = 2; !taken.insert(lowerCase(given)).second; ++i) given = wanted + "_" + std::to_string(i);
    unique.push_back(given);
  }
  return unique;
}

std::vector<std::string> clothNames(const FrameSequence& sequence) {
  std::vector<std::string> names;
  for (const ClothShape& cloth : sequence.cloths) names.push_back(cloth.name);
  return uniqueNames(names);
}

std::string onOneLine(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = ' ';
  }
  return text;
}

}  // namespace pictures
