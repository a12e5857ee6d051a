#include <algorithm>
#include <map>
#include <set>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/edits/tree.h"
#include "renderer/base/error.h"
#include "ui/panels/panels.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/keyboard.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

bool containsIgnoringCase(const std::string& text, const std::string& part) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

const char* iconOf(const Node& node) {
  if (node.area) return icon::kLight;
  if (node.punctual)
    return node.punctual->kind == PunctualKind::directional ? icon::kSun : icon::kLight;
  if (node.camera != kNone) return icon::kCamera;
  if (node.mesh != kNone) return icon::kMesh;
  return icon::kGroup;
}

constexpr const char* kDragged = "nodes";

class Tree {
 public:
  Tree(const PanelContext& ui, OutlinerState& state) : ui_(ui), state_(state) {
    const Scene& scene = ui.session.document().scene;
    for (const Node& node : scene.nodes) {
      children_[node.parent].push_back(&node);
      ++named_[node.name];
      if (!state.search.empty() && containsIgnoringCase(node.name, state.search))
        for (NodeId id = node.id; id != kNoNode && matches_.insert(id).second;) {
          const Node* at = scene.find(id);
          id = at ? at->parent : kNoNode;
        }
    }
    // A selection made elsewhere opens its parents and scrolls there, once.
    const NodeId active = ui.session.document().active();
    reveal_ = active != state.scrolledTo ? active : kNoNode;
    state.scrolledTo = active;
    for (const Node* at = scene.find(reveal_); at; at = scene.find(at->parent))
      if (at->parent != kNoNode) open_.insert(at->parent);
  }

  // Makes the last item a drop target; kNoNode: the top level of the tree.
  void dropOn(NodeId parent) {
    if (!ImGui::BeginDragDropTarget()) return;
    if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(kDragged)) {
      const auto* ids = static_cast<const NodeId*>(payload->Data);
      dropped_.assign(ids, ids + static_cast<size_t>(payload->DataSize) / sizeof(NodeId));
      droppedOn_ = parent;
    }
    ImGui::EndDragDropTarget();
  }
  // Call after drawing, because the drop changes the tree.
  void takeDropped() {
    if (dropped_.empty()) return;
    try {
      reparent(ui_.session.editing(), dropped_, droppedOn_);
    } catch (const InputError& e) {
      ui_.session.setStatus(e.what());
    }
  }

  void draw() {
    for (const Node* node : children_[kNoNode]) drawNode(*node);
    if (!state_.search.empty() && matches_.empty()) note("No object has this text in its name.");
    if (children_.empty()) note("The scene is empty.");
  }

 private:
  void drawNode(const Node& node) {
    if (!state_.search.empty() && !matches_.contains(node.id)) return;
    const auto children = children_.find(node.id);
    const bool leaf = children == children_.end();
    ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_OpenOnArrow |
                               ImGuiTreeNodeFlags_OpenOnDoubleClick |
                               ImGuiTreeNodeFlags_FramePadding |
                               ImGuiTreeNodeFlags_AllowItemOverlap;
    if (leaf) flags |= ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen;
    if (ui_.session.document().isSelected(node.id)) flags |= ImGuiTreeNodeFlags_Selected;
    if (!state_.search.empty() || open_.contains(node.id)) ImGui::SetNextItemOpen(true);
    // Only the first levels are open at first, so that the list of a large level stays readable.
    if (depth_ < 2) ImGui::SetNextItemOpen(true, ImGuiCond_FirstUseEver);

    ImGui::PushID(static_cast<int>(node.id));
    const std::string name = node.name.empty() ? "(unnamed)" : node.name;
    if (!node.visible) ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kTextDim));
    const bool open =
        ImGui::TreeNodeEx("##node", flags, "%s", withIcon(iconOf(node), name).c_str());
    if (!node.visible) ImGui::PopStyleColor();
    if (pressedByKey()) select(node.id);
    const std::string widget =
        named_[node.name] > 1 || node.name.empty() ? name + "#" + std::to_string(node.id) : name;
    ui_.name(widget);
    press(node);
    drag(node, name);
    if (node.id == reveal_ && !ImGui::IsItemVisible()) ImGui::SetScrollHereY();
    marks(node, widget);
    ImGui::PopID();

    if (leaf || !open) return;
    ++depth_;
    for (const Node* child : children->second) drawNode(*child);
    --depth_;
    ImGui::TreePop();
  }

  // An item of a multiple selection is selected on release, so that all items can be dragged.
  void press(const Node& node) {
    const bool adds = ImGui::GetIO().KeyCtrl || ImGui::GetIO().KeyShift;
    if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen()) {
      const bool isOneOfMany =
          ui_.session.document().selection.size() > 1 && ui_.session.document().isSelected(node.id);
      if (isOneOfMany && !adds)
        state_.pressed = node.id;
      else
        select(node.id);
    }
    if (state_.pressed != node.id || ImGui::IsMouseDown(0)) return;
    state_.pressed = kNoNode;
    if (ImGui::IsItemHovered()) select(node.id);
  }

  // Dropped items become children of the target. These are the selection, or one item outside it.
  void drag(const Node& node, const std::string& name) {
    if (ImGui::BeginDragDropSource(ImGuiDragDropFlags_SourceAllowNullID)) {
      state_.pressed = kNoNode;
      const std::vector<NodeId>& selection = ui_.session.document().selection;
      const bool isIn = ui_.session.document().isSelected(node.id);
      const std::vector<NodeId> ids = isIn ? selection : std::vector<NodeId>{node.id};
      ImGui::SetDragDropPayload(kDragged, ids.data(), ids.size() * sizeof(NodeId));
      ImGui::TextUnformatted(ids.size() == 1 ? name.c_str()
                                             : (std::to_string(ids.size()) + " objects").c_str());
      ImGui::EndDragDropSource();
    }
    dropOn(node.id);
  }

  // Eye and lock at the right. They are dim unless they are active or hovered.
  void marks(const Node& node, const std::string& widget) {
    const bool hovered = ImGui::IsItemHovered();
    const float width = ImGui::GetFrameHeight();
    const float right = ImGui::GetWindowContentRegionMax().x;
    ImGui::SameLine(right - 2 * width);
    if (mark("lock", widget, node.locked ? "Unlock" : "Lock: cannot be picked or moved in the view",
             node.locked ? icon::kLock : icon::kUnlock, node.locked, hovered || node.locked))
      setLocked(ui_.session.editing(), {node.id}, !node.locked);
    ImGui::SameLine(right - width);
    if (mark("eye", widget, node.visible ? "Hide" : "Show",
             node.visible ? icon::kEye : icon::kEyeSlash, node.visible, hovered || !node.visible))
      ui_.session.setVisible(node.id, !node.visible);
  }

  // True if it was clicked.
  bool mark(const char* what, const std::string& widget, const char* help, const char* symbol,
            bool isFilled, bool isShown) {
    const float width = ImGui::GetFrameHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::InvisibleButton(what, {width, width});
    ui_.name(widget + "/" + what);
    tooltip(ui_, help);
    if (!isShown && !ImGui::IsItemHovered()) return clicked;
    const ImU32 colour = theme::colour(ImGui::IsItemHovered() ? theme::kText : theme::kTextDim);
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImVec2 middle{at.x + width / 2, at.y + width / 2};
    if (theme::hasIcons())
      draw.AddText({at.x + ui_.px(2), at.y + ui_.px(4)}, colour, symbol);
    else if (isFilled)
      draw.AddCircleFilled(middle, ui_.px(4), colour);
    else
      draw.AddCircle(middle, ui_.px(4), colour);
    return clicked;
  }

  void select(NodeId id) {
    std::vector<NodeId> ids;
    if (ImGui::GetIO().KeyCtrl || ImGui::GetIO().KeyShift) {
      ids = ui_.session.document().selection;
      if (std::erase(ids, id) == 0) ids.push_back(id);
    } else {
      ids = {id};
    }
    state_.scrolledTo = ids.empty() ? kNoNode : ids.back();
    ui_.session.select(std::move(ids));
  }

  const PanelContext& ui_;
  OutlinerState& state_;
  std::map<NodeId, std::vector<const Node*>> children_;
  std::map<std::string, int> named_;
  std::set<NodeId> matches_, open_;
  NodeId reveal_ = kNoNode;
  std::vector<NodeId> dropped_;  // items dropped in this frame
  NodeId droppedOn_ = kNoNode;
  int depth_ = 0;
};

}  // namespace

void outliner(PanelContext ui, OutlinerState& state) {
  ui.prefix = "outliner/";
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::InputTextWithHint("##search", withIcon(icon::kSearch, "Search").c_str(), &state.search);
  ui.name("search");
  ImGui::BeginChild("tree", {0, 0}, false, ImGuiWindowFlags_NavFlattened);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(6), 0});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(3), ui.px(3)});
  Tree tree(ui, state);
  tree.draw();
  ImGui::PopStyleVar(2);
  // The rest of the panel: a click clears the selection; it is the drop target for the top level.
  const ImVec2 rest = ImGui::GetContentRegionAvail();
  if (rest.x > 0.0f) {
    // Not a button, so that keyboard navigation skips it.
    ImGui::Dummy({rest.x, std::max(rest.y, ui.px(24))});
    if (ImGui::IsItemClicked()) ui.session.select({});
    ui.name("top");
    tree.dropOn(kNoNode);
  }
  tree.takeDropped();
  ImGui::EndChild();
}

}  // namespace lamplighter
