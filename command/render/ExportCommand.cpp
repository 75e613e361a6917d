// SPDX-License-Identifier: Zlib
#include "command/render/ExportCommand.h"

#include "command/cli/CommonOptions.h"
#include "command/cli/DistinctFiles.h"
#include "command/cli/Errors.h"
#include "command/cli/JsonOutput.h"
#include "command/cli/StagedOutput.h"
#include "command/render/SampleRun.h"
#include "command/scene/SceneOptions.h"
#include "command/scene/SolverOption.h"

#include "command/pictures/HtmlPage.h"
#include "command/pictures/ObjFile.h"
#include "command/pictures/PlySequence.h"
#include "command/pictures/UsdFile.h"
#include "command/pictures/VtkSeries.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace command {
namespace {

namespace fs = std::filesystem;

struct ExportOptions : SceneOptions {
  std::string format;
  std::string out;  ///< folder or file, as the format has it
  double framesPerSecond = 30;
  std::string json;
};

struct Format {
  std::string name;
  std::string explanation;
  StagedOutput::Kind kind;
  std::string suffix;  ///< of a file
  std::function<void(const pictures::FrameSequence&, const std::string&)> write;
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all{
      {"ply", "a folder of Stanford PLY files", StagedOutput::Kind::folder, "", pictures::writePlySequence},
      {"obj_pc2", "a folder of Wavefront OBJ and PC2 point caches, for Blender's modifier Mesh Cache",
       StagedOutput::Kind::folder, "", pictures::writeObjAndPointCaches},
      {"usda", "a file .usda, USD as text", StagedOutput::Kind::file, ".usda", pictures::writeUsd},
      {"vtk", "a folder of VTK PolyData with run.pvd, for ParaView", StagedOutput::Kind::folder, "",
       pictures::writeVtkSeries},
      {"html", "a page .html to look at the run in a browser", StagedOutput::Kind::file, ".html", pictures::writeHtml}};
  return all;
}

std::vector<std::string> exportFormats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) names.push_back(format.name);
  return names;
}

std::string exportFormatsExplained() {
  std::string text;
  for (const Format& format : formats()) text += (text.empty() ? "" : "; ") + format.name + ": " + format.explanation;
  return text;
}

const Format& formatOf(const std::string& name) {
  return *std::find_if(formats().begin(), formats().end(), [&](const Format& format) { return format.name == name; });
}

void requireFramesPerSecond(double framesPerSecond) {
  if (framesPerSecond >= 0.01 && framesPerSecond <= 10000) return;
  char value[32];
  std::snprintf(value, sizeof value, "%g", framesPerSecond);
  throw InputError("wetcloth: --fps = " + std::string(value) + ": must be in [0.01, 10000]");
}

/// Names and sizes of the files that are there, sorted.
nlohmann::ordered_json filesIn(const fs::path& out) {
  std::vector<fs::path> files;
  if (fs::is_directory(out)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(out)) files.push_back(entry.path());
  } else {
    files.push_back(out);
  }
  std::sort(files.begin(), files.end());
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const fs::path& file : files) list.push_back({{"file", file.string()}, {"bytes", fs::file_size(file)}});
  return list;
}

nlohmann::ordered_json jsonOf(const Scene& scene, const ExportOptions& options,
                              const pictures::FrameSequence& sequence) {
  nlohmann::ordered_json json;
  json["scene"] = scene.name;
  json["precision"] = nameOf(ownPrecision);
  json["format"] = options.format;
  json["frames"] = sequence.frames.size();
  json["fps"] = options.framesPerSecond;
  json["end_s"] = sequence.frames.back().time;
  json["cloths"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < sequence.cloths.size(); ++i) {
    json["cloths"].push_back({{"name", sequence.cloths[i].name},
                              {"nodes", sequence.frames.back().cloths[i].positions.size()},
                              {"triangles", sequence.cloths[i].triangles.size()}});
  }
  json["files"] = filesIn(options.out);
  return json;
}

void write(const Format& format, const pictures::FrameSequence& sequence, const std::string& option,
           StagedOutput& output) {
  try {
    format.write(sequence, output.path());
  } catch (const std::runtime_error& error) {
    throw RunError(option + ": " + error.what());
  }
  output.commit();
}

void exportScene(const ExportOptions& options) {
  requireFramesPerSecond(options.framesPerSecond);
  const Format& format = formatOf(options.format);
  const std::string option = "wetcloth: --out = \"" + onOneLine(options.out) + "\"";
  if (format.kind == StagedOutput::Kind::file && fs::path(options.out).extension() != format.suffix) {
    throw InputError(option + ": must end in " + format.suffix + " for --format " + format.name);
  }
  const Scene scene = prepareScene(options).scene;
  JsonOutput json(options.json);
  StagedOutput output(option, options.out, format.kind);
  requireDistinctFiles({{"the scene", options.scene}, {"--json", options.json}, {"--out", options.out}});
  const pictures::FrameSequence sequence = sampleRun(scene, options.framesPerSecond);
  write(format, sequence, option, output);
  const nlohmann::ordered_json result = jsonOf(scene, options, sequence);
  json.write(result);
  if (json.ownsStandardOutput()) return;
  std::printf("%zu frames of %s, %g per second: %s\n", sequence.frames.size(), scene.name.c_str(),
              options.framesPerSecond, options.out.c_str());
}

}  // namespace

Command addExportCommand(CLI::App& line) {
  CLI::App* const app = line.add_subcommand("export", "Run a scene and write it for other programs");
  const auto options = std::make_shared<ExportOptions>();
  addSceneFile(*app, *options);
  app->add_option("--format", options->format, exportFormatsExplained())
      ->check(oneOf("--format", exportFormats()))
      ->required();
  app->add_option("--out", options->out, "File, which is replaced, or folder, which must be new or empty")->required();
  app->add_option("--fps", options->framesPerSecond, "Frames per simulated second")->capture_default_str();
  addDuration(*app, *options);
  addQuality(*app, *options);
  addSolver(*app, options->solver);
  addScenePrecision(*app, *options);
  addJson(*app, options->json, "what was written");
  return {app, [options] { exportScene(*options); }, [options] { return wishOf(*options); }};
}

}  // namespace command
