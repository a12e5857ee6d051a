#include "renderer/backends/gl/gl_lighting.h"

#include <algorithm>

#include "renderer/error.h"
#include "renderer/gl/pass_state.h"
#include "shaders/shared/bindings.h"

namespace lamplighter::gl {
namespace {

int arrayOf(const shared::Vpl& vpl, int slotsAnArray) {
  const int slot = static_cast<int>(vpl.intensity.w);
  return slot < 0 ? 0 : slot / slotsAnArray;
}

// A storage buffer with these values.
template <typename T>
void fill(Buffer& buffer, std::span<const T> values) {
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  if (values.size_bytes() > static_cast<size_t>(limit)) {
    throw InputError("many_lights",
                     "the light lists of what is seen are more than OpenGL takes here",
                     "lower vpls, take the technique naive, or use --backend cpu");
  }
  if (!buffer) buffer = Buffer::make();
  static const T kNothing{};
  const bool none = values.empty();
  glNamedBufferData(buffer.name(), static_cast<GLsizeiptr>(none ? sizeof(T) : values.size_bytes()),
                    none ? &kNothing : values.data(), GL_STREAM_DRAW);
}

}  // namespace

GlLighting::GlLighting(const std::filesystem::path& shaders, const VplBuffer& vpls)
    : emptyVertexArray_(VertexArray::make()),
      irradianceFramebuffer_(Framebuffer::make()),
      pictureFramebuffer_(Framebuffer::make()) {
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
    defines.push_back("PATCHES");
    listed[i] = Program(shaders, {vertex, sum, defines});
    defines.push_back("MERGED");
    merged[i] = Program(shaders, {vertex, sum, defines});
  }
  Program findPatches(shaders, {vertex, "passes/find_patches.frag.glsl"});
  Program compose(shaders, {vertex, "passes/compose.frag.glsl"});
  std::move(std::begin(naive), std::end(naive), naive_);
  std::move(std::begin(listed), std::end(listed), listed_);
  std::move(std::begin(merged), std::end(merged), merged_);
  findPatches_ = std::move(findPatches);
  compose_ = std::move(compose);
}

void GlLighting::clear(int width, int height) {
  if (width_ != width || height_ != height) {
    width_ = width;
    height_ = height;
    irradiance_ = makeTexture2D(GL_RGBA32F, width, height);
    glNamedFramebufferTexture(irradianceFramebuffer_.name(), GL_COLOR_ATTACHMENT0,
                              irradiance_.name(), 0);
    pictures_.clear();
    patches_.reset();
  }
  const PassState state(irradianceFramebuffer_.name(), width_, height_);
  const float zero[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  glClearNamedFramebufferfv(irradianceFramebuffer_.name(), GL_COLOR, 0, zero);
}

void GlLighting::sum(const GlScene& scene, const GlGBuffer& gbuffer, const GlShadowMaps& maps,
                     const VplBuffer& buffer, std::span<const shared::Vpl> vpls,
                     const shared::ShadingParams& params, const PatchLights* patches) {
  // In their order within each kind and array: the same bits whenever the same VPLs come in the
  // same order.
  const auto batchOf = [&](const shared::Vpl& vpl) {
    return std::pair(static_cast<int>(vpl.position.w), arrayOf(vpl, maps.slotsAnArray()));
  };
  std::vector<shared::Vpl> sorted(vpls.begin(), vpls.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto& a, const auto& b) { return batchOf(a) < batchOf(b); });
  std::vector<Batch> batches;
  const auto blockSize = static_cast<size_t>(buffer.capacity());
  for (size_t i = 0; i < sorted.size(); ++i) {
    const auto [kind, array] = batchOf(sorted[i]);
    const size_t block = i / blockSize;
    if (batches.empty() || batches.back().kind != kind || batches.back().array != array ||
        batches.back().block != block) {
      batches.push_back({kind, array, block, i, 0});
    }
    ++batches.back().count;
  }

  const int most = std::max(static_cast<int>(params.clampAndBias.w), 1);
  const bool merges = patches != nullptr && patches->mergesPasses();
  mergedPasses_ = passesSaved_ = 0;
  clear(gbuffer.width(), gbuffer.height());
  gbuffer.bind();
  if (patches != nullptr) {
    beginWithPatches(scene, gbuffer, sorted, batches, *patches, most);
  } else {
    patches_.reset();
  }

  // Slots within their arrays.
  for (const Batch& batch : batches) {
    for (shared::Vpl& vpl : std::span(sorted).subspan(batch.first, batch.count)) {
      if (vpl.intensity.w >= 0.0f)
        vpl.intensity.w -= static_cast<float>(batch.array * maps.slotsAnArray());
    }
  }
  const PassState state(irradianceFramebuffer_.name(), width_, height_);
  glBindTextureUnit(shared::kIrradiance, irradiance_.name());
  const auto drawSum = [&] {
    glTextureBarrier();  // the irradiance is read where it is written
    drawFullScreen(emptyVertexArray_.name());
  };
  for (size_t b = 0; b < batches.size(); ++b) {
    const Batch& batch = batches[b];
    const size_t blockStart = batch.block * blockSize;
    if (b == 0 || batches[b - 1].block != batch.block) {
      buffer.upload(
          std::span(sorted).subspan(blockStart, std::min(blockSize, sorted.size() - blockStart)));
    }
    const Program& program = (merges ? merged_ : patches_ ? listed_ : naive_)[batch.kind];
    program.use();
    program.set(2, params.clampAndBias);
    glBindTextureUnit(shared::kShadowMaps,
                      maps.hasArray(batch.array) ? maps.array(batch.array) : 0);
    int first = 0, end = static_cast<int>(batch.count);
    const int start = static_cast<int>(batch.first - blockStart);
    if (patches_) {
      const LightLists& lists = patches_->lists;
      end = (merges ? lists.longestPlain() : lists.longest())[b];
      program.set(3, static_cast<int>(b * LightLists::places(patches_->trees.nodes())));
      program.set(4, start);
    } else {
      first += start;
      end += start;
    }
    for (; first < end; first += most) {
      program.set(0, first);
      program.set(1, std::min(first + most, end));
      if (merges) program.set(5, 0);
      drawSum();
    }
    for (int pass = 0; merges && pass < patches_->lists.passes()[b]; ++pass) {
      program.set(5, 1 + pass);
      drawSum();
      ++mergedPasses_;
    }
  }
}

void GlLighting::beginWithPatches(const GlScene& scene, const GlGBuffer& gbuffer,
                                  std::span<const shared::Vpl> vpls, std::span<const Batch> batches,
                                  const PatchLights& lights, int mostLights) {
  if (!patches_) {
    patches_ = std::make_unique<Patches>();
    patches_->places = makeTexture2D(GL_R32UI, width_, height_);
    patches_->framebuffer = Framebuffer::make();
    const GLuint framebuffer = patches_->framebuffer.name();
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, irradiance_.name(), 0);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT1, patches_->places.name(), 0);
    constexpr GLenum kTargets[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(framebuffer, 2, kTargets);
  }
  GlPatches& trees = patches_->trees;
  trees.update(scene.scene(), lights);

  std::vector<SeenObject> objects;
  for (const GlScene::Drawn& d : scene.drawn()) {
    if (gbuffer.frustum().mayMeet(scene.scene().objects[d.object].bounds))
      objects.push_back({d.object, trees.firstNode(d.object), d.culled});
  }
  std::vector<LightGroup> groups;
  for (const Batch& batch : batches) groups.push_back({batch.first, batch.count});
  LightLists& lists = patches_->lists;
  lists.make(lights, objects, trees.nodes(), gbuffer.frustum(), vpls, groups);
  if (lights.mergesPasses()) lists.mergePasses(mostLights);
  passesSaved_ = lists.passesSaved();
  fill(patches_->ranges, lists.ranges());
  fill(patches_->entries, lists.entries());

  const PassState state(patches_->framebuffer.name(), width_, height_);
  trees.bind();
  findPatches_.use();
  drawFullScreen(emptyVertexArray_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::kListRangeBuffer, patches_->ranges.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::kListBuffer, patches_->entries.name());
  glBindTextureUnit(shared::kPlaces, patches_->places.name());
}

std::shared_ptr<RadianceTexture> GlLighting::freePicture(int width, int height) {
  for (const auto& picture : pictures_) {
    if (picture.use_count() == 1) {
      picture->forgetPixels();
      return picture;
    }
  }
  return pictures_.emplace_back(std::make_shared<RadianceTexture>(width, height));
}

std::shared_ptr<RadianceTexture> GlLighting::compose(const GlGBuffer& gbuffer, const vec3& sky,
                                                     bool white) {
  auto picture = freePicture(width_, height_);
  glNamedFramebufferTexture(pictureFramebuffer_.name(), GL_COLOR_ATTACHMENT0, picture->texture(),
                            0);
  const PassState state(pictureFramebuffer_.name(), width_, height_);
  gbuffer.bind();
  glBindTextureUnit(shared::kIrradiance, irradiance_.name());
  compose_.set(0, sky);
  compose_.set(1, white ? 1 : 0);
  compose_.use();
  drawFullScreen(emptyVertexArray_.name());
  return picture;
}

uint64_t GlLighting::bytes() const {
  const uint64_t pixels = static_cast<uint64_t>(width_) * height_;
  uint64_t bytes = (1 + pictures_.size()) * uint64_t{16} * pixels;
  if (patches_) {
    bytes += sizeof(uint32_t) * pixels + patches_->trees.bytes() +
             patches_->lists.ranges().size_bytes() + patches_->lists.entries().size_bytes();
  }
  return bytes;
}

}  // namespace lamplighter::gl
