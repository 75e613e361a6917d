// SPDX-License-Identifier: Zlib
#include "command/accuracy/AccuracyCommand.h"
#include "command/ccd/CcdCommand.h"
#include "command/cli/CommandLine.h"
#include "command/cli/Errors.h"
#include "command/cli/PrecisionProgram.h"
#include "command/cost/CostCommand.h"
#include "command/fall/FallCommand.h"
#include "command/fit/FitCommand.h"
#include "command/plot/PlotCommand.h"
#include "command/reality/RealityCommand.h"
#include "command/render/ExportCommand.h"
#include "command/render/RenderCommand.h"
#include "command/run/RunCommand.h"
#include "command/scene/ValidateCommand.h"
#include "command/stability/StabilityCommand.h"
#include "command/viewer/ViewCommand.h"

#include <cstdio>
#include <exception>
#include <iostream>

namespace command {
namespace {

const char* const examples = R"(Examples:
  wetcloth fall                                         wet and dry fall against plain Bullet
  wetcloth fall --mode physical --height 5.5 --json -   the same with real cotton, as JSON
  wetcloth run hanging_towel.json                       run a scene and say what came of it
  wetcloth run flag_wind_100.json --frames pictures     and paint it: pictures/frame_0000.svg, ...
  wetcloth run curtain.json --quality accurate --json result.json
  wetcloth run curtain.json --checkpoint curtain.state --every 600    keep where it is; after a crash go on with
  wetcloth run curtain.json --resume curtain.state                    --resume
  wetcloth view rain_on_umbrella_cloth.json             play with it in a window: drag the cloth, change the weather
  wetcloth render flag_wind_100.json --out flag.mp4     a film; .png, .gif, .webm as well; needs no display
  wetcloth render hanging_towel.json --out towel.html   a page: orbit, play, scrub, plots
  wetcloth render dip_and_lift.json --out dip.png --times 0,3,6,9 --size 480x640    a strip of pictures
  wetcloth render hanging_towel.json --out towel.mp4 --compare    plain Bullet, dry and wet side by side
  wetcloth cost flag_wind_100.json                      what each effect of a scene takes, beside Bullet's step
  wetcloth accuracy --study wind --out accuracy         what accuracy costs in time: tables and plots
  wetcloth plot fall --out plots                        the wet and the dry fall as CSV, SVG and PNG
  wetcloth export curtain.json --format vtk --out curtain   for ParaView; for Blender, Houdini, ... see --help
  wetcloth validate *.json                              check scenes without running them
  wetcloth ccd queries.csv.gz --method exact            collision checks against exact answers
  wetcloth stability --group winds                      hard cases, and how near they come to what physics allows
  wetcloth reality --study shirts --out reality         the models beside what others have measured
  wetcloth fit mine.csv --of drying                     your own measurements as a cloth for a scene

Exit status: 0 done; 1 the run failed; 2 bad usage or bad input, with one line on standard error.)";

void runProgram(int count, char** arguments) {
  // In the order of the help.
  CommandLine line({addRunCommand, addRenderCommand, addFallCommand, addCostCommand, accuracy::addAccuracyCommand,
                    addPlotCommand, addExportCommand, viewer::addViewCommand, addValidateCommand, addCcdCommand,
                    stability::addStabilityCommand, reality::addRealityCommand, fit::addFitCommand},
                   examples);
  const Command* const command = line.read(count, arguments);
  if (command == nullptr) return;
  if (command->precision) continueIn(command->precision(), arguments);
  command->run();
}

/// What was printed may be in a buffer still.
void requirePrinted() {
  std::cout.flush();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
    throw RunError("wetcloth: standard output could not be written");
  }
}

}  // namespace
}  // namespace command

int main(int count, char** arguments) {
  try {
    command::runProgram(count, arguments);
    command::requirePrinted();
    return 0;
  } catch (const command::InputError& error) {
    std::fprintf(stderr, "%s\n", command::onOneLine(error.what()).c_str());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", command::onOneLine(error.what()).c_str());
    return 1;
  }
}
