#include "renderer/light_maps/pass_merging.h"

#include <algorithm>
#include <bit>
#include <iterator>

namespace lamplighter {
namespace {

// A set of lights as bits, for fast scoring of pairs.
class LightBits {
 public:
  LightBits(std::span<const uint32_t> lights, size_t words) : words_(words, 0) {
    for (const uint32_t light : lights) words_[light / 64] |= uint64_t{1} << light % 64;
  }
  int count() const {
    int n = 0;
    for (const uint64_t w : words_) n += std::popcount(w);
    return n;
  }
  int countWith(const LightBits& other) const {
    int n = 0;
    for (size_t i = 0; i < words_.size(); ++i) n += std::popcount(words_[i] & other.words_[i]);
    return n;
  }
  LightBits with(const LightBits& other) const {
    LightBits both = *this;
    for (size_t i = 0; i < words_.size(); ++i) both.words_[i] &= other.words_[i];
    return both;
  }
  void take(const LightBits& other) {
    for (size_t i = 0; i < words_.size(); ++i) words_[i] &= ~other.words_[i];
  }
  std::vector<uint32_t> list() const {
    std::vector<uint32_t> out;
    for (size_t i = 0; i < words_.size(); ++i)
      for (uint64_t w = words_[i]; w != 0; w &= w - 1)
        out.push_back(static_cast<uint32_t>(64 * i) + static_cast<uint32_t>(std::countr_zero(w)));
    return out;
  }

 private:
  std::vector<uint64_t> words_;
};

struct Element {
  std::vector<uint32_t> objects;
  LightBits lights;
  int count;  // number of lights; 0: the element was removed
};

int passesFor(int lights, int lightsPerPass) {
  return (lights + lightsPerPass - 1) / lightsPerPass;
}

int saving(const Element& a, const Element& b, int most) {
  if (a.count == 0 || b.count == 0) return 0;
  const int common = a.lights.countWith(b.lights);
  return passesFor(a.count, most) + passesFor(b.count, most) - passesFor(common, most) -
         passesFor(a.count - common, most) - passesFor(b.count - common, most);
}

}  // namespace

int passesOf(const PassElement& element, int lightsPerPass) {
  return passesFor(static_cast<int>(element.lights.size()), lightsPerPass);
}

MergedPasses mergePasses(std::span<const PassElement> elements, int lightsPerPass) {
  size_t words = 0;
  for (const PassElement& e : elements)
    if (!e.lights.empty()) words = std::max(words, size_t{e.lights.back()} / 64 + 1);
  std::vector<Element> all;
  int before = 0;
  for (const PassElement& e : elements) {
    all.push_back({e.objects, {e.lights, words}, static_cast<int>(e.lights.size())});
    before += passesOf(e, lightsPerPass);
  }
  // For each element the best partner among the later ones; searched again only when one of the two
  // changed.
  struct Best {
    int saving = 0;
    size_t partner = 0;
  };
  std::vector<Best> best(all.size());
  const auto find = [&](size_t a) {
    best[a] = {};
    for (size_t b = a + 1; b < all.size(); ++b) {
      const int saved = saving(all[a], all[b], lightsPerPass);
      if (saved > best[a].saving) best[a] = {saved, b};
    }
  };
  for (size_t a = 0; a < all.size(); ++a) find(a);
  while (true) {
    size_t a = 0;
    for (size_t i = 1; i < all.size(); ++i)
      if (best[i].saving > best[a].saving) a = i;
    if (all.empty() || best[a].saving == 0) break;
    const size_t b = best[a].partner;
    Element both{{}, all[a].lights.with(all[b].lights), 0};
    both.count = both.lights.count();
    std::set_union(all[a].objects.begin(), all[a].objects.end(), all[b].objects.begin(),
                   all[b].objects.end(), std::back_inserter(both.objects));
    for (const size_t i : {a, b}) {
      all[i].lights.take(both.lights);
      all[i].count -= both.count;
    }
    all.push_back(std::move(both));
    best.emplace_back();
    const size_t made = all.size() - 1;
    for (size_t i = 0; i < made; ++i) {
      const bool changed = i == a || i == b;
      if (changed || (best[i].saving > 0 && (best[i].partner == a || best[i].partner == b))) {
        find(i);
        continue;
      }
      for (const size_t partner : {a, b, made}) {
        if (partner <= i) continue;
        const int saved = saving(all[i], all[partner], lightsPerPass);
        if (saved > best[i].saving ||
            (saved > 0 && saved == best[i].saving && partner < best[i].partner))
          best[i] = {saved, partner};
      }
    }
  }
  MergedPasses out;
  for (Element& e : all) {
    if (e.count == 0) continue;
    out.elements.push_back({std::move(e.objects), e.lights.list()});
    out.passes += passesFor(e.count, lightsPerPass);
  }
  out.saved = before - out.passes;
  return out;
}

std::vector<PassElement> shadowedLights(const VisibilityDatabase& visibility,
                                        std::span<const uint32_t> seen) {
  std::vector<PassElement> out;
  for (const uint32_t object : seen) {
    const ObjectPatches& patches = visibility.patches(object);
    std::vector<bool> needed(visibility.slots(), false);
    for (size_t i = 0; i < patches.patches.size(); ++i) {
      if (!patches.patches[i].isLeaf()) continue;
      const auto states = visibility.row(object, static_cast<int>(i));
      for (size_t slot = 0; slot < states.size(); ++slot)
        if (static_cast<Occlusion>(states[slot]) == Occlusion::partial) needed[slot] = true;
    }
    PassElement& element = out.emplace_back();
    element.objects = {object};
    for (uint32_t slot = 0; slot < needed.size(); ++slot)
      if (needed[slot]) element.lights.push_back(slot);
  }
  return out;
}

}  // namespace lamplighter
