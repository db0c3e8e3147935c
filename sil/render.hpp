// `semtrack-sil render`: a rendered scenario on disk as KITTI stores its drives.
#ifndef SEMTRACK_SIL_RENDER_HPP
#define SEMTRACK_SIL_RENDER_HPP

#include "sil/options.hpp"

namespace semtrack::sil {

/// Prints how to replay it. InputError: unknown scenario, a folder that cannot be written.
void run_render(const RenderOptions& options);

}  // namespace semtrack::sil

#endif
