#include "editor/session/frame_pacer.h"

#include "editor/session/session.h"

namespace lamplighter {

void FramePacer::renderFrame(Session& session) {
  const FramePace::Frame frame = pace_.next(session.document().render.values);
  session.renderFrame(frame.updates, frame.budget);
  pace_.measured(session.output().stats);
}

}  // namespace lamplighter
