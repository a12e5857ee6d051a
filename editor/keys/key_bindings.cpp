#include "editor/keys/key_bindings.h"

#include <algorithm>
#include <set>

#include <nlohmann/json.hpp>

#include "renderer/base/json_text.h"

namespace lamplighter {

namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kLongest = 200;

std::string excerpt(const std::string& text) {
  std::string out = Json(text).dump(-1, ' ', true, Json::error_handler_t::replace);
  return out.size() > 60 ? out.substr(0, 57) + "..." : out;
}

// The action, other than `text`, that has one of these keys; "" if there is none.
std::string ownerOf(const KeyMap& keys, const Chord& chord, const std::string& text) {
  for (const auto& [owner, chords] : keys) {
    if (owner != text && std::find(chords.begin(), chords.end(), chord) != chords.end())
      return owner;
  }
  return "";
}

}  // namespace

KeyList parseKeys(std::string_view text, std::vector<std::string>& problems) {
  KeyList out;
  const Json j = parseJson<Json>(text);
  if (!j.is_object()) {
    problems.emplace_back("is not a JSON object of actions and keys; the default keys are used");
    return out;
  }
  for (const auto& [action, chord] : j.items()) {
    if (!chord.is_string() || action.size() > kLongest) {
      problems.push_back(excerpt(action) + ": its key is not a string; it is ignored");
    } else if (!parseChords(chord.get<std::string>())) {
      problems.push_back(excerpt(action) + ": " + excerpt(chord.get<std::string>()) +
                         " is not a key; write it as Ctrl+Shift+Z or F6");
    } else {
      out.emplace_back(action, chord.get<std::string>());
    }
  }
  return out;
}

KeyMap resolveKeys(const ActionRegistry& registry, const KeyList& preset, const KeyList& file,
                   std::vector<std::string>& problems) {
  KeyMap keys = registry.defaultKeys();
  const auto bind = [&](const std::string& text, const std::vector<Chord>& chords) {
    for (auto& [owner, theirs] : keys) {
      std::erase_if(theirs, [&](const Chord& c) {
        return std::find(chords.begin(), chords.end(), c) != chords.end();
      });
    }
    keys[text] = chords;
  };
  for (const auto& [text, chord] : preset)
    if (const auto chords = parseChords(chord)) bind(text, *chords);

  std::set<std::string> ofFile;
  for (const auto& [text, chord] : file) ofFile.insert(text);
  std::vector<std::string> bound;  // bound by the file so far
  for (const auto& entry : file) {
    const std::string& text = entry.first;
    if (registry.find(text.substr(0, text.find(' '))) == nullptr) {
      problems.push_back(excerpt(text) +
                         ": there is no such action; docs/reference/actions.md lists them");
      continue;
    }
    std::vector<Chord> chords = parseChords(entry.second).value_or(std::vector<Chord>());
    std::erase_if(chords, [&](const Chord& c) {
      const std::string owner = ownerOf(keys, c, text);
      if (owner.empty()) return false;
      if (std::find(bound.begin(), bound.end(), owner) != bound.end()) {
        problems.push_back(excerpt(text) + ": " + chordText(c) + " is already the key of " +
                           excerpt(owner) + "; give one of them another key");
        return true;
      }
      if (!ofFile.contains(owner) && keys.at(owner).size() == 1)
        problems.push_back(excerpt(text) + ": takes " + chordText(c) + " from " + excerpt(owner) +
                           ", which has no key now");
      return false;
    });
    bind(text, chords);
    bound.push_back(text);
  }
  return keys;
}

}  // namespace lamplighter
