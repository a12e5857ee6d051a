// What an edit changes: the document, and the history that keeps the change so that it can be
// undone.
#pragma once

#include "editor/document/document.h"
#include "editor/edits/history.h"

namespace lamplighter {

struct Editing {
  Document& document;
  History& history;
};

}  // namespace lamplighter
