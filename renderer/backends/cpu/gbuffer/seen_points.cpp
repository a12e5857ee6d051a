#include "renderer/backends/cpu/gbuffer/seen_points.h"

#include <tbb/parallel_invoke.h>

namespace lamplighter::cpu {

void SeenPoints::take(const GBuffer& g, const View& seenFrom) {
  view = seenFrom;
  tbb::parallel_invoke([&] { px = g.px; }, [&] { py = g.py; }, [&] { pz = g.pz; },
                       [&] { object = g.object; }, [&] { hit = g.hit; });
}

}  // namespace lamplighter::cpu
