#include "sil/render.hpp"

#include <cstdio>

#include "sil/sequence.hpp"
#include "sil/world/export.hpp"

namespace semtrack::sil {

void run_render(const RenderOptions& options) {
    WorldOptions world_options;
    world_options.frames = options.frames;
    const WorldSequence world(options.scenario, world_options);
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (error || !std::filesystem::is_directory(options.out)) {
        throw InputError(options.out.string() + ": cannot be made an output folder");
    }
    const ExportedDrive drive = export_world(world, export_layout(options.layout), options.out);
    const std::string text = "scenario      " + options.scenario + ", " +
                             std::to_string(world.last_frame() - world.first_frame() + 1) + " frames\n" +
                             "replay it     semtrack-sil replay --layout " + options.layout + " --root " +
                             options.out.string() + " --sequence " + drive.id + " --detections " +
                             drive.detections.string() + " --out DIR\n";
    (void)std::fputs(text.c_str(), stdout);
}

}  // namespace semtrack::sil
