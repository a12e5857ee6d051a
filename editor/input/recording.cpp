#include "editor/input/recording.h"

#include <array>
#include <charconv>
#include <fstream>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "renderer/error.h"
#include "renderer/methods/gi_method.h"

namespace lamplighter {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kFormat = 1;

// Floats as short as they read back.
Json numbers(std::initializer_list<float> values) {
  Json j = Json::array();
  for (const float v : values) j.push_back(std::stod(fmt::format("{}", v)));
  return j;
}

std::string text(const Json& j) { return j.dump(-1, ' ', false, Json::error_handler_t::replace); }

vec2 pairOf(const Json& j) {
  if (!j.is_array() || j.size() != 2) throw std::invalid_argument("is no pair of numbers");
  return {j[0].get<float>(), j[1].get<float>()};
}

// Values keep their kind: a JSON number is int or float by the method's declaration.
ParameterValue valueOf(const std::string& method, const std::string& name, const Json& j) {
  for (const ParameterSpec& p : findMethod(method).parameters) {
    if (p.name != name) continue;
    const std::string given = j.is_string() ? j.get<std::string>() : j.dump();
    return Settings::parse(p, given);
  }
  throw std::invalid_argument("'" + name + "' is no parameter of " + method);
}

RecordingHeader headerOf(const Json& j) {
  if (!j.contains("lamplighter")) throw std::invalid_argument("is no header of a recording");
  if (j["lamplighter"] != kFormat) throw std::invalid_argument("is of another format version");
  RecordingHeader h;
  h.scene = j.value("scene", "");
  h.sceneHash = j.value("sceneHash", "");
  if (j.contains("window")) {
    const vec2 size = pairOf(j["window"]);
    h.width = static_cast<int>(size.x);
    h.height = static_cast<int>(size.y);
  }
  h.framesPerSecond = j.value("fps", 60);
  if (h.width < 1 || h.height < 1 || h.width > 16384 || h.height > 16384 || h.framesPerSecond < 1) {
    throw std::invalid_argument("has no sensible window or fps");
  }
  h.render.method = findMethod(j.value("method", h.render.method)).name;
  h.render.exposureEv = j.value("exposure", 0.0f);
  if (j.contains("settings")) {
    for (const auto& [name, value] : j["settings"].items())
      h.render.values.set(name, valueOf(h.render.method, name, value));
  }
  return h;
}

InputEvent eventOf(const Json& j) {
  InputEvent e;
  if (j.contains("pointer")) {
    e.kind = EventKind::pointer;
    e.position = pairOf(j["pointer"]);
    e.target = j.value("on", "");
  } else if (j.contains("button")) {
    e.kind = EventKind::button;
    e.button = j["button"].get<int>();
    e.down = j.at("down").get<bool>();
    if (e.button < 0 || e.button > 2)
      throw std::invalid_argument("names a button that is none of 0, 1, 2");
  } else if (j.contains("wheel")) {
    e.kind = EventKind::wheel;
    e.wheel = pairOf(j["wheel"]);
  } else if (j.contains("key")) {
    e.kind = EventKind::key;
    e.key = keyOf(j["key"].get<std::string>());
    e.down = j.at("down").get<bool>();
    if (e.key == Key::none) throw std::invalid_argument("names no known key");
  } else if (j.contains("text")) {
    e.kind = EventKind::text;
    e.text = j["text"].get<std::string>();
  } else if (j.contains("action")) {
    e.kind = EventKind::action;
    e.text = j["action"].get<std::string>();
  } else {
    throw std::invalid_argument("is neither an event nor a checkpoint");
  }
  return e;
}

Checkpoint checkpointOf(const Json& j) {
  Checkpoint c;
  c.name = j["check"].get<std::string>();
  c.document = j.value("document", "");
  c.image = j.value("image", true);
  c.max = j.value("max", c.max);
  c.mean = j.value("mean", c.mean);
  if (c.name.empty() || c.name.find_first_of("/\\") != std::string::npos)
    throw std::invalid_argument("has no usable name");
  return c;
}

}  // namespace

std::filesystem::path Recording::scenePath() const {
  if (header.scene.empty()) return {};
  return (path.has_parent_path() ? path.parent_path() : std::filesystem::path(".")) / header.scene;
}

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
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty()) continue;
    try {
      const Json j = Json::parse(line);
      if (!j.is_object()) throw std::invalid_argument("is no JSON object");
      if (!hasHeader) {
        r.header = headerOf(j);
        hasHeader = true;
        continue;
      }
      RecordingLine l;
      l.frame = j.at("f").get<uint32_t>();
      if (!r.lines.empty() && l.frame < r.lines.back().frame)
        throw std::invalid_argument("goes back in time");
      if (j.contains("check")) {
        l.what = checkpointOf(j);
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
  Json j{{"lamplighter", kFormat}, {"scene", h.scene}};
  if (!h.sceneHash.empty()) j["sceneHash"] = h.sceneHash;
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
  const std::filesystem::path temporary = recording.path.string() + ".part";
  std::ofstream out(temporary, std::ios::binary);
  out << headerText(recording.header) << '\n';
  for (const RecordingLine& l : recording.lines) out << lineText(l) << '\n';
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(temporary, recording.path, error);
  if (out && !error) return;
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  throw InputError(recording.path.string(), "cannot be written",
                   "check the folder and the space left");
}

std::string hashText(uint64_t hash) { return fmt::format("{:016x}", hash); }

uint64_t fileHash(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(path.string(), "cannot be read", "name a file that can");
  uint64_t hash = 0xcbf29ce484222325ull;  // FNV-1a
  std::array<char, 65536> block;
  while (in.read(block.data(), block.size()) || in.gcount() > 0) {
    for (std::streamsize i = 0; i < in.gcount(); ++i) {
      hash = (hash ^ static_cast<uint8_t>(block[static_cast<size_t>(i)])) * 0x100000001b3ull;
    }
  }
  return hash;
}

}  // namespace lamplighter
