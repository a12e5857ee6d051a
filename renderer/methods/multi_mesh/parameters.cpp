#include "renderer/methods/multi_mesh/parameters.h"

namespace lamplighter {

const ParameterTable<DirectMeshParameters>& directMeshParameters() {
  using P = DirectMeshParameters;
  static const ParameterTable<P> table{
      {&P::direct,
       "direct",
       "Direct light",
       "",
       "How the direct light of area lights is computed. meshes: at vertices on the surfaces, "
       "refined where the picture has shadows; takes longer with many large lamps. samples: light "
       "samples with shadow maps, as in many_lights.",
       {{"meshes", MultiMeshDirect::meshes}, {"samples", MultiMeshDirect::samples}}},
      {&P::contrast,
       "contrast",
       "Contrast",
       "%",
       "An edge is divided if the light at its middle differs from the mean of its ends by more "
       "than this. Smaller: finer shadows, more vertices and time.",
       {0.1, 50.0, kLogarithmic},
       ParameterGroup::quality,
       "Smaller: finer shadows on the meshes of lights."},
      {&P::leastPixels,
       "least_pixels",
       "Least edge",
       "pixels",
       "Edges that are shorter than this in the picture are not divided. Smaller: sharper shadow "
       "borders, more vertices; 1 needs several times as many as the default.",
       {1.0, 64.0, kLogarithmic}},
      {&P::priority,
       "priority",
       "Priority",
       "",
       "Which vertices are computed first. paper: a random triangle, or the one next to the last "
       "if that has more contrast and pixels. sorted: most contrast and pixels first; unfinished "
       "pictures have the smallest error. random: any order. The finished picture and its total "
       "cost are the same.",
       {{"paper", MeshPriority::paper},
        {"sorted", MeshPriority::sorted},
        {"random", MeshPriority::random}}},
      {&P::separateLights, "separate_lights", "Mesh for each light",
       "Each light has a mesh of its own, which takes more vertices, but only the light that moves "
       "is computed again. Off: all lights share one mesh, and each edit of a light computes all "
       "of it again."},
      {&P::meshMemory,
       "mesh_memory",
       "Mesh memory",
       "MiB",
       "Memory limit for the vertices of the meshes of lights. If it is too small, vertices of "
       "earlier views are discarded and computed again when needed.",
       {1, 65536, kLogarithmic},
       ParameterGroup::budgets,
       "More: the light of earlier views stays in memory."}};
  return table;
}

const ParameterTable<MultiMeshParameters>& multiMeshParameters() {
  static const ParameterTable<MultiMeshParameters> table{
      pathParameters(), frameBudgetParameters(), surfaceLightParameters(), surfaceParameters(),
      directMeshParameters()};
  return table;
}

}  // namespace lamplighter
