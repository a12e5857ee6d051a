#include "renderer/backends/gl/many_lights/gl_lighting.h"

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/gl/pass_state.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/low_resolution.h"

namespace lamplighter::gl {
namespace {

// The location of the map that a VPL uses.
GlShadowMaps::Place placeOf(const shared::Vpl& vpl, const GlShadowMaps& maps,
                            const PatchLights* patches) {
  const int slot = vpl.slot;
  return maps.place(patches == nullptr || slot < 0 ? slot : patches->mapSlot(slot));
}

int mostLights(const vec4& clampAndBias) { return std::max(static_cast<int>(clampAndBias.w), 1); }

}  // namespace

GlLighting::GlLighting(const std::filesystem::path& shaders, const VplBuffer& vpls)
    : emptyVertexArray_(VertexArray::make()) {
  reload(shaders, vpls);
}

void GlLighting::reload(const std::filesystem::path& shaders, const VplBuffer& vpls) {
  const char* vertex = "common/full_screen.vert.glsl";
  const char* sum = "passes/sum_vpls.frag.glsl";
  const std::string n = vpls.define();
  const std::string kinds[3] = {"VPL_KIND kVplCosine", "VPL_KIND kVplUniform",
                                "VPL_KIND kVplDirectional"};
  Program naive[3], listed[3], merged[3];
  for (int i = 0; i < 3; ++i) {
    std::vector<std::string> defines = {n, kinds[i]};
    if (i == 2) defines.push_back("DIRECTIONAL");
    naive[i] = Program(shaders, {vertex, sum, defines});
    linkedFiles_[i] = {vertex, sum, defines};
    linkedFiles_[i].defines.push_back("LINKS");
    defines.push_back("PATCHES");
    listed[i] = Program(shaders, {vertex, sum, defines});
    defines.push_back("MERGED");
    merged[i] = Program(shaders, {vertex, sum, defines});
  }
  Program findPatches(shaders, {vertex, "passes/find_patches.frag.glsl"});
  low_.reload(shaders);
  std::move(std::begin(naive), std::end(naive), naive_);
  for (Program& program : linked_) program = Program();
  shaders_ = shaders;
  std::move(std::begin(listed), std::end(listed), listed_);
  std::move(std::begin(merged), std::end(merged), merged_);
  findPatches_ = std::move(findPatches);
}

void GlLighting::clear(int width, int height) {
  pixels_.resize(width, height);
  isEmpty_ = true;
}

void GlLighting::zero() {
  const PassState state(pixels_.sums.name(), pixels_.width, pixels_.height);
  const float zero[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  glClearNamedFramebufferfv(pixels_.sums.name(), GL_COLOR, 0, zero);
  isEmpty_ = false;
}

// Keeps the order of the VPLs within each kind and array, so that the same order of VPLs gives the
// same bits.
GlLighting::Sum GlLighting::makeSum(const GlShadowMaps& maps, const VplBuffer& buffer,
                                    std::span<const shared::Vpl> vpls,
                                    const shared::ShadingParams& params,
                                    const PatchLights* patches) {
  const auto batchOf = [&](const shared::Vpl& vpl) {
    return std::pair(static_cast<int>(vpl.position.w), placeOf(vpl, maps, patches).array);
  };
  Sum sum{maps, buffer, {vpls.begin(), vpls.end()}, {}, params.clampAndBias};
  std::stable_sort(sum.vpls.begin(), sum.vpls.end(),
                   [&](const auto& a, const auto& b) { return batchOf(a) < batchOf(b); });
  std::vector<Batch>& batches = sum.batches;
  const auto blockSize = static_cast<size_t>(buffer.capacity());
  for (size_t i = 0; i < sum.vpls.size(); ++i) {
    const auto [kind, array] = batchOf(sum.vpls[i]);
    const size_t block = i / blockSize;
    if (batches.empty() || batches.back().kind != kind || batches.back().array != array ||
        batches.back().block != block) {
      batches.push_back({kind, array, block, i, 0});
    }
    ++batches.back().count;
  }
  return sum;
}

void GlLighting::sum(const GlScene& scene, const GlGBuffer& gbuffer, const GlShadowMaps& maps,
                     const VplBuffer& buffer, std::span<const shared::Vpl> vpls,
                     const shared::ShadingParams& params, const PatchLights* patches) {
  Sum sum = makeSum(maps, buffer, vpls, params, patches);
  mergedPasses_ = passesSaved_ = 0;
  clear(gbuffer.width(), gbuffer.height());
  gbuffer.bind();
  if (patches == nullptr) {
    uploadedBefore_ = uploaded();
    patches_.reset();
    pixels_.dropPlaces();
    for (SampleGrid& grid : grids_) grid = {};
  } else {
    sum.merges = patches->mergesPasses();
    takePatches(scene, gbuffer, sum, *patches);
    pixels_.addPlaces();
  }
  // Slots become layers of their arrays.
  for (const Batch& batch : sum.batches) {
    for (shared::Vpl& vpl : std::span(sum.vpls).subspan(batch.first, batch.count)) {
      vpl.slot = placeOf(vpl, maps, patches).layer;
    }
  }

  if (patches == nullptr) {
    zero();
    add(scene, sum, pixels_, false);
  } else {
    const int sampleBlock = params.block.y != 0.0f ? shared::kSampleBlock : 1;
    sumListed(scene, sum, gbuffer.points(), pixels_, 0,
              {static_cast<int>(params.block.x), sampleBlock});
  }
  isEmpty_ = false;
}

void GlLighting::sumListed(const GlScene& scene, const Sum& sum, const ShadingPoints& points,
                           SumTarget& target, size_t level, glm::ivec2 blocks) {
  const auto grids = std::span(grids_).subspan(level);
  if (grids.empty() || !grids[0].resize(target.width, target.height, blocks.x)) {
    for (SampleGrid& unused : grids) unused = {};
    target.dropStencil();
    points.bind();
    begin(scene, target, false);
    add(scene, sum, target, false);
    return;
  }
  SampleGrid& grid = grids[0];
  low_.take(points, grid);
  sumListed(scene, sum, grid.points, grid.sums, level + 1, {blocks.y, 1});
  // The test of a cell needs, for the places of all samples, whether shadows may be hard.
  const bool hasHard = !patches_->lists.hardPlaces().empty();
  const bool wantsPlaces = level > 0 && hasHard;
  points.bind();
  if (wantsPlaces) begin(scene, target, false);
  low_.interpolate(points, target, grid, scene, patches_->hardPlaces, hasHard);
  if (!wantsPlaces) begin(scene, target, true);
  add(scene, sum, target, true);
}

// before: what the buffer holds, if it holds anything.
template <typename T>
void GlLighting::upload(StorageBuffer<T>& buffer, std::span<const T> now,
                        std::span<const T> before) {
  if (buffer.name() != 0 && std::ranges::equal(now, before)) return;
  buffer.set(now);
  patches_->bytesUploaded += now.size_bytes();
}

void GlLighting::takePatches(const GlScene& scene, const GlGBuffer& gbuffer, const Sum& sum,
                             const PatchLights& lights) {
  if (!patches_) patches_ = std::make_unique<Patches>();
  GlPatches& trees = patches_->trees;
  trees.update(scene.scene(), lights);

  std::vector<SeenObject> objects;
  for (const GlScene::Drawn& d : scene.drawn()) {
    if (gbuffer.frustum().mayMeet(scene.scene().objects[d.object].bounds))
      objects.push_back({d.object, trees.firstNode(d.object), d.culled});
  }
  std::vector<LightGroup> groups;
  for (const Batch& batch : sum.batches) groups.push_back({batch.first, batch.count});
  LightLists& lists = patches_->lists;
  std::swap(lists, patches_->uploaded);
  lists.make(lights, objects, trees.nodes(), gbuffer.frustum(), sum.vpls, groups);
  if (sum.merges) lists.mergePasses(mostLights(sum.clampAndBias));
  passesSaved_ = lists.passesSaved();
  if (std::max({lists.ranges().size_bytes(), lists.entries().size_bytes(),
                lists.hardPlaces().size_bytes()}) > mostStorageBytes()) {
    throw InputError("many_lights",
                     "the light lists of the visible pixels exceed the limit of this driver",
                     "lower vpls, use the technique naive, or use --backend cpu");
  }
  const LightLists& before = patches_->uploaded;
  upload(patches_->ranges, lists.ranges(), before.ranges());
  upload(patches_->entries, lists.entries(), before.entries());
  upload(patches_->hardPlaces, lists.hardPlaces(), before.hardPlaces());
}

void GlLighting::begin(const GlScene& scene, const SumTarget& target, bool unmarked) {
  PassState state(target.begin.name(), target.width, target.height);
  if (unmarked) state.onlyWhere(false);
  patches_->trees.bind();
  scene.bindCorners();
  findPatches_.use();
  drawFullScreen(emptyVertexArray_.name());
}

const Program& GlLighting::naive(int kind, bool hasLinks) {
  if (!hasLinks) return naive_[kind];
  if (!linked_[kind]) linked_[kind] = Program(shaders_, linkedFiles_[kind]);
  return linked_[kind];
}

void GlLighting::add(const GlScene& scene, const Sum& sum, const SumTarget& target, bool unmarked) {
  PassState state(target.sums.name(), target.width, target.height);
  if (unmarked) state.onlyWhere(false);
  glBindTextureUnit(shared::kIrradiance, target.irradiance.name());
  if (patches_) {
    glBindTextureUnit(shared::kPlaces, target.places.name());
    patches_->ranges.bind(shared::kListRangeBuffer);
    patches_->entries.bind(shared::kListBuffer);
  }
  const bool hasLinks = scene.scene().hasLinks && !patches_;
  if (hasLinks) scene.bindLeftOut();
  const int most = mostLights(sum.clampAndBias);
  const auto draw = [&] {
    glTextureBarrier();  // the pass reads and writes the same irradiance texture
    drawFullScreen(emptyVertexArray_.name());
  };
  const auto blockSize = static_cast<size_t>(sum.buffer.capacity());
  for (size_t b = 0; b < sum.batches.size(); ++b) {
    const Batch& batch = sum.batches[b];
    const size_t blockStart = batch.block * blockSize;
    if (b == 0 || sum.batches[b - 1].block != batch.block) {
      sum.buffer.upload(std::span(sum.vpls).subspan(
          blockStart, std::min(blockSize, sum.vpls.size() - blockStart)));
    }
    const Program& program = sum.merges ? merged_[batch.kind]
                             : patches_ ? listed_[batch.kind]
                                        : naive(batch.kind, hasLinks);
    program.use();
    vec4 clampAndBias = sum.clampAndBias;
    clampAndBias.z = static_cast<float>(sum.maps.resolution(batch.array));
    program.set(2, clampAndBias);
    glBindTextureUnit(shared::kShadowMaps,
                      sum.maps.hasArray(batch.array) ? sum.maps.array(batch.array) : 0);
    int first = 0, end = static_cast<int>(batch.count);
    const int start = static_cast<int>(batch.first - blockStart);
    if (patches_) {
      const LightLists& lists = patches_->lists;
      end = (sum.merges ? lists.longestPlain() : lists.longest())[b];
      program.set(3, static_cast<int>(b * LightLists::places(patches_->trees.nodes())));
      program.set(4, start);
    } else {
      first += start;
      end += start;
    }
    for (; first < end; first += most) {
      program.set(0, first);
      program.set(1, std::min(first + most, end));
      if (sum.merges) program.set(5, 0);
      draw();
    }
    for (int pass = 0; sum.merges && pass < patches_->lists.passes()[b]; ++pass) {
      program.set(5, 1 + pass);
      draw();
      if (!unmarked) ++mergedPasses_;
    }
  }
}

GLuint GlLighting::irradiance() {
  if (isEmpty_) zero();
  return pixels_.irradiance.name();
}

uint64_t GlLighting::bytes() const {
  uint64_t bytes = pixels_.bytes();
  for (const SampleGrid& grid : grids_) bytes += grid.bytes();
  if (patches_) {
    bytes += patches_->trees.bytes() + patches_->ranges.bytes() + patches_->entries.bytes();
  }
  return bytes;
}

uint64_t GlLighting::uploaded() const {
  return uploadedBefore_ + (patches_ ? patches_->trees.uploaded() + patches_->bytesUploaded : 0);
}

}  // namespace lamplighter::gl
