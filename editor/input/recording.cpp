#include "editor/input/recording.h"

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <set>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "editor/document/write_file.h"
#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/base/json_text.h"
#include "renderer/registry/registry.h"

namespace lamplighter {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kRecordingFormat = 1;
// two days at 60 frames per second; a higher number is an error
constexpr int64_t kMostFrames = 10'000'000;

// Writes floats with the fewest digits that restore the same value.
Json numbers(std::initializer_list<float> values) {
  Json j = Json::array();
  for (const float v : values) j.push_back(std::stod(fmt::format("{}", v)));
  return j;
}

std::string text(const Json& j) { return j.dump(-1, ' ', false, Json::error_handler_t::replace); }

// Reads fields of a line and checks their type and range. `usual` is the value if the field is
// missing.
const Json& fieldOf(const Json& j, const char* name) {
  const auto it = j.find(name);
  if (it == j.end()) throw std::invalid_argument(fmt::format("lacks \"{}\"", name));
  return *it;
}

std::string stringOf(const Json& j, const char* name) {
  const Json& field = fieldOf(j, name);
  if (!field.is_string()) throw std::invalid_argument(fmt::format("\"{}\" is not a string", name));
  return field.get<std::string>();
}

std::string stringOf(const Json& j, const char* name, const std::string& usual) {
  return j.contains(name) ? stringOf(j, name) : usual;
}

bool boolOf(const Json& j, const char* name) {
  const Json& field = fieldOf(j, name);
  if (!field.is_boolean())
    throw std::invalid_argument(fmt::format("\"{}\" is neither true nor false", name));
  return field.get<bool>();
}

int64_t integerOf(const Json& j, const char* name, int64_t least, int64_t most) {
  const Json& field = fieldOf(j, name);
  // Unsigned first, because values beyond int64 would wrap.
  const bool fits =
      field.is_number_integer() &&
      (!field.is_number_unsigned() || field.get<uint64_t>() <= static_cast<uint64_t>(most)) &&
      field.get<int64_t>() >= least && field.get<int64_t>() <= most;
  if (!fits) {
    throw std::invalid_argument(
        fmt::format("\"{}\" is not a whole number from {} to {}", name, least, most));
  }
  return field.get<int64_t>();
}

float floatOf(const Json& value, const char* name) {
  const double v = value.is_number() ? value.get<double>() : std::nan("");
  if (!(std::abs(v) <= std::numeric_limits<float>::max()))
    throw std::invalid_argument(fmt::format("\"{}\" contains something other than numbers", name));
  return static_cast<float>(v);
}

float floatOf(const Json& j, const char* name, float usual) {
  return j.contains(name) ? floatOf(j[name], name) : usual;
}

vec2 pairOf(const Json& j, const char* name) {
  const Json& field = fieldOf(j, name);
  if (!field.is_array() || field.size() != 2)
    throw std::invalid_argument(fmt::format("\"{}\" is not a pair of numbers", name));
  return {floatOf(field[0], name), floatOf(field[1], name)};
}

// Values keep their type: the declaration decides whether a JSON number is int or float. A
// parameter may belong to another method, if it was set before this one was chosen.
ParameterValue valueOf(const std::string& method, const std::string& name, const Json& j) {
  const std::string given = j.is_string() ? j.get<std::string>() : j.dump();
  const auto from = [&](const MethodInfo& info) -> std::optional<ParameterValue> {
    const ParameterSpec* spec = findParameter(info.parameters, name);
    return spec ? std::optional(Settings::parse(*spec, given)) : std::nullopt;
  };
  if (const auto own = from(findMethod(method))) return *own;
  for (const MethodInfo& other : methods()) {
    if (const auto value = from(other)) return *value;
  }
  throw std::invalid_argument("'" + name + "' is not a parameter of any method");
}

RecordingHeader headerOf(const Json& j) {
  if (!j.contains("lamplighter")) throw std::invalid_argument("is not the header of a recording");
  if (j["lamplighter"] != kRecordingFormat)
    throw std::invalid_argument("has another format version");
  RecordingHeader h;
  h.scene = stringOf(j, "scene", "");
  h.sceneHash = stringOf(j, "sceneHash", "");
  h.left = stringOf(j, "left", "");
  if (h.left.find_first_of("/\\") != std::string::npos || h.left.starts_with('.'))
    throw std::invalid_argument("\"left\" is not the name of a folder beside the recording");
  if (j.contains("window")) {
    const Json& window = j["window"];
    if (!window.is_array() || window.size() != 2)
      throw std::invalid_argument("\"window\" is not a pair of numbers");
    const Json size{{"width", window[0]}, {"height", window[1]}};
    h.width = static_cast<int>(integerOf(size, "width", 1, 16384));
    h.height = static_cast<int>(integerOf(size, "height", 1, 16384));
  }
  if (j.contains("fps")) h.framesPerSecond = static_cast<int>(integerOf(j, "fps", 1, 100000));
  h.render.method = findMethod(stringOf(j, "method", h.render.method)).name;
  h.render.exposureEv = floatOf(j, "exposure", 0.0f);
  if (j.contains("settings")) {
    if (!j["settings"].is_object()) throw std::invalid_argument("\"settings\" is not an object");
    for (const auto& [name, value] : j["settings"].items())
      h.render.values.set(name, valueOf(h.render.method, name, value));
  }
  return h;
}

InputEvent eventOf(const Json& j) {
  InputEvent e;
  if (j.contains("pointer")) {
    e.kind = EventKind::pointer;
    e.position = pairOf(j, "pointer");
    e.target = stringOf(j, "on", "");
  } else if (j.contains("button")) {
    e.kind = EventKind::button;
    e.button = static_cast<int>(integerOf(j, "button", 0, 2));
    e.down = boolOf(j, "down");
  } else if (j.contains("wheel")) {
    e.kind = EventKind::wheel;
    e.wheel = pairOf(j, "wheel");
  } else if (j.contains("key")) {
    e.kind = EventKind::key;
    e.key = keyOf(stringOf(j, "key"));
    e.down = boolOf(j, "down");
    if (e.key == Key::none) throw std::invalid_argument("names no known key");
  } else if (j.contains("text")) {
    e.kind = EventKind::text;
    e.text = stringOf(j, "text");
  } else if (j.contains("action")) {
    e.kind = EventKind::action;
    e.text = stringOf(j, "action");
  } else {
    throw std::invalid_argument("is neither an event nor a checkpoint");
  }
  return e;
}

Checkpoint checkpointOf(const Json& j) {
  Checkpoint c;
  c.name = stringOf(j, "check");
  c.document = stringOf(j, "document", "");
  if (j.contains("image")) c.image = boolOf(j, "image");
  c.sameAs = stringOf(j, "sameAs", "");
  c.max = floatOf(j, "max", c.max);
  c.mean = floatOf(j, "mean", c.mean);
  if (c.max < 0.0f || c.mean < 0.0f) throw std::invalid_argument("has a tolerance below 0");
  if (c.name.empty() || c.name.find_first_of("/\\") != std::string::npos)
    throw std::invalid_argument("has no usable name");
  return c;
}

}  // namespace

std::filesystem::path Recording::beside(const std::string& name) const {
  if (name.empty()) return {};
  return (path.has_parent_path() ? path.parent_path() : std::filesystem::path(".")) / name;
}

std::filesystem::path Recording::scenePath() const { return beside(header.scene); }

std::filesystem::path Recording::leftPath() const { return beside(header.left); }

std::filesystem::path Recording::baselineOf(const Checkpoint& checkpoint) const {
  std::filesystem::path p = path;
  return p.replace_filename(path.stem().string() + "." + checkpoint.name + ".png");
}

Recording readRecording(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path.string(), "cannot be read", "name a recording (.jsonl)");
  Recording r;
  r.path = path;
  int number = 0;
  bool hasHeader = false;
  std::set<std::string> checks;  // their names are also the names of the baselines
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) continue;
    try {
      const Json j = parseJson<Json>(line);
      if (!j.is_object()) throw std::invalid_argument("is not a JSON object");
      if (!hasHeader) {
        r.header = headerOf(j);
        hasHeader = true;
        continue;
      }
      RecordingLine l;
      l.frame = static_cast<uint32_t>(integerOf(j, "f", 0, kMostFrames));
      if (!r.lines.empty() && l.frame < r.lines.back().frame)
        throw std::invalid_argument("has a frame number below the previous one");
      if (j.contains("check")) {
        Checkpoint c = checkpointOf(j);
        if (!checks.insert(c.name).second)
          throw std::invalid_argument("has the checkpoint name of an earlier line");
        l.what = std::move(c);
      } else {
        l.what = eventOf(j);
      }
      r.lines.push_back(std::move(l));
    } catch (const std::exception& e) {
      throw InputError(fmt::format("{}:{}", path.string(), number), e.what(),
                       "correct the line; editor/input/recording.h has the format");
    }
  }
  if (!hasHeader) throw InputError(path.string(), "is empty", "record one with --record");
  return r;
}

std::string headerText(const RecordingHeader& h) {
  Json j{{"lamplighter", kRecordingFormat}, {"scene", h.scene}};
  if (!h.sceneHash.empty()) j["sceneHash"] = h.sceneHash;
  if (!h.left.empty()) j["left"] = h.left;
  j["window"] = {h.width, h.height};
  j["fps"] = h.framesPerSecond;
  j["method"] = h.render.method;
  if (h.render.exposureEv != 0.0f) j["exposure"] = numbers({h.render.exposureEv})[0];
  Json settings = Json::object();
  for (const auto& [name, value] : h.render.values.values()) {
    std::visit(
        [&, key = name](const auto& v) {
          if constexpr (std::is_same_v<std::decay_t<decltype(v)>, float>) {
            settings[key] = numbers({v})[0];
          } else {
            settings[key] = v;
          }
        },
        value);
  }
  if (!settings.empty()) j["settings"] = settings;
  return text(j);
}

std::string lineText(const RecordingLine& line) {
  Json j{{"f", line.frame}};
  if (const auto* c = std::get_if<Checkpoint>(&line.what)) {
    j["check"] = c->name;
    if (!c->document.empty()) j["document"] = c->document;
    const Checkpoint usual;
    if (c->image != usual.image) j["image"] = c->image;
    if (!c->sameAs.empty()) j["sameAs"] = c->sameAs;
    if (c->max != usual.max) j["max"] = numbers({c->max})[0];
    if (c->mean != usual.mean) j["mean"] = numbers({c->mean})[0];
    return text(j);
  }
  const auto& e = std::get<InputEvent>(line.what);
  switch (e.kind) {
    case EventKind::pointer:
      j["pointer"] = numbers({e.position.x, e.position.y});
      if (!e.target.empty()) j["on"] = e.target;
      break;
    case EventKind::button:
      j["button"] = e.button;
      j["down"] = e.down;
      break;
    case EventKind::wheel:
      j["wheel"] = numbers({e.wheel.x, e.wheel.y});
      break;
    case EventKind::key:
      j["key"] = keyName(e.key);
      j["down"] = e.down;
      break;
    case EventKind::text:
      j["text"] = e.text;
      break;
    case EventKind::action:
      j["action"] = e.text;
      break;
  }
  return text(j);
}

void writeRecording(const Recording& recording) {
  std::string text = headerText(recording.header) + '\n';
  for (const RecordingLine& l : recording.lines) text += lineText(l) + '\n';
  writeFile(recording.path, text);
}

std::string hashText(uint64_t hash) { return fmt::format("{:016x}", hash); }

uint64_t fileHash(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string(), "cannot be read", "name a readable file");
  uint64_t hash = kHashStart;
  std::array<char, 65536> block;
  while (in.read(block.data(), block.size()) || in.gcount() > 0)
    hash = hashOfBytes(std::span(block).first(static_cast<size_t>(in.gcount())), hash);
  return hash;
}

}  // namespace lamplighter
