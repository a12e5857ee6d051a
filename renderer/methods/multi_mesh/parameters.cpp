#include "renderer/methods/multi_mesh/parameters.h"

namespace lamplighter {

const ParameterTable<DirectMeshParameters>& directMeshParameters() {
  using P = DirectMeshParameters;
  static const ParameterTable<P> table{
      {&P::direct,
       "direct",
       "Direct light",
       "",
       "What carries the direct light of area lights. meshes: vertices on the surfaces, refined "
       "where the picture has shadows. samples: light samples with shadow maps, as many_lights.",
       {{"meshes", MultiMeshDirect::meshes}, {"samples", MultiMeshDirect::samples}}},
      {&P::contrast,
       "contrast",
       "Contrast",
       "%",
       "An edge of the mesh of a light is divided if the light halfway differs by more from the "
       "mean of its ends. Less: finer shadows, more vertices.",
       {0.1, 50.0, kLogarithmic},
       ParameterGroup::quality,
       "Less: finer shadows on the meshes of lights."},
      {&P::leastPixels,
       "least_pixels",
       "Least edge",
       "pixels",
       "Edges of meshes that are shorter in the picture are not divided.",
       {1.0, 64.0, kLogarithmic}},
      {&P::priority,
       "priority",
       "Priority",
       "",
       "Which vertices are found first. paper: a triangle at random, or near the last one if that "
       "has more contrast and pixels. sorted: most contrast and pixels first. random: in any "
       "order. The finished picture is the same.",
       {{"paper", MeshPriority::paper},
        {"sorted", MeshPriority::sorted},
        {"random", MeshPriority::random}}},
      {&P::separateLights, "separate_lights", "Mesh for each light",
       "Whether each light has a mesh of its own. Without, a light that changes its brightness "
       "changes the mesh of all."},
      {&P::meshMemory,
       "mesh_memory",
       "Mesh memory",
       "MiB",
       "Memory limit for the vertices of the meshes of lights. If it is short, those of earlier "
       "views are forgotten.",
       {1, 65536, kLogarithmic},
       ParameterGroup::budgets,
       "More: the light of earlier views stays known."}};
  return table;
}

const ParameterTable<MultiMeshParameters>& multiMeshParameters() {
  static const ParameterTable<MultiMeshParameters> table{
      pathParameters(), frameBudgetParameters(), surfaceLightParameters(), surfaceParameters(),
      directMeshParameters()};
  return table;
}

}  // namespace lamplighter
