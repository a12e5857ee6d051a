#include "renderer/debug_views/patch_lookup.h"

#include <tbb/parallel_for.h>

namespace lamplighter {

PatchLookup::PatchLookup(const VisibilityDatabase& visibility)
    : visibility_(visibility), objects_(visibility.objects()) {
  tbb::parallel_for(size_t{0}, objects_.size(), [&](size_t i) {
    const auto object = static_cast<uint32_t>(i);
    const ObjectPatches& p = visibility.patches(object);
    std::vector<Place>& places = objects_[i];
    places.resize(p.patches.size());
    for (const int root : p.roots) places[static_cast<size_t>(root)] = {root, 0};
    // Children come after their parents.
    for (size_t parent = 0; parent < places.size(); ++parent) {
      const int first = p.patches[parent].firstChild;
      if (first == kNone) continue;
      const Place at = places[parent];
      const bool apart = at.whole == static_cast<int>(parent) &&
                         visibility.isDivided(object, static_cast<int>(parent));
      for (const int child : {first, first + 1})
        places[static_cast<size_t>(child)] = apart ? Place{child, at.level + 1} : at;
    }
  });
}

}  // namespace lamplighter
