#include "editor/cli/flags.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <regex>
#include <string>

#include <CLI/CLI.hpp>

#include "editor/bake/bake_methods.h"
#include "editor/cli/manual.h"
#include "editor/cli/subcommands.h"
#include "editor/document/sky_text.h"
#include "renderer/debug_views/debug_view.h"

namespace lamplighter::cli {

namespace {

// A number in a range. CLI::Range alone accepts "nan".
CLI::Validator within(double low, double high) {
  const CLI::Range range(low, high);
  return {[range](std::string& text) {
            double value = 0.0;
            const bool isNumber = CLI::detail::lexical_cast(text, value) && !std::isnan(value);
            return isNumber ? range(text) : "Value " + text + " is not a number";
          },
          range.get_description()};
}

void addBackend(CLI::App& app, std::string& backend) {
  app.add_option("--backend", backend, "gl, cpu or auto")
      ->check(CLI::IsMember({"auto", "cpu", "gl"}))
      ->capture_default_str();
}

void addThreads(CLI::App& app, int& threads) {
  app.add_option("--threads", threads, "Maximum number of threads; 0: all cores")
      ->type_name("N")
      ->check(CLI::Range(0, 1024));
}

// Output format of lists that are generated from the code: text, JSON, or a page of the
// documentation.
template <typename Options>
void listFlags(CLI::App& sub, Run& run, const char* page, int (*print)(const Options&)) {
  auto o = std::make_shared<Options>();
  sub.add_flag("--json", o->json, "As JSON");
  sub.add_flag("--markdown", o->markdown, std::string("As the tables of ") + page);
  sub.footer("Example: lamplighter " + sub.get_name() + " --json");
  sub.callback([=, &run] { run = [=] { return print(*o); }; });
}

// Each function declares the flags of its subcommand and sets `run` if the subcommand is called.

void infoFlags(CLI::App& sub, Run& run, const Frontend&) {
  auto o = std::make_shared<InfoOptions>();
  sub.add_option("SCENE", o->scene, ".gltf or .glb file")->type_name("FILE")->required();
  sub.add_flag("--json", o->json, "As JSON");
  sub.footer("Example: lamplighter info level.glb --json");
  sub.callback([=, &run] { run = [=] { return info(*o); }; });
}

void addMethodFlags(CLI::App& sub, MethodFlags& o, const char* samples) {
  sub.add_option("--vpls", o.vpls, "Light samples in all")->type_name("N");
  sub.add_option("--direct-share", o.directShare,
                 "Share of the light samples that lie on the lights, 0 to 1")
      ->type_name("F");
  sub.add_option("--bounces", o.bounces, "Indirect bounces; 0 is direct light only")
      ->type_name("N");
  sub.add_option("--seed", o.seed, "Seed of the random numbers")->type_name("N");
  sub.add_option("--spp", o.spp, samples)->type_name("N");
  sub.add_option("--set", o.assignments, "name=value of any parameter of the method; repeatable")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);  // one value per flag: the next word may be the scene
}

void addMethodName(CLI::App& sub, std::string& method) {
  sub.add_option("--method", method, "See 'lamplighter methods'")
      ->type_name("NAME")
      ->capture_default_str();
}

void addView(CLI::App& sub, std::string& camera, std::string& size) {
  sub.add_option("--camera", camera, "Name or number of a camera [the first, or a view of all]")
      ->type_name("NAME|INDEX");
  sub.add_option("--size", size, "WxH in pixels")->type_name("WxH")->capture_default_str();
}

void renderFlags(CLI::App& sub, Run& run, const Frontend& frontend) {
  auto o = std::make_shared<RenderOptions>();
  sub.add_option("SCENE", o->scene, ".gltf or .glb file")->type_name("FILE")->required();
  sub.add_option("-o,--output", o->output, "EXR (linear radiance) or PNG (tone-mapped)")
      ->type_name("FILE")
      ->required();
  addMethodName(sub, o->method);
  addView(sub, o->camera, o->size);
  addMethodFlags(sub, *o, "Samples per pixel");
  addBackend(sub, o->backend);
  sub.add_option("--sky", o->sky, "Replaces the sky: radiance in W/(m2 sr), or a picture")
      ->type_name(kSkyUsage);
  sub.add_option("--sky-rotation", o->skyRotation,
                 "Rotation of the picture of the sky about the vertical axis")
      ->type_name("DEGREES")
      ->check(within(-1e6, 1e6));
  sub.add_option("--sky-scale", o->skyScale, "Factor for the radiance of the picture of the sky")
      ->type_name("FACTOR")
      ->check(within(0.0, 1e9));
  sub.add_option("--exposure", o->exposure, "EV for PNG, or auto")
      ->type_name("EV")
      ->capture_default_str();
  std::string views;
  for (const DebugViewInfo& v : debugViews())
    views += (views.empty() ? "" : ", ") + std::string(v.name);
  sub.add_option("--view", o->view, views)->type_name("NAME")->capture_default_str();
  sub.add_option("--view-vpl", o->viewVpl,
                 "Index of the light sample shown by --view occlusion, from 0")
      ->type_name("INDEX")
      ->check(CLI::NonNegativeNumber);
  sub.add_flag("--marks", o->marks, "Mark the light samples, as the viewport does");
  sub.add_flag("--legend", o->legend, "Add a legend of the colours of the view below the picture");
  addThreads(sub, o->threads);
  sub.add_option("--stats", o->stats, "JSON file for timings and counts")->type_name("FILE");
  sub.footer(
      "Example: lamplighter render level.glb -o level.png --vpls 1024 --bounces 3 --exposure auto");
  sub.callback([=, &run, &frontend] { run = [=, &frontend] { return render(*o, frontend); }; });
}

void methodsFlags(CLI::App& sub, Run& run, const Frontend&) {
  listFlags(sub, run, "docs/reference/parameters.md", methods);
}

void actionsFlags(CLI::App& sub, Run& run, const Frontend&) {
  listFlags(sub, run, "docs/reference/actions.md", actions);
}

void settingsFlags(CLI::App& sub, Run& run, const Frontend&) {
  listFlags(sub, run, "docs/reference/settings.md", settings);
}

void compareFlags(CLI::App& sub, Run& run, const Frontend&) {
  auto o = std::make_shared<CompareOptions>();
  sub.add_option("A", o->a, "Image")->type_name("FILE")->required();
  sub.add_option("B", o->b, "Image of the same size, the reference")->type_name("FILE")->required();
  sub.add_option("--mask", o->mask, "Compare only pixels that are above 0.5 in this image")
      ->type_name("FILE");
  sub.add_option("--block", o->block, "Compares the means of N x N pixels [1]")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
  sub.add_option("--heatmap", o->heatmap, "PNG file of the differences")->type_name("FILE");
  sub.add_option("--max-relrmse", o->maxRelRmse,
                 "Fail with exit code 1 if relRMSE is larger than this")
      ->type_name("X")
      ->check(CLI::NonNegativeNumber);
  sub.add_flag("--json", o->json, "As JSON");
  sub.footer(
      "relRMSE = sqrt(mean((A-B)^2)) / mean(B); bias = mean A / mean B\nExample: lamplighter "
      "compare live.exr reference.exr --heatmap where.png");
  sub.callback([=, &run] { run = [=] { return compare(*o); }; });
}

void convergeFlags(CLI::App& sub, Run& run, const Frontend& frontend) {
  auto o = std::make_shared<ConvergeOptions>();
  sub.add_option("FROM", o->from, ".gltf or .glb file")->type_name("FILE")->required();
  sub.add_option("TO", o->to,
                 "Level with the edited transforms and lights, applied when FROM is settled [none: "
                 "measures opening]")
      ->type_name("FILE");
  sub.add_option("--against", o->against, "The reference: a picture of the settled state")
      ->type_name("FILE")
      ->required();
  sub.add_option("--mask", o->mask, "Compare only pixels that are above 0.5 in this image")
      ->type_name("FILE");
  sub.add_option("--block", o->block, "Compares the means of N x N pixels [1]")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
  addMethodName(sub, o->method);
  addView(sub, o->camera, o->size);
  addMethodFlags(sub, *o, "Samples per pixel");
  sub.add_option("--seconds", o->seconds,
                 "Measure for this time, with refinement at rest [until the picture is settled]")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  addBackend(sub, o->backend);
  addThreads(sub, o->threads);
  sub.add_flag("--json", o->json, "As JSON");
  sub.footer(
      "Times are from the edit to the end of a frame, without comparing; errors are relRMSE\n"
      "Example: lamplighter converge level.glb moved.glb --against moved.exr --json");
  sub.callback([=, &run, &frontend] { run = [=, &frontend] { return converge(*o, frontend); }; });
}

void tilesFlags(CLI::App& sub, Run& run, const Frontend& frontend) {
  auto o = std::make_shared<TilesOptions>();
  sub.add_option("SCENE", o->scene, ".gltf or .glb file")->type_name("FILE")->required();
  sub.add_option("-o,--output", o->output, "PNG file")->type_name("FILE")->required();
  sub.add_option(
         "--side", o->sides,
         "A method, followed by parameters after commas; repeatable [all methods that show light]")
      ->type_name("METHOD[,NAME=VALUE]...")
      ->allow_extra_args(false);
  addView(sub, o->camera, o->size);
  sub.add_option("--columns", o->columns, "Tiles in a row")
      ->type_name("N")
      ->check(CLI::Range(1, 16))
      ->capture_default_str();
  sub.add_option("--exposure", o->exposure, "EV for all tiles, or auto")
      ->type_name("EV")
      ->capture_default_str();
  sub.add_option("--seconds", o->seconds,
                 "Render each for this time, with repair at rest [until it is settled]")
      ->type_name("S")
      ->check(CLI::PositiveNumber);
  addBackend(sub, o->backend);
  addThreads(sub, o->threads);
  sub.footer(
      "Errors are relative to the tile of the reference, in blocks of 4 x 4 pixels\nExample: "
      "lamplighter tiles level.glb -o tiles.png --side many_lights --side "
      "reference,samples_per_pixel=256");
  sub.callback([=, &run, &frontend] { run = [=, &frontend] { return tiles(*o, frontend); }; });
}

void tonemapFlags(CLI::App& sub, Run& run, const Frontend&) {
  auto o = std::make_shared<TonemapOptions>();
  sub.add_option("IMAGE", o->input, "EXR or HDR file")->type_name("FILE")->required();
  sub.add_option("-o,--output", o->output, "PNG file")->type_name("FILE")->required();
  sub.add_option("--exposure", o->exposure, "EV, or auto")->type_name("EV")->capture_default_str();
  sub.footer("Example: lamplighter tonemap live.exr -o live.png --exposure auto");
  sub.callback([=, &run] { run = [=] { return tonemap(*o); }; });
}

void scriptFlags(CLI::App& sub, Run& run, const Frontend& frontend) {
  auto o = std::make_shared<ScriptOptions>();
  sub.add_option("FILE", o->script, "File of actions, one per line; # begins a comment")
      ->type_name("FILE")
      ->required();
  sub.add_option("SCENE", o->scene, ".gltf or .glb file [none: the script opens one]")
      ->type_name("FILE");
  sub.add_option("--size", o->size, "WxH of the view in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  addBackend(sub, o->backend);
  addThreads(sub, o->threads);
  sub.add_option("--journal", o->journal, "Store every edit in this folder until the script ends")
      ->type_name("FOLDER");
  sub.footer("Example: lamplighter script relight.txt level.glb");
  sub.callback([=, &run, &frontend] { run = [=, &frontend] { return script(*o, frontend); }; });
}

void probeFlags(CLI::App& sub, BakeOptions& o) {
  CLI::Option* probes = sub.add_flag("--probes", o.probes,
                                     "Also write light probes for moving objects, computed by the "
                                     "reference with the bounces and the seed of the method")
                            ->excludes("--shard");
  CLI::Option* noMaps =
      sub.add_flag("--no-maps", o.noMaps, "Write only light probes, no light maps")->needs(probes);
  for (const char* ofMaps :
       {"--density", "--page", "--merge", "--keep-parts", "--visibility", "--vertex-colours"})
    noMaps->excludes(ofMaps);
  sub.add_option("--probe-spacing", o.probeGrid.spacing, "Distance between neighbouring probes (m)")
      ->type_name("X")
      ->check(within(0.01, 10000.0))
      ->needs(probes)
      ->capture_default_str();
  sub.add_option("--probe-padding", o.probeGrid.padding,
                 "Minimum distance between probes and surfaces (m)")
      ->type_name("X")
      ->check(within(0.0, 1000.0))
      ->needs(probes)
      ->capture_default_str();
  sub.add_option("--most-probes", o.probeGrid.most,
                 "Maximum number of grid nodes; the spacing grows if needed")
      ->type_name("N")
      ->check(CLI::Range(8, 1048576))
      ->needs(probes)
      ->capture_default_str();
  sub.add_option("--probe-spp", o.probeSamples, "Paths per probe")
      ->type_name("N")
      ->check(CLI::Range(1, 1048576))
      ->needs(probes)
      ->capture_default_str();
}

void bakeFlags(CLI::App& sub, Run& run, const Frontend& frontend) {
  auto o = std::make_shared<BakeOptions>();
  sub.add_option("SCENE", o->scene, ".gltf or .glb file")->type_name("FILE")->required();
  sub.add_option("-o,--output", o->output,
                 "Output folder for the pages and the copy; created if it does not exist")
      ->type_name("FOLDER")
      ->required();
  std::string help;
  std::vector<std::string> names;
  for (const BakeMethodInfo& method : bakeMethods()) {
    help += (help.empty() ? "" : "; ") + method.name + ": " + method.summary;
    names.push_back(method.name);
  }
  sub.add_option("--method", o->method, help)->check(CLI::IsMember(names))->capture_default_str();
  sub.add_option("--density", o->atlas.texelsPerMetre, "Texels per metre")
      ->type_name("X")
      ->check(within(0.01, 10000.0))
      ->capture_default_str();
  sub.add_option("--page", o->atlas.pageSize, "Texels along a side of a page")
      ->type_name("N")
      ->check(CLI::Range(64, 8192))
      ->capture_default_str();
  addMethodFlags(sub, *o, "Paths per texel (method reference)");
  sub.add_option(
         "--shard", o->shard,
         "Compute only the i-th of n parts; run the parts on machines that share the folder")
      ->type_name("i/n");
  sub.add_flag("--merge", o->merge, "Assemble the pages; all parts must exist")
      ->excludes("--shard");
  sub.add_flag("--keep-parts", o->keepParts, "Keep the parts after the pages are written");
  sub.add_flag("--visibility", o->visibility,
               "Also write the visibility from the surface, for other programs: "
               "docs/reference/visibility.md")
      ->excludes("--shard");
  CLI::Option* colours = sub.add_flag(
      "--vertex-colours", o->vertexColours,
      "Instead of light maps: light in the vertex colours of the copy, whose triangles "
      "are divided where light varies");
  for (const char* ofMaps :
       {"--density", "--page", "--shard", "--merge", "--keep-parts", "--visibility"})
    colours->excludes(ofMaps);
  sub.add_option("--contrast", o->vertices.contrast,
                 "Edges are divided where interpolated vertex colours have a larger relative error "
                 "than this")
      ->type_name("X")
      ->check(within(0.001, 10.0))
      ->needs(colours)
      ->capture_default_str();
  sub.add_option("--shortest-edge", o->vertices.shortestEdge,
                 "Shortest edge created by division (m)")
      ->type_name("X")
      ->check(within(0.001, 1000.0))
      ->needs(colours)
      ->capture_default_str();
  sub.add_option("--exposure", o->exposure,
                 "Vertex colours are irradiance / pi times 2^EV, at most 1; or auto: the brightest "
                 "is 1")
      ->type_name("EV|auto")
      ->needs(colours)
      ->capture_default_str();
  probeFlags(sub, *o);
  addThreads(sub, o->threads);
  sub.footer(
      "Ctrl+C stops; the same command continues from there.\nExample: lamplighter bake level.glb "
      "-o baked --method reference --spp 256");
  sub.callback([=, &run, &frontend] { run = [=, &frontend] { return bake(*o, frontend); }; });
}

void replayFlags(CLI::App& sub, Run& run, const Frontend& frontend) {
  auto o = std::make_shared<ReplayOptions>();
  sub.add_option("FILE", o->recording, "Recording (.jsonl)")->type_name("FILE")->required();
  sub.add_flag("--headless", o->headless, "Without a window");
  sub.add_option("-o,--output", o->outputFolder, "Folder for the pictures of the checkpoints")
      ->type_name("FOLDER");
  sub.add_flag("--check", o->check, "Compare with the baselines; exit code 1 if they differ");
  sub.add_flag("--update-baselines", o->updateBaselines, "Overwrite the baselines");
  sub.add_flag("--frame-clock", o->frameClock,
               "Time is counted in frames, so that pictures of the window are reproducible; frames "
               "between checkpoints are not rendered");
  sub.add_option("--against", o->against,
                 "Replays again with this setting and compares every checkpoint with the first "
                 "run: documents and pictures exactly, or within the recording's tolerance on "
                 "another backend; repeatable")
      ->type_name("threads=N|backend=NAME")
      ->needs("--check")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return std::regex_match(text, std::regex("threads=[0-9]{1,3}|backend=(cpu|gl)"))
                       ? std::string()
                       : "give threads=N, backend=cpu or backend=gl";
          },
          ""));
  sub.add_option("--report", o->report, "JSON file for the checks and edit latencies")
      ->type_name("FILE");
  sub.add_option("--method", o->method, "Method that replaces the recorded one")->type_name("NAME");
  sub.add_option("--set", o->assignments,
                 "name=value of a parameter that the recording does not set; repeatable")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  addBackend(sub, o->backend);
  addThreads(sub, o->threads);
  sub.footer("Example: lamplighter replay tests/recordings/place_light.jsonl --headless --check");
  sub.callback([=, &run, &frontend] { run = [=, &frontend] { return frontend.runReplay(*o); }; });
}

void manualFlags(CLI::App& sub, Run& run, const Frontend&) {
  struct Options {
    bool man = false, markdown = true;
  };
  auto o = std::make_shared<Options>();
  sub.add_flag("--man", o->man, "As a man page");
  sub.add_flag("--markdown", o->markdown,
               "As the tables of docs/reference/flags.md, which is the default");
  sub.footer("Example: lamplighter manual --man | man -l -");
  const CLI::App* all = sub.get_parent();
  sub.callback([=, &run] {
    run = [=] {
      std::cout << (o->man ? manPage(*all) : flagTables(*all));
      return 0;
    };
  });
}

struct Subcommand {
  const char* name;
  const char* help;
  void (*declareFlags)(CLI::App& sub, Run& run, const Frontend& frontend);
};

constexpr Subcommand kSubcommands[] = {
    {"info", "Counts, extents, lights, cameras and warnings of a scene", infoFlags},
    {"render", "Render a scene until it is settled", renderFlags},
    {"methods", "Every method with its paper and its parameters", methodsFlags},
    {"actions", "Every action of the editor with its arguments and key", actionsFlags},
    {"settings", "Every setting of the editor with its range and default", settingsFlags},
    {"compare", "The error of picture A against the reference B", compareFlags},
    {"converge", "How fast the live picture approaches a reference after an edit", convergeFlags},
    {"tiles", "Pictures of several methods side by side, with measurements", tilesFlags},
    {"tonemap", "Tone-map a radiance image as in the editor", tonemapFlags},
    {"replay", "Play a recording of input", replayFlags},
    {"script", "Run a file of actions on a scene, without a window", scriptFlags},
    {"bake", "Light maps of a scene, and a copy of the scene with their UVs", bakeFlags},
    {"manual", "All subcommands and flags", manualFlags},
};

}  // namespace

void declareFlags(CLI::App& app, std::span<const char* const> words, EditorOptions& editor,
                  Run& run, const Frontend& frontend) {
  app.add_option("SCENE", editor.scene, ".gltf or .glb file to edit [the default scene]")
      ->type_name("FILE");
  app.add_option("--record", editor.record, "Record all input to this file")->type_name("FILE");
  addBackend(app, editor.backend);
  app.add_option("--journal", editor.journal,
                 "Store every edit in this folder until it is saved [the user's state folder]")
      ->type_name("FOLDER");
  const auto isNamed = [&](std::string_view name) {
    return std::find(words.begin(), words.end(), name) != words.end();
  };
  for (const Subcommand& s : kSubcommands) {
    CLI::App* sub = app.add_subcommand(s.name, s.help);
    if (isNamed(s.name) || isNamed("manual")) s.declareFlags(*sub, run, frontend);
  }
  app.require_subcommand(0, 1);
}

}  // namespace lamplighter::cli
