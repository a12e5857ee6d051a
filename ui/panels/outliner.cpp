#include <algorithm>
#include <map>
#include <set>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/icons.h"
#include "ui/panels/keyboard.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"

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
    // A selection made elsewhere opens what it is in and scrolls there, once.
    const NodeId active = ui.session.document().active();
    reveal_ = active != state.scrolledTo ? active : kNoNode;
    state.scrolledTo = active;
    for (const Node* at = scene.find(reveal_); at; at = scene.find(at->parent))
      if (at->parent != kNoNode) open_.insert(at->parent);
  }

  void draw() {
    for (const Node* node : children_[kNoNode]) drawNode(*node);
    if (!state_.search.empty() && matches_.empty()) note("No object has that in its name.");
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
    // Only the first levels stand open at first, so that a large level stays a readable list.
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
    if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen()) select(node.id);
    if (node.id == reveal_ && !ImGui::IsItemVisible()) ImGui::SetScrollHereY();
    eye(node, widget);
    ImGui::PopID();

    if (leaf || !open) return;
    ++depth_;
    for (const Node* child : children->second) drawNode(*child);
    --depth_;
    ImGui::TreePop();
  }

  void eye(const Node& node, const std::string& widget) {
    const bool hovered = ImGui::IsItemHovered();
    const float width = ImGui::GetFrameHeight();
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("eye", {width, width}))
      ui_.session.setVisible(node.id, !node.visible);
    ui_.name(widget + "/eye");
    tooltip(ui_, node.visible ? "Hide" : "Show");
    if (node.visible && !hovered && !ImGui::IsItemHovered()) return;
    const unsigned colour = ImGui::IsItemHovered() ? theme::kText : theme::kTextDim;
    if (theme::hasIcons()) {
      ImGui::GetWindowDrawList()->AddText({at.x + ui_.px(2), at.y + ui_.px(4)},
                                          theme::colour(colour),
                                          node.visible ? icon::kEye : icon::kEyeSlash);
    } else {
      const ImVec2 middle{at.x + width / 2, at.y + width / 2};
      if (node.visible)
        ImGui::GetWindowDrawList()->AddCircleFilled(middle, ui_.px(4), theme::colour(colour));
      else
        ImGui::GetWindowDrawList()->AddCircle(middle, ui_.px(4), theme::colour(colour));
    }
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
  Tree(ui, state).draw();
  ImGui::PopStyleVar(2);
  if (ImGui::IsWindowHovered() && ImGui::IsMouseClicked(0) && !ImGui::IsAnyItemHovered())
    ui.session.select({});
  ImGui::EndChild();
}

}  // namespace lamplighter
