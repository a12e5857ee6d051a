#include "tests/guide/steps.h"

#include <algorithm>

#include "editor/keys/chord.h"
#include "renderer/base/error.h"
#include "renderer/registry/registry.h"
#include "tests/support/folders.h"

namespace lamplighter::test {

namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr uint32_t kAfterClick = 4;  // frames until a widget that a click opened can be clicked
constexpr int kDragMoves = 8;

class Writer {
 public:
  explicit Writer(const Page& page) : page_(page) {
    recording_.path = page.name() + ".jsonl";
    RecordingHeader& header = recording_.header;
    header.scene = (test::sourceFolder() / page.scene).string();
    header.width = kWidth;
    header.height = kHeight;
    for (const auto& [name, value] : page.values) {
      if (name == "exposure")
        header.render.exposureEv = std::stof(value);
      else
        setParameter(header.render, name, value);
    }
  }
  Recording write() {
    for (const Section& section : page_.sections)
      for (const Step& step : section.steps) take(step);
    return std::move(recording_);
  }

 private:
  static void setParameter(RenderSettings& render, const std::string& name,
                           const std::string& value) {
    for (const ParameterSpec& p : findMethod(render.method).parameters)
      if (p.name == name) return render.values.set(name, Settings::parse(p, value));
    throw InputError(name, "is not a parameter of " + render.method,
                     "see docs/reference/parameters.md");
  }
  [[noreturn]] void fail(const Step& step, const std::string& what) const {
    throw InputError(page_.at(step.line), what, "tests/guide/steps.h lists the steps");
  }

  void take(const Step& step) {
    const std::string& verb = step.verb;
    if (verb == "key")
      chord(step);
    else if (verb == "hold" || verb == "release")
      key(keyFrom(step), verb == "hold");
    else if (verb == "type")
      text(EventKind::text, step.rest);
    else if (verb == "point")
      point(step, 1);
    else if (verb == "click" || verb == "right")
      click(step, verb == "click" ? 0 : 1);
    else if (verb == "double")
      twice(step);
    else if (verb == "drag")
      drag(step);
    else if (verb == "wheel")
      wheel(number(step, 0));
    else if (verb == "setup")
      text(EventKind::action, step.rest);
    else if (verb == "wait")
      frame_ += static_cast<uint32_t>(number(step, 0));
    else if (verb == "away")
      away();
    else if (verb == "picture")
      checkpoint(step.rest);
    else if (verb == "settle")
      checkpoint("line " + std::to_string(step.line));
    else
      fail(step, "there is no step '" + verb + "'");
  }

  void add(const InputEvent& event) { recording_.lines.push_back({frame_, event}); }
  void key(Key name, bool down) {
    InputEvent e;
    e.kind = EventKind::key;
    e.key = name;
    e.down = down;
    frame_ += 1;
    add(e);
  }
  Key keyFrom(const Step& step) {
    std::string name = step.rest;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const Key result = keyOf(name);
    if (result == Key::none) fail(step, "'" + step.rest + "' is not a key");
    return result;
  }
  void chord(const Step& step) {
    const std::optional<Chord> chord = parseChord(step.rest);
    if (!chord) fail(step, "'" + step.rest + "' is not a key");
    std::vector<Key> keys;
    if (chord->modifiers.ctrl) keys.push_back(Key::ctrl);
    if (chord->modifiers.alt) keys.push_back(Key::alt);
    if (chord->modifiers.shift) keys.push_back(Key::shift);
    keys.push_back(chord->key);
    for (const Key k : keys) key(k, true);
    frame_ += 1;
    std::reverse(keys.begin(), keys.end());
    for (const Key k : keys) key(k, false);
    frame_ += kAfterClick;
  }
  void text(EventKind kind, const std::string& what) {
    InputEvent e;
    e.kind = kind;
    e.text = what;
    frame_ += 1;
    add(e);
    frame_ += kAfterClick;
  }
  float number(const Step& step, size_t i) {
    if (i >= step.words.size()) fail(step, "lacks a number");
    try {
      return std::stof(step.words[i]);
    } catch (const std::exception&) {
      fail(step, "'" + step.words[i] + "' is not a number");
    }
  }
  // `i`: index of the first word of the position. Default: the middle of the widget.
  void point(const Step& step, size_t i) {
    if (step.words.empty()) fail(step, "lacks the widget");
    InputEvent e;
    e.kind = EventKind::pointer;
    e.target = step.words[0];
    e.position = vec2(0.5f);
    if (step.words.size() > i) e.position = {number(step, i), number(step, i + 1)};
    frame_ += 1;
    add(e);
    frame_ += 2;
  }
  void away() {
    InputEvent e;
    e.position = {kWidth - 1, kHeight - 1};
    frame_ += 1;
    add(e);
    frame_ += 2;
  }
  void button(int which, bool down) {
    InputEvent e;
    e.kind = EventKind::button;
    e.button = which;
    e.down = down;
    frame_ += 1;
    add(e);
  }
  void click(const Step& step, int which) {
    point(step, 1);
    button(which, true);
    button(which, false);
    frame_ += kAfterClick;
  }
  void twice(const Step& step) {
    point(step, 1);
    for (int i = 0; i < 2; ++i) {
      button(0, true);
      button(0, false);
    }
    frame_ += kAfterClick;
  }
  void drag(const Step& step) {
    point(step, 1);
    button(0, true);
    for (size_t i = 3; i + 1 < step.words.size(); i += 2) {
      const vec2 from(number(step, i - 2), number(step, i - 1));
      const vec2 to(number(step, i), number(step, i + 1));
      for (int k = 1; k <= kDragMoves; ++k) {
        InputEvent e;
        e.kind = EventKind::pointer;
        e.target = step.words[0];
        e.position = glm::mix(from, to, static_cast<float>(k) / kDragMoves);
        frame_ += 1;
        add(e);
      }
    }
    button(0, false);
    frame_ += kAfterClick;
  }
  void wheel(float notches) {
    InputEvent e;
    e.kind = EventKind::wheel;
    e.wheel = {0.0f, notches};
    frame_ += 1;
    add(e);
    frame_ += 2;
  }
  void checkpoint(const std::string& name) {
    Checkpoint checkpoint;
    checkpoint.name = name;
    checkpoint.image = false;
    frame_ += 2;
    recording_.lines.push_back({frame_, checkpoint});
  }

  const Page& page_;
  Recording recording_;
  uint32_t frame_ = 5;
};

}  // namespace

Recording recordingOf(const Page& page) { return Writer(page).write(); }

std::vector<std::string> picturesOf(const Page& page) {
  std::vector<std::string> names;
  for (const Section& section : page.sections)
    for (const Step& step : section.steps)
      if (step.verb == "picture") names.push_back(step.rest);
  return names;
}

}  // namespace lamplighter::test
